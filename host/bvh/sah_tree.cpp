#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "host/bvh/tree.h"

namespace meniscal {
namespace {

struct Item {
  Box box;
  uint32_t triangle;
  glm::vec3 centre() const { return 0.5f * box.min + 0.5f * box.max; }
};

double half_area(const Box& box) {
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

struct Bin {
  Box box;
  uint32_t count = 0;
  void grow(const Bin& other) {
    box.grow(other.box);
    count += other.count;
  }
};

// A plane across `axis` behind bin `last`; cost: areas times triangles of both sides.
struct Split {
  int axis = 0, last = 0;
  double cost = std::numeric_limits<double>::infinity();
};

// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
class Binning {
 public:
  Binning(TreeNodes& nodes, uint32_t max_depth) : nodes_(nodes), max_depth_(max_depth) {}

  const TreeNode* build(std::span<Item> items, const Box& box, uint32_t depth) {
    const Places places(items);
    const Split split = best_split(items, places);
    // A step of the tracers fetches one record, node or triangle: both cost 1.
    if (items.size() <= shared::BVH_MAX_LEAF &&
        (depth > max_depth_ || static_cast<double>(items.size()) * half_area(box) <= half_area(box) + split.cost))
      return leaf(items);
    auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    if (!fits_below(items.size(), depth))
      halve(items, middle);
    else if (split.cost < std::numeric_limits<double>::infinity())
      middle = std::partition(items.begin(), items.end(),
                              [&](const Item& i) { return places.bin(i)[split.axis] <= split.last; });
    TreeNode* const node = nodes_.make();
    const std::array halves{std::span(items.begin(), middle), std::span(middle, items.end())};
    for (size_t side = 0; side < 2; ++side) {
      for (const Item& i : halves[side]) node->box[side].grow(i.box);
      node->child[side] = build(halves[side], node->box[side], depth + 1);
    }
    return node;
  }

 private:
  static constexpr int most_bins = 16;

  // Whether the levels below `depth` hold so many, however unevenly they are split here.
  bool fits_below(size_t items, uint32_t depth) const {
    return depth <= max_depth_ && items <= size_t{shared::BVH_MAX_LEAF} << (max_depth_ - depth);
  }

  static void halve(std::span<Item> items, std::span<Item>::iterator middle) {
    Box centres;
    for (const Item& i : items) centres.grow({i.centre(), i.centre()});
    const glm::vec3 size = centres.max - centres.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // The index breaks ties, so that coincident triangles split alike everywhere.
    std::nth_element(items.begin(), middle, items.end(), [&](const Item& a, const Item& b) {
      return std::pair(a.centre()[axis], a.triangle) < std::pair(b.centre()[axis], b.triangle);
    });
  }

  // Which bin of each axis an item's centre falls into.
  struct Places {
    int bins;  // few items want few
    glm::vec3 low, per_size;
    explicit Places(std::span<const Item> items)
        : bins(static_cast<int>(std::min<size_t>(most_bins, 4 + items.size() / 8))) {
      Box centres;
      for (const Item& i : items) centres.grow({i.centre(), i.centre()});
      low = centres.min;
      for (int axis = 0; axis < 3; ++axis) {
        const float size = centres.max[axis] - low[axis];
        per_size[axis] = size > 0 && static_cast<float>(bins) / size < 1e37f ? static_cast<float>(bins) / size : 0;
      }
    }
    glm::ivec3 bin(const Item& item) const {
      return glm::min(glm::ivec3((item.centre() - low) * per_size), glm::ivec3(bins - 1));
    }
  };

  static Split best_split(std::span<const Item> items, const Places& places) {
    const int bins = places.bins;
    std::array<std::array<Bin, most_bins>, 3> table;
    for (const Item& i : items) {
      const glm::ivec3 bin = places.bin(i);
      for (int axis = 0; axis < 3; ++axis) table[axis][bin[axis]].grow({i.box, 1});
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, most_bins> above{};  // cost of what is behind each bin; 0: nothing
      Bin sum;
      for (int b = bins - 1; b > 0; --b) {
        sum.grow(table[axis][b]);
        if (sum.count > 0) above[b - 1] = half_area(sum.box) * sum.count;
      }
      sum = {};
      for (int b = 0; b + 1 < bins && sum.count + table[axis][b].count < items.size(); ++b) {
        sum.grow(table[axis][b]);
        if (sum.count == 0) continue;
        const double cost = half_area(sum.box) * sum.count + above[b];
        if (cost < best.cost) best = {axis, b, cost};
      }
    }
    return best;
  }

  const TreeNode* leaf(std::span<const Item> items) {
    TreeNode* const node = nodes_.make();
    node->count = static_cast<uint32_t>(items.size());
    std::ranges::transform(items, node->triangles.begin(), &Item::triangle);
    return node;
  }

  TreeNodes& nodes_;
  uint32_t max_depth_;
};

}  // namespace

const TreeNode* build_tree(std::span<const Box> boxes, uint32_t max_depth, TreeNodes& nodes) {
  std::vector<Item> items;
  items.reserve(boxes.size());
  Box all;
  for (const Box& box : boxes) {
    items.push_back({box, static_cast<uint32_t>(items.size())});
    all.grow(box);
  }
  return Binning(nodes, max_depth).build(items, all, 1);
}

}  // namespace meniscal
