#include "meniscus/check.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "meniscus/topology.h"

namespace meniscus {
namespace {

// OpenMesh reports a face it cannot take on its error stream; the report says it better.
class Quiet {
 public:
  Quiet() : enabled_(omerr().is_enabled()) { omerr().disable(); }
  ~Quiet() {
    if (enabled_) omerr().enable();
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  const bool enabled_;
};

double smallest_angle(const Topology& mesh, std::size_t t) {
  double least = glm::pi<double>();
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 p = mesh.corner(t, i), a = mesh.corner(t, (i + 1) % 3) - p, b = mesh.corner(t, (i + 2) % 3) - p;
    least = std::min(least, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
  }
  return glm::degrees(least);
}

}  // namespace

Report inspect(const TriangleMesh& mesh) {
  using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;
  const Quiet quiet;
  const Topology welded = weld({mesh.positions, {}, mesh.triangles}, "surface");
  std::vector<std::size_t> position(welded.points.size());
  HalfEdges half_edges;
  std::vector<HalfEdges::VertexHandle> handles;
  for (std::size_t i = 0; i < welded.points.size(); ++i) handles.push_back(half_edges.add_vertex({0, 0, 0}));

  Report report;
  report.rejected = mesh.triangles.size() - welded.triangles.size();
  report.smallest_angle = welded.triangles.empty() ? 0 : 180;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const Topology::Triangle& triangle = welded.triangles[t];
    for (int i = 0; i < 3; ++i) position[triangle.points[i]] = triangle.vertices[i];
    const auto& p = triangle.points;
    if (!half_edges.add_face(handles[p[0]], handles[p[1]], handles[p[2]]).is_valid()) ++report.rejected;
    report.smallest_angle = std::min(report.smallest_angle, smallest_angle(welded, t));
  }

  std::vector<bool> seen(half_edges.n_halfedges(), false);
  for (const auto start : half_edges.halfedges()) {
    if (!start.is_boundary() || seen[start.idx()]) continue;
    ++report.boundary_loops;
    for (auto h = start; !seen[h.idx()]; h = h.next()) {
      seen[h.idx()] = true;
      report.boundary.emplace_back(position[h.from().idx()], position[h.to().idx()]);
    }
  }
  std::vector<bool> reached(half_edges.n_vertices(), false);
  long vertices = 0;
  for (const auto start : half_edges.vertices()) {
    if (reached[start.idx()] || !start.halfedge().is_valid()) continue;
    ++report.components;
    std::vector<OpenMesh::SmartVertexHandle> stack{start};
    reached[start.idx()] = true;
    while (!stack.empty()) {
      const auto v = stack.back();
      stack.pop_back();
      ++vertices;
      for (const auto next : v.vertices()) {
        if (!reached[next.idx()]) stack.push_back(next);
        reached[next.idx()] = true;
      }
    }
  }
  const long euler = vertices - static_cast<long>(half_edges.n_edges()) + static_cast<long>(half_edges.n_faces());
  report.genus = (2 * static_cast<long>(report.components) - static_cast<long>(report.boundary_loops) - euler) / 2;
  return report;
}

}  // namespace meniscus
