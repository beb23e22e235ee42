// What building a surface has to say, and of which solids.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace meniscus {

struct Warning {
  std::string text;
  std::vector<std::size_t> solids = {};  // that it concerns, as indices; none: the liquid alone
};
using Warnings = std::vector<Warning>;

}  // namespace meniscus
