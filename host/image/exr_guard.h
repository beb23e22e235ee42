// What OpenEXR 3.1 takes at its word.
#pragma once

#include <cstdint>
#include <istream>

namespace meniscal {

// Throws std::runtime_error where an attribute of a header claims more bytes than the file has, for which OpenEXR would
// make room before it reads, or others than its value has. Everything else that is wrong, it finds itself. `file` stays
// where it was.
void require_attributes_within(std::istream& file, std::uint64_t file_bytes);

}  // namespace meniscal
