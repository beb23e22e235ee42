// The patch of the liquid meshed anew: contact lines, band and what is left of the liquid's points in one
// triangulation, in two parts: outside the solids and inside.
#pragma once

#include <optional>
#include <vector>

#include "meniscus/band.h"
#include "meniscus/bond.h"
#include "meniscus/triangulate.h"
#include "meniscus/warning.h"

namespace meniscus {

struct Sheet {
  struct Vertex {
    glm::dvec2 x{};
    Foot foot;                              // distance 0 and the node's own side for contact vertices
    Foot other;                             // on a crease: the second foot, as near
    const Node* node = nullptr;             // of a contact vertex
    std::optional<std::uint32_t> original;  // welded point of the liquid
    std::optional<Edge> border;             // lies on this border edge of the liquid
    bool crossing = false;                  // of two contact lines
  };
  std::vector<Vertex> vertices;
  std::vector<glm::uvec3> triangles;  // counter-clockwise from above
  std::vector<bool> raised;           // per triangle: on a meniscus
  std::vector<glm::uvec3> within;     // the same, inside solids
  std::vector<Edge> drowned;          // edges of the patch's border that lie inside a solid
  bool overlaps = false;              // the patch lies over itself in projection: nothing of this is of use

  // The line from which triangle t is raised.
  std::size_t line_of(std::size_t t) const { return vertices[triangles[t][off_crease(t)]].foot.line; }
  // Does the corner k of triangle t, on a crease, lie on the side of the vertex's other foot?
  bool across(std::size_t t, int k) const {
    const Vertex &v = vertices[triangles[t][k]], &beside = vertices[triangles[t][off_crease(t)]];
    const glm::dvec2 way = beside.foot.direction;
    return v.other.exists() && glm::dot(way, v.other.direction) > glm::dot(way, v.foot.direction);
  }

 private:
  // A corner that is not on a crease, if there is one.
  int off_crease(std::size_t t) const {
    for (int k = 0; k < 3; ++k)
      if (!vertices[triangles[t][k]].other.exists()) return k;
    return 0;
  }
};

Sheet remesh(const Topology& liquid, const Patch& patch, const std::vector<ContactLine>& lines,
             const std::vector<Body>& bodies, double sweep_length, double reach, Warnings& warnings);

}  // namespace meniscus
