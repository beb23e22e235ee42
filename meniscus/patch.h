// The part of the liquid's free surface that is meshed anew: the triangles that a meniscus or a contour touches.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "meniscus/columns.h"
#include "meniscus/topology.h"

namespace meniscus {

struct Base {  // a point of the level liquid
  glm::dvec3 position, normal;
};

class Patch {
 public:
  // All triangles of the free surface that are, in projection, within `reach` plus the length of their longest edge of
  // a contact line: where they are long, there is room to grow from the band's fine mesh to theirs.
  Patch(const Topology& liquid, const std::vector<std::uint32_t>& surface, const std::vector<ContactLine>& lines,
        double reach);

  struct Side {
    std::uint32_t from, to;  // welded points, the patch on the left
    bool own;                // the free surface ends here; else an untouched triangle of it continues
  };

  bool contains(std::uint32_t triangle) const { return member_[triangle]; }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  const std::vector<Side>& border() const { return border_; }
  const Box& box() const { return box_; }  // in the plane, (z, x, 0)

  // The liquid at x, interpolated on the triangle it lies on; nothing outside the patch. `clamped` also answers a
  // little outside.
  std::optional<Base> at(const glm::dvec2& x) const;
  bool covers(const glm::dvec2& x) const;
  Base clamped(const glm::dvec2& x) const;

  // Is the border nearer to x than `limit`?
  bool border_within(const glm::dvec2& x, double limit) const;

 private:
  // Calls found(triangle, weights) for the one that x lies on.
  template <class Found>
  void find(const glm::dvec2& x, Found found) const;
  Base interpolate(std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec2& x) const;

  const Topology& liquid_;
  std::vector<bool> member_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Side> border_;
  Box box_;
  Tree triangle_tree_, border_tree_;
};

}  // namespace meniscus
