// A mesh whose vertices are welded by position, with what the search for contours needs: oriented solids, the free
// surface.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/mesh.h"
#include "meniscus/tree.h"

namespace meniscus {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // of welded points, the smaller first
inline Edge edge(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Triangles index `points`, their corners keep their own normals. Triangles with two corners in one point are left out.
struct Topology {
  struct Triangle {
    glm::uvec3 points;    // into Topology::points
    glm::uvec3 vertices;  // into the mesh it came from
    glm::dvec3 normals[3];

    // Round the other way; the normals stay.
    void turn() {
      std::swap(points[1], points[2]), std::swap(vertices[1], vertices[2]), std::swap(normals[1], normals[2]);
    }
  };
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;

  glm::dvec3 corner(std::size_t triangle, int i) const { return points[triangles[triangle].points[i]]; }
  // Twice the area times the unit normal.
  glm::dvec3 area_normal(std::size_t triangle) const {
    return glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
  }
  Box box(std::size_t triangle) const {
    Box b;
    for (int i = 0; i < 3; ++i) b.add(corner(triangle, i));
    return b;
  }
};

// Welds points of exactly equal position; missing normals become facet normals, all are made unit length.
// Throws std::invalid_argument, naming the object, where an index, a position or the number of normals is unusable.
Topology weld(const TriangleMesh& mesh, const std::string& name);

// Turns triangles so that neighbours across an edge of two go round the same way, the smaller area of each connected
// part to the larger. Returns how many were turned.
std::size_t orient_alike(Topology& solid);

// Turns the solid inside out if it encloses a negative volume, and every normal to its facet's side.
// Returns whether it had to be turned.
bool orient_outward(Topology& solid);

// The free surface of a liquid: those of its triangles that face up, as indices into Topology::triangles.
std::vector<std::uint32_t> free_surface(const Topology& liquid);

// Generalised winding number of the solid about p: 1 inside, 0 outside, in between near holes (Van Oosterom, Strackee
// 1983).
double winding_number(const Topology& solid, const glm::dvec3& p);

}  // namespace meniscus
