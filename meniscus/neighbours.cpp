#include "meniscus/neighbours.h"

#include <algorithm>

#include "meniscus/field.h"
#include "meniscus/predicates.h"
#include "meniscus/tree.h"

namespace meniscus {

void find_free_lengths(std::vector<ContactLine>& lines, double first, double reach) {
  const Field field(lines);
  for (ContactLine& line : lines) {
    for (Node& node : line.nodes) {
      for (const Side* side : {&node.contact, &node.before, &node.after}) {
        if (side != &node.contact && !node.joint) continue;
        const double most = std::min(reach, node.free);
        for (double within = first;; within *= 2) {
          const double limit = std::min(within, most);
          const double free = field.free_length(planar(node.position), side->direction, limit, 8);
          if (free >= limit && limit < most) continue;
          node.free = std::min(node.free, free);
          break;
        }
      }
    }
  }
}

void refine_in_gaps(ContactLine& line, double reach) {
  constexpr double kLayers = 100, kFinest = 1.0 / 20;
  std::vector<double> free;
  for (const Node& node : line.nodes) free.push_back(node.free);
  const auto narrow = free.begin() + static_cast<std::ptrdiff_t>(free.size() / 10);
  std::nth_element(free.begin(), narrow, free.end());
  double& first = line.fineness.first;
  first = std::min(first, std::max(*narrow / (kLayers * reach), kFinest * first));
}

void wake_neighbours(std::vector<ContactLine>& lines, double reach) {
  std::vector<Box> awake;
  for (const ContactLine& line : lines) {
    if (line.sweep == 0) continue;
    Box& box = awake.emplace_back();
    for (const Node& node : line.nodes) box.add(node.position);
    box = box.grown(reach);
  }
  for (ContactLine& line : lines) {
    Box box;
    for (const Node& node : line.nodes) box.add(node.position);
    if (std::any_of(awake.begin(), awake.end(), [&](const Box& b) { return b.overlaps(box); })) line.sweep = reach;
  }
}

}  // namespace meniscus
