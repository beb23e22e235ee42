#include "meniscus/stitch.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <unordered_map>

#include "meniscus/edges.h"
#include "meniscus/inside.h"
#include "meniscus/predicates.h"

namespace meniscus {
namespace {

class Assembly {
 public:
  explicit Assembly(const Topology& liquid)
      : liquid_(liquid), known_(liquid.points.size()), ending_(liquid.points.size(), false) {}

  Stitched result;

  std::uint32_t add(const glm::dvec3& position, const glm::dvec3& normal, bool may_end) {
    result.mesh.positions.push_back(position);
    result.mesh.normals.push_back(normal);
    result.may_end.push_back(may_end);
    return static_cast<std::uint32_t>(result.mesh.positions.size() - 1);
  }

  // One vertex for each point of the liquid and normal there.
  std::uint32_t of_liquid(std::uint32_t point, const glm::dvec3& normal) {
    auto& known = known_[point];
    for (const std::uint32_t v : known) {
      if (result.mesh.normals[v] == normal) return v;
    }
    const std::uint32_t v = add(position(point), normal, ending_[point]);
    known.push_back(v);
    return v;
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool meniscus, std::size_t line = 0) {
    result.mesh.triangles.emplace_back(a, b, c);
    result.line.push_back(line);
    result.meniscus.push_back(meniscus);
  }

  struct Divided {  // a point on an edge of the liquid, its part of the way from the smaller point index
    double at;
    glm::dvec3 position;
  };
  std::map<Edge, std::vector<Divided>> divided;

  void move(std::uint32_t point, const glm::dvec3& to) { moved_[point] = to; }
  glm::dvec3 position(std::uint32_t point) const {
    const auto moved = moved_.find(point);
    return moved == moved_.end() ? liquid_.points[point] : moved->second;
  }

  // A triangle of the free surface inside a solid.
  void within(const std::array<glm::dvec3, 3>& positions, const std::array<glm::dvec3, 3>& normals) {
    TriangleMesh& mesh = result.within;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
    mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  void set_ending(std::uint32_t point) { ending_[point] = true; }

  // An untouched triangle; a wall whose edge was divided becomes a fan.
  void untouched(const Topology::Triangle& t) {
    std::array<std::uint32_t, 3> v;
    std::array<std::vector<std::uint32_t>, 3> on;  // new vertices along the edge from corner i to the next
    for (int i = 0; i < 3; ++i) v[i] = of_liquid(t.points[i], t.normals[i]);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t.points[i], b = t.points[(i + 1) % 3];
      const auto found = divided.find(edge(a, b));
      if (found == divided.end()) continue;
      for (const Divided& d : found->second) on[i].push_back(add(d.position, t.normals[i], true));
      if (b < a) std::reverse(on[i].begin(), on[i].end());
    }
    fan(v, on);
  }

 private:
  void fan(std::array<std::uint32_t, 3> v, std::array<std::vector<std::uint32_t>, 3> on) {
    for (int i = 0; i < 3; ++i) {
      if (on[i].empty()) continue;
      const std::uint32_t apex = v[(i + 2) % 3];
      std::vector<std::uint32_t> chain{v[i]};
      chain.insert(chain.end(), on[i].begin(), on[i].end());
      chain.push_back(v[(i + 1) % 3]);
      for (std::size_t k = 0; k + 1 < chain.size();
           ++k) {  // the other edges keep what divides them, at both ends of the fan
        std::array<std::vector<std::uint32_t>, 3> rest;
        if (k + 2 == chain.size()) rest[1] = on[(i + 1) % 3];
        if (k == 0) rest[2] = on[(i + 2) % 3];
        fan({chain[k], chain[k + 1], apex}, rest);
      }
      return;
    }
    triangle(v[0], v[1], v[2], false);
  }

  const Topology& liquid_;
  std::vector<std::vector<std::uint32_t>> known_;  // vertices of each point
  std::unordered_map<std::uint32_t, glm::dvec3> moved_;
  std::vector<bool> ending_;  // points on the liquid's own border
};

}  // namespace

Stitched stitch(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch,
                const Sheet& sheet, const Raised& raised, const std::vector<Body>& bodies) {
  Assembly assembly(liquid);
  std::vector<std::uint32_t> all(liquid.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  const EdgeMap<int> uses = count_edges(liquid, all, [](std::uint32_t) { return 1; });
  for (std::size_t t = 0; t < liquid.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = liquid.triangles[t].points[i], b = liquid.triangles[t].points[(i + 1) % 3];
      if (*uses.get(edge(a, b)) == 1) assembly.set_ending(a), assembly.set_ending(b);
    }
  }

  for (std::size_t i = 0; i < sheet.vertices.size(); ++i) {
    if (!raised.used[i]) continue;
    const Sheet::Vertex& vertex = sheet.vertices[i];
    if (vertex.original) assembly.move(*vertex.original, raised.at[i].position);
    if (vertex.border) {
      const glm::dvec2 a = planar(liquid.points[vertex.border->first]),
                       b = planar(liquid.points[vertex.border->second]);
      assembly.divided[*vertex.border].push_back({glm::dot(vertex.x - a, b - a), raised.at[i].position});
    }
  }
  for (auto& [key, points] : assembly.divided) {
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  }

  const std::vector<bool> drowned = find_drowned(liquid, surface, patch, sheet.drowned, bodies);
  for (std::uint32_t t = 0; t < liquid.triangles.size(); ++t) {
    if (patch.contains(t)) continue;
    const Topology::Triangle& triangle = liquid.triangles[t];
    if (!drowned[t]) {
      assembly.untouched(triangle);
      continue;
    }
    std::array<glm::dvec3, 3> positions, normals;
    for (int k = 0; k < 3; ++k) positions[k] = assembly.position(triangle.points[k]), normals[k] = triangle.normals[k];
    assembly.within(positions, normals);
  }
  for (const glm::uvec3& t : sheet.within) {
    std::array<glm::dvec3, 3> positions, normals;
    for (int k = 0; k < 3; ++k) positions[k] = raised.at[t[k]].position, normals[k] = raised.base[t[k]].normal;
    assembly.within(positions, normals);
  }
  constexpr std::uint32_t kNone = 0xffffffff;
  std::array<std::vector<std::uint32_t>, 2> index;  // of each vertex, and on creases of that with the other normal
  for (auto& i : index) i.assign(sheet.vertices.size(), kNone);
  const auto corner = [&](std::size_t t, int k) {
    const std::uint32_t i = sheet.triangles[t][k];
    const bool across = sheet.across(t, k) && raised.across[i] != raised.at[i].normal;
    std::uint32_t& v = index[across][i];
    if (v != kNone) return v;
    const Sheet::Vertex& vertex = sheet.vertices[i];
    const Lifted& at = raised.at[i];
    v = vertex.original && !vertex.node ? assembly.of_liquid(*vertex.original, at.normal)
                                        : assembly.add(at.position, across ? raised.across[i] : at.normal,
                                                       vertex.node || vertex.border || vertex.crossing);
    if (vertex.node) assembly.result.may_end[v] = true;
    return v;
  };
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const std::uint32_t a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    assembly.triangle(a, b, c, sheet.raised[t], sheet.line_of(t));
  }
  return std::move(assembly.result);
}

}  // namespace meniscus
