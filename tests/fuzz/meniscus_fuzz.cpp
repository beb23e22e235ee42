// A few solids in a liquid, made of a fuzzer's bytes: a surface whose numbers are usable, or the std::invalid_argument
// that meniscus::build promises.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "meniscus/meniscus.h"
#include "tests/fuzz/bytes.h"

namespace {

using meniscal::fuzz::Bytes;
using meniscal::fuzz::require;
using meniscus::TriangleMesh;

constexpr double kSize = 0.05;  // half the liquid's extent, metres

// A prism of 3 to 10 sides about the Y axis, radius and height 1, as wide at its upper end as said.
TriangleMesh prism(unsigned sides, double upper) {
  TriangleMesh mesh;
  for (const double end : {-1.0, 1.0})
    for (unsigned i = 0; i < sides; ++i) {
      const double angle = 2 * glm::pi<double>() * i / sides, radius = end < 0 ? 1 : upper;
      mesh.positions.emplace_back(radius * std::sin(angle), end, radius * std::cos(angle));
    }
  for (unsigned i = 0; i < sides; ++i) {
    const unsigned j = (i + 1) % sides;
    mesh.triangles.emplace_back(i, j, sides + j);
    mesh.triangles.emplace_back(i, sides + j, sides + i);
    if (i >= 2) mesh.triangles.emplace_back(0, i, i - 1), mesh.triangles.emplace_back(sides, sides + i - 1, sides + i);
  }
  return mesh;
}

// Reads in order, whatever the compiler's order of arguments: an input is the same scene everywhere.
TriangleMesh prism(Bytes& bytes) {
  const unsigned sides = 3 + bytes.below(8);
  return prism(sides, bytes.step(0, 2));
}

// A level sheet of n x n squares that faces up.
TriangleMesh sheet(unsigned n) {
  TriangleMesh mesh;
  for (unsigned i = 0; i <= n; ++i)
    for (unsigned j = 0; j <= n; ++j)
      mesh.positions.emplace_back(kSize * (2.0 * i / n - 1), 0, kSize * (2.0 * j / n - 1));
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j) {
      const unsigned a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  return mesh;
}

TriangleMesh soup(Bytes& bytes) {
  TriangleMesh mesh;
  const unsigned points = 3 + bytes.below(8), triangles = 1 + bytes.below(12);
  for (unsigned i = 0; i < points; ++i) {
    const double x = bytes.step(-1, 1), y = bytes.step(-1, 1);
    mesh.positions.emplace_back(x, y, bytes.step(-1, 1));
  }
  for (unsigned i = 0; i < triangles; ++i) {
    const unsigned a = bytes.below(points), b = bytes.below(points);
    mesh.triangles.emplace_back(a, b, bytes.below(points));
  }
  return mesh;
}

void place(TriangleMesh& mesh, Bytes& bytes) {
  const double wide = bytes.step(0.001, 0.03), high = bytes.step(0.001, 0.03), deep = bytes.step(0.001, 0.03);
  const double x = bytes.step(-kSize, kSize), y = bytes.step(-0.02, 0.02), z = bytes.step(-kSize, kSize);
  const double lean = bytes.step(0, glm::pi<double>()), turn = bytes.step(0, glm::pi<double>());
  glm::dmat4 to_world = glm::translate(glm::dmat4(1), glm::dvec3(x, y, z));
  to_world = glm::rotate(to_world, turn, glm::dvec3(0, 1, 0));
  to_world = glm::rotate(to_world, lean, glm::dvec3(1, 0, 0));
  to_world = glm::scale(to_world, glm::dvec3(wide, high, deep));
  for (glm::dvec3& p : mesh.positions) p = glm::dvec3(to_world * glm::dvec4(p, 1));
}

void disturb(TriangleMesh& mesh, Bytes& bytes, double most) {
  const unsigned count = bytes.below(4);
  for (unsigned i = 0; i < count; ++i) {
    glm::dvec3& p = mesh.positions[bytes.byte() % mesh.positions.size()];
    const int axis = static_cast<int>(bytes.below(3));
    p[axis] += bytes.step(-most, most);
  }
}

meniscus::Solid solid(Bytes& bytes) {
  const unsigned kind = bytes.below(4);
  TriangleMesh mesh = kind == 0 ? soup(bytes) : prism(bytes);
  place(mesh, bytes);
  if (kind == 3) disturb(mesh, bytes, 0.01);
  return {"solid", std::move(mesh), bytes.step(0, glm::pi<double>())};
}

meniscus::Liquid liquid(Bytes& bytes) {
  const unsigned kind = bytes.below(4);
  TriangleMesh mesh = kind == 1 ? prism(bytes) : sheet(1 + bytes.below(6));
  if (kind == 1)
    for (glm::dvec3& p : mesh.positions) p = glm::dvec3(kSize * p.x, 0.01 * (p.y - 1), kSize * p.z);
  if (kind == 2) disturb(mesh, bytes, 0.005);
  meniscus::Liquid result{"liquid", std::move(mesh), 1e-3 * std::pow(10, bytes.step(0, 1.5))};
  result.height_rule = static_cast<meniscus::HeightRule>(bytes.below(3));
  result.profile = static_cast<meniscus::Profile>(bytes.below(4));  // the paper's
  const unsigned kind_of_profile = bytes.below(4);
  result.flatten = kind_of_profile == 1;
  if (kind_of_profile == 3) result.profile = meniscus::Profile::solved;
  result.tolerance = 100;  // fewer triangles, more inputs
  return result;
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_usable(const meniscus::Surface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  require(mesh.normals.size() == mesh.positions.size() && surface.meniscus.size() == mesh.triangles.size());
  for (const glm::dvec3& p : mesh.positions) require(is_finite(p));
  for (const glm::dvec3& n : mesh.normals) require(std::abs(glm::length(n) - 1) < 1e-5);
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) require(t[k] < mesh.positions.size());
  for (const meniscus::Contact& c : surface.contacts)
    require(std::isfinite(c.length) && std::isfinite(c.rise_min) && std::isfinite(c.rise_max));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const meniscus::Liquid water = liquid(bytes);
  std::vector<meniscus::Solid> solids;
  while (solids.size() < 3 && !bytes.empty()) solids.push_back(solid(bytes));
  try {
    require_usable(meniscus::build(water, solids));
  } catch (const std::invalid_argument&) {  // which names what is not usable
  }
  return 0;
}
