// Closest hits in double precision. Naive on purpose: a median-split tree and recursion, no tuning; it checks the
// GPU's.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "host/world/world.h"

namespace meniscal::reference {

struct Ray {
  glm::dvec3 origin, direction;
};

struct Hit {
  double t;
  std::uint32_t triangle;
  glm::dvec3 point, shading;  // shading: interpolated unit normal
};

inline constexpr std::uint32_t no_triangle = 0xFFFFFFFFu;

class Tracer {
 public:
  explicit Tracer(const World& world);

  // Closest hit with 0 < t < reach; triangle `skip`, on which the ray starts, is left out.
  std::optional<Hit> closest(const Ray& ray, double reach, std::uint32_t skip) const;
  bool blocked(const Ray& ray, double reach, std::uint32_t skip) const { return closest(ray, reach, skip).has_value(); }

  // A start for rays that leave `point` on the side of `normal`.
  glm::dvec3 leave(const glm::dvec3& point, const glm::dvec3& normal) const {
    return point + 1e-11 * world_.radius * normal;
  }
  const World& world() const { return world_; }
  std::uint64_t rays() const { return rays_; }  // traced so far

 private:
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first, count;  // range of order_; a leaf where `right` is 0
    std::uint32_t right;         // the left child follows its parent
  };
  struct Nearest;
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  void visit(std::uint32_t node, const Ray& ray, std::uint32_t skip, Nearest& nearest) const;

  const World& world_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  mutable std::uint64_t rays_ = 0;
};

}  // namespace meniscal::reference
