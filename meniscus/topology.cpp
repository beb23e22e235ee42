#include "meniscus/topology.h"

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "meniscus/edges.h"

namespace meniscus {
namespace {

std::size_t hash(const glm::dvec3& p) {
  std::size_t h = 0;
  for (int i = 0; i < 3; ++i) {
    h = (h ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u;  // + 0.0: -0 equals 0
    h ^= h >> 32;
  }
  return h;
}

// Normals that are unit within single precision stay as they are, to the last bit.
glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  if (std::abs(length - 1) < 1e-6) return v;
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

}  // namespace

Topology weld(const TriangleMesh& mesh, const std::string& name) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("mesh of '" + name + "': " + what + "; export it again or repair it");
  };
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    fail(std::to_string(mesh.normals.size()) + " normals for " + std::to_string(mesh.positions.size()) + " positions");
  }
  Topology result;
  constexpr std::uint32_t kEmpty = 0xffffffff;
  std::vector<std::uint32_t> point(mesh.positions.size());
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), kEmpty);  // open addressing
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      fail("position " + std::to_string(i) + " is not finite");
    }
    std::size_t at = hash(p) & (table.size() - 1);
    while (table[at] != kEmpty && result.points[table[at]] != p) at = (at + 1) & (table.size() - 1);
    if (table[at] == kEmpty) {
      table[at] = static_cast<std::uint32_t>(result.points.size());
      result.points.push_back(p);
    }
    point[i] = table[at];
  }
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      if (t[i] >= point.size()) fail("triangle index " + std::to_string(t[i]) + " is out of range");
    }
    Topology::Triangle triangle{{point[t[0]], point[t[1]], point[t[2]]}, t, {}};
    const glm::uvec3& p = triangle.points;
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    const glm::dvec3 facet = unit(
        glm::cross(result.points[p[1]] - result.points[p[0]], result.points[p[2]] - result.points[p[0]]), {0, 1, 0});
    for (int i = 0; i < 3; ++i) triangle.normals[i] = mesh.normals.empty() ? facet : unit(mesh.normals[t[i]], facet);
    result.triangles.push_back(triangle);
  }
  return result;
}

std::size_t orient_alike(Topology& solid) {
  struct Uses {
    std::uint32_t count = 0, side[2] = {0, 0};  // as 3 * triangle + side
  };
  const auto forward = [&](std::uint32_t use) {
    const glm::uvec3& v = solid.triangles[use / 3].points;
    return v[use % 3] < v[(use + 1) % 3];
  };
  EdgeMap<Uses> uses(3 * solid.triangles.size());
  bool alike = true;
  for (std::uint32_t t = 0; t < solid.triangles.size(); ++t) {
    const glm::uvec3& v = solid.triangles[t].points;
    for (std::uint32_t i = 0; i < 3; ++i) {
      Uses& of = uses[edge(v[i], v[(i + 1) % 3])];
      if (of.count < 2) of.side[of.count] = 3 * t + i;
      ++of.count;
      if (of.count == 2 && forward(of.side[0]) == forward(of.side[1])) alike = false;
    }
  }
  if (alike) return 0;

  std::size_t turned = 0;
  std::vector<int> sense(solid.triangles.size(), 0);
  for (std::uint32_t first = 0; first < solid.triangles.size(); ++first) {
    if (sense[first] != 0) continue;
    std::vector<std::uint32_t> part{first};
    sense[first] = 1;
    double area[2] = {0, 0};
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::uint32_t t = part[k];
      const glm::uvec3& v = solid.triangles[t].points;
      area[sense[t] > 0] += glm::length(solid.area_normal(t));
      for (std::uint32_t i = 0; i < 3; ++i) {
        const Uses& of = uses[edge(v[i], v[(i + 1) % 3])];
        if (of.count != 2) continue;
        const std::uint32_t other = (of.side[0] == 3 * t + i ? of.side[1] : of.side[0]) / 3;
        if (sense[other] != 0) continue;
        sense[other] = forward(of.side[0]) == forward(of.side[1]) ? -sense[t] : sense[t];
        part.push_back(other);
      }
    }
    const int wrong = area[1] >= area[0] ? -1 : 1;
    for (const std::uint32_t t : part) {
      if (sense[t] == wrong) solid.triangles[t].turn(), ++turned;
    }
  }
  return turned;
}

bool orient_outward(Topology& solid) {
  Box box;
  for (const glm::dvec3& p : solid.points) box.add(p);
  const glm::dvec3 centre = 0.5 * (box.low + box.high);  // for open solids the volume is that seen from here
  double volume = 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    volume += glm::dot(solid.corner(t, 0) - centre, solid.area_normal(t));
  }
  const bool turn = volume < 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    Topology::Triangle& triangle = solid.triangles[t];
    if (turn) triangle.turn();
    const glm::dvec3 facet = solid.area_normal(t);
    for (glm::dvec3& normal : triangle.normals) {
      if (glm::dot(normal, facet) < 0) normal = -normal;
    }
  }
  return turn;
}

std::vector<std::uint32_t> free_surface(const Topology& liquid) {
  constexpr double kUp = 1e-3;  // cosine: walls of a box of liquid stay walls in spite of rounding
  std::vector<std::uint32_t> result;
  for (std::size_t t = 0; t < liquid.triangles.size(); ++t) {
    const glm::dvec3 n = liquid.area_normal(t);
    if (n.y > kUp * glm::length(n)) result.push_back(static_cast<std::uint32_t>(t));
  }
  return result;
}

double winding_number(const Topology& solid, const glm::dvec3& p) {
  double angle = 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const glm::dvec3 a = solid.corner(t, 0) - p, b = solid.corner(t, 1) - p, c = solid.corner(t, 2) - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return angle / (4 * glm::pi<double>());
}

}  // namespace meniscus
