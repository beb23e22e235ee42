#include "meniscus/share.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"
#include "meniscus/tree.h"

namespace meniscus {
namespace {

glm::dvec3 in_plan(const glm::dvec2& p) { return {p.x, p.y, 0}; }

bool slides(const ContactLine& line) {
  return std::any_of(line.nodes.begin(), line.nodes.end(),
                     [](const Node& node) { return node.contact.slide != glm::dvec2(0); });
}

// Contact nodes by their places in the plane, each with the length of line that it stands for.
class Nodes {
 public:
  explicit Nodes(const std::vector<ContactLine>& lines) : tree_({}) {
    if (std::none_of(lines.begin(), lines.end(), slides)) return;
    std::vector<Box> boxes;
    for (const ContactLine& line : lines) {
      const std::size_t first = nodes_.size();
      for (const Node& node : line.nodes) {
        nodes_.push_back({&node, 0});
        boxes.emplace_back().add(in_plan(planar(node.position)));
      }
      for (std::size_t i = 0; i < line.segments(); ++i) {
        const double half = 0.5 * glm::distance(line.nodes[i].position, line.next(i).position);
        nodes_[first + i].length += half, nodes_[first + (i + 1) % line.nodes.size()].length += half;
      }
    }
    tree_ = Tree(std::move(boxes));
  }

  // The mean slide round x, of which the nearest node is `least` metres away: those as near count most, those twice as
  // far nothing.
  glm::dvec2 mean_slide(const glm::dvec2& x, double least) const {
    glm::dvec2 sum(0);
    double weights = 0;
    Box box;
    box.add(in_plan(x));
    tree_.overlapping(box.grown(2 * least), [&](std::uint32_t i) {
      const double farther = glm::distance(planar(nodes_[i].node->position), x) / least - 1;
      if (farther >= 1) return;
      const double near = std::min(1 - farther, 1.0), square = near * near, weight = nodes_[i].length * square * square;
      sum += weight * nodes_[i].node->contact.slide, weights += weight;
    });
    return weights > 0 ? sum / weights : sum;
  }

 private:
  struct Entry {
    const Node* node;
    double length;
  };
  std::vector<Entry> nodes_;
  Tree tree_;
};

}  // namespace

void share_slides(std::vector<ContactLine>& lines, std::vector<bool>& changed) {
  std::vector<Box> reached;  // by columns of each line
  for (const ContactLine& line : lines) {
    Box box;
    for (const Node& node : line.nodes) box.add(in_plan(planar(node.position)));
    reached.push_back(box.grown(line.sweep));
  }
  const std::vector<bool> asked = changed;
  const Nodes nodes(lines);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    bool near = false;
    for (std::size_t k = 0; k < lines.size() && !near; ++k) near = asked[k] && reached[k].overlaps(reached[l]);
    if (!near) continue;
    ContactLine& line = lines[l];
    for (Node& node : line.nodes) {
      const double least = 1e-3 * line.sweep, reach = std::clamp(node.free, least, std::max(line.sweep, least));
      glm::dvec2 toward(0);
      if (node.free < line.sweep) {
        const glm::dvec2 x = planar(node.position) + reach * node.contact.direction;
        const double q = reach / line.sweep;
        toward = node.room * (1 - q) * (1 - q) * nodes.mean_slide(x, reach);
      }
      for (Side* side : {&node.before, &node.after, &node.contact}) {
        if (side->toward != toward || side->reach != reach) changed[l] = true;
        side->toward = toward, side->reach = reach;
      }
    }
  }
}

}  // namespace meniscus
