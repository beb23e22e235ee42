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

// Square of the sine of the smallest angle, which lies between the two longer edges.
double thinness(const Topology& mesh, std::size_t t) {
  const glm::dvec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
  const double ab = glm::dot(b - a, b - a), bc = glm::dot(c - b, c - b), ca = glm::dot(a - c, a - c);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  return glm::dot(n, n) / (ab * bc * ca / std::min({ab, bc, ca}));
}

}  // namespace

Seams find_seams(const TriangleMesh& mesh) {
  const Topology welded = weld({mesh.positions, {}, mesh.triangles}, "surface");
  Seams seams;
  seams.sound = welded.triangles.size() == mesh.triangles.size();
  // Half-edges by the point where they start, as 3 * triangle + side: the last one of each, and the one before each.
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> last(welded.points.size(), kNone), before(3 * welded.triangles.size());
  const auto end = [&](std::uint32_t h) { return welded.triangles[h / 3].points[(h % 3 + 1) % 3]; };
  const auto leads = [&](std::uint32_t from, std::uint32_t to) {
    std::uint32_t h = last[from];
    while (h != kNone && end(h) != to) h = before[h];
    return h != kNone;
  };
  for (std::uint32_t h = 0; h < before.size(); ++h) {
    const std::uint32_t from = welded.triangles[h / 3].points[h % 3];
    seams.sound = seams.sound && !leads(from, end(h));
    before[h] = last[from], last[from] = h;
  }
  for (std::uint32_t h = 0; h < before.size(); ++h) {
    const Topology::Triangle& t = welded.triangles[h / 3];
    if (!leads(end(h), t.points[h % 3])) seams.boundary.emplace_back(t.vertices[h % 3], t.vertices[(h % 3 + 1) % 3]);
  }
  return seams;
}

Report inspect(const TriangleMesh& mesh) {
  using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;
  const Quiet quiet;
  const Topology welded = weld({mesh.positions, {}, mesh.triangles}, "surface");
  std::vector<std::size_t> position(welded.points.size());
  HalfEdges half_edges;
  half_edges.reserve(welded.points.size(), 3 * welded.triangles.size() / 2, welded.triangles.size());
  std::vector<HalfEdges::VertexHandle> handles;
  for (std::size_t i = 0; i < welded.points.size(); ++i) handles.push_back(half_edges.add_vertex({0, 0, 0}));

  Report report;
  report.rejected = mesh.triangles.size() - welded.triangles.size();
  double thinnest = welded.triangles.empty() ? 0 : 1;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const Topology::Triangle& triangle = welded.triangles[t];
    for (int i = 0; i < 3; ++i) position[triangle.points[i]] = triangle.vertices[i];
    const auto& p = triangle.points;
    if (!half_edges.add_face(handles[p[0]], handles[p[1]], handles[p[2]]).is_valid()) ++report.rejected;
    thinnest = std::min(thinnest, thinness(welded, t));
  }
  report.smallest_angle = glm::degrees(std::asin(std::sqrt(thinnest)));

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
