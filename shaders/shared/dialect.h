// Lets one header compile as GLSL and as C++ (through GLM). The common dialect: f-suffixed literals, component access
// instead of swizzles, no bool and no three-component arrays in buffers, structs ordered so that std430 and C++ agree.
#ifndef MENISCAL_DIALECT_H
#define MENISCAL_DIALECT_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SHARED_BEGIN namespace meniscal::shared {
#define SHARED_END }
#define SHARED inline
namespace meniscal::shared {
using glm::abs, glm::atan, glm::clamp, glm::cross, glm::dot, glm::floatBitsToUint, glm::floor, glm::ivec3, glm::length, glm::max, glm::min,
    glm::mix, glm::normalize, glm::sign, glm::sqrt, glm::uint, glm::uintBitsToFloat, glm::uvec2, glm::uvec3, glm::uvec4,
    glm::vec2, glm::vec3, glm::vec4, glm::cos, glm::sin;
}
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED
#endif

#endif
