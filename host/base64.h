// Bytes as text, for data URIs.
#pragma once

#include <string>

namespace meniscal {

// RFC 4648, section 4, padded.
std::string base64(const std::string& bytes);

}  // namespace meniscal
