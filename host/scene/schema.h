// Types and ranges of the JSON properties this loader relies on, checked on the raw JSON: tinygltf silently replaces
// a wrong type by the default, and an integer by its lowest 32 bits.
#pragma once

#include <string_view>

#include "host/scene/messages.h"

namespace meniscal::gltf {

// Parses `json` (checked for depth before) and fails at the first property of a wrong type, length or range.
void check_schema(std::string_view json, const Messages& messages);

}  // namespace meniscal::gltf
