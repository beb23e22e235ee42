// The specialisation constants of a shader, by the names that its source gives them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace meniscal::gpu {

// Values as the shader is compiled with: `given`, by id 0, 1, ..., as ComputePass takes them; else the shader's own.
std::map<std::string, double> named_constants(std::span<const std::uint32_t> spirv,
                                              const std::vector<std::uint32_t>& given);

}  // namespace meniscal::gpu
