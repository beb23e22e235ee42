// The liquid-solid contacts of a world, as `info` and the statistics list them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/world/world.h"

namespace meniscal {

nlohmann::ordered_json contacts_json(const World& world);

}  // namespace meniscal
