// The compute shaders as SPIR-V, embedded at build time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace meniscal {

// `pass`: stem of a shaders/*.comp. `texel`: tables are read through texel buffers, else through storage buffers.
// Throws std::out_of_range for a pass that does not exist.
std::span<const std::uint32_t> shader(std::string_view pass, bool texel);

}  // namespace meniscal
