// Generated scenes of a liquid and solids, each with the topology that its surface must have.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "meniscus/meniscus.h"

namespace shapes {

// What is counted on the surface, menisci included. `loops` are those of its border: the liquid's own and one round
// each hole.
struct Expected {
  std::size_t contours, open, components, loops;
  long genus = 0;
  std::vector<std::string> warnings{};  // a part of each; no other warning may come
};

// Percent of a solid's contact line that may be pinned, and lowered, with a warning.
struct Held {
  int pinned = 0, lowered = 0;
};

struct Scene {
  meniscus::Liquid liquid;
  std::vector<meniscus::Solid> solids;
};

// A row of the table: the scene is made when it is asked for.
struct Case {
  std::string name;
  std::function<Scene()> make;
  Expected expected;
  Held held{};
  bool thin = false;  // triangles below 1 degree remain
  bool ill = false;   // solids that enclose no volume: which side is liquid has no answer to compare with
  bool slow = false;  // for the sweep alone
};
const std::vector<Case>& cases();
inline void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

// Everything larger by the factor, the capillary length too.
Scene scaled(Scene scene, double factor);
// As after a stay at a far place: coordinates rounded as they are there.
Scene rounded_at(Scene scene, const glm::dvec3& place);

}  // namespace shapes
