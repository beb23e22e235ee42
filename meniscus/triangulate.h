// Constrained Delaunay triangulation in the plane with exact orientation tests: points first, then constraints, then
// winding numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <utility>
#include <vector>

namespace meniscus {

// What winding numbers gain by crossing a constraint from the left of its direction to the right.
struct Crossing {
  int solid = 0, patch = 0;
};

class Triangulation {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Triangle {
    std::array<std::uint32_t, 3> v;  // counter-clockwise
    std::array<std::uint32_t, 3> n;  // neighbour opposite to each vertex, or kNone
  };

  // For points within the rectangle low..high. Vertices 0 to 2 are those of a triangle around it all.
  Triangulation(const glm::dvec2& low, const glm::dvec2& high);

  // Returns the new vertex, or the one that was at p already. All points should come before the first constraint.
  std::uint32_t insert(const glm::dvec2& p);

  // Makes ab an edge, or a chain of edges through vertices on it; where it crosses an earlier constraint a vertex is
  // made. Crossings of constraints that coincide add up.
  void constrain(std::uint32_t a, std::uint32_t b, Crossing left_to_right);

  const std::vector<glm::dvec2>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  // What is gained by leaving triangle t across the edge opposite to its vertex i; null where that edge is no
  // constraint.
  const Crossing* constraint(std::uint32_t t, int i, int& sense) const;

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  static Key key(std::uint32_t a, std::uint32_t b) { return a < b ? Key{a, b} : Key{b, a}; }

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool in_circle(const Triangle& t, std::uint32_t d) const;
  bool fixed(std::uint32_t a, std::uint32_t b) const {
    return ends_constraint_[a] && ends_constraint_[b] && constraints_.contains(key(a, b));
  }
  Crossing& constraint_of(std::uint32_t a, std::uint32_t b) {  // a fresh one where it has none
    ends_constraint_[a] = ends_constraint_[b] = true;
    return constraints_[key(a, b)];
  }
  std::uint32_t locate(const glm::dvec2& p) const;
  int corner(std::uint32_t t, std::uint32_t vertex) const;
  int side_to(std::uint32_t t, std::uint32_t neighbour) const;
  void replace_neighbour(std::uint32_t t, std::uint32_t from, std::uint32_t to);
  void set(std::uint32_t t, std::array<std::uint32_t, 3> v, std::array<std::uint32_t, 3> n);
  void flip(std::uint32_t t, int i);
  void legalise(std::vector<std::uint32_t> around, std::uint32_t p);
  // The triangle with the directed edge a -> b and the corner opposite to it; kNone if ab is no edge.
  std::pair<std::uint32_t, int> find_edge(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t cut(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  void flip_until_edge(std::uint32_t a, std::uint32_t b, std::vector<Key> crossed);

  std::vector<glm::dvec2> points_;
  std::vector<std::uint32_t> triangle_of_;  // one triangle at each vertex
  std::vector<Triangle> triangles_;
  std::vector<bool> ends_constraint_;    // per vertex: does one start or end there, or did? Spares most look-ups
  std::map<Key, Crossing> constraints_;  // left of smaller -> larger index, to its right
  mutable std::uint32_t last_ = 0;       // where the next search starts: points come in coherent order
};

}  // namespace meniscus
