#include "tests/support/meniscus/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace surfaces {

using glm::dvec3;

namespace {

double distance_to(const TriangleMesh& mesh, const dvec3& x) {
  double least = 1e300;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    bool over = true;
    for (int i = 0; i < 3; ++i) {
      const dvec3 e = p[(i + 1) % 3] - p[i];
      over = over && glm::dot(glm::cross(e, x - p[i]), n) >= 0;
      const double s = glm::clamp(glm::dot(x - p[i], e) / glm::dot(e, e), 0.0, 1.0);
      least = std::min(least, glm::distance(x, p[i] + s * e));
    }
    if (over) least = std::min(least, std::abs(glm::dot(x - p[0], n)) / glm::length(n));
  }
  return least;
}

}  // namespace

Report expect_sound(const Surface& surface, double least_angle) {
  const TriangleMesh& mesh = surface.mesh;
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(surface.meniscus.size(), mesh.triangles.size());
  std::vector<bool> used(mesh.positions.size(), false);
  std::size_t down = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) used[v[i]] = true;
    down += surface.meniscus[t] &&
            glm::cross(mesh.positions[v.y] - mesh.positions[v.x], mesh.positions[v.z] - mesh.positions[v.x]).y <= 0;
  }
  EXPECT_EQ(down, 0u) << "meniscus triangles face down";
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; })) << "unused vertices";
  for (const dvec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-9);
  std::set<std::vector<double>> distinct;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const dvec3 p = mesh.positions[i], n = mesh.normals[i];
    distinct.insert({p.x, p.y, p.z, n.x, n.y, n.z});
  }
  EXPECT_EQ(distinct.size(), mesh.positions.size()) << "duplicate vertices";
  const Report report = meniscus::inspect(mesh);
  EXPECT_EQ(report.rejected, 0u);
  EXPECT_EQ(report.genus, 0);
  EXPECT_GT(report.smallest_angle, least_angle);
  return report;
}

double plan_area(const Surface& surface, bool meniscus_only) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (meniscus_only && !surface.meniscus[t]) continue;
    const glm::uvec3& v = surface.mesh.triangles[t];
    const auto& p = surface.mesh.positions;
    sum += 0.5 * glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]).y;
  }
  return sum;
}

std::set<std::size_t> contact_vertices(const Surface& surface, const Report& report, double half) {
  std::set<std::size_t> result;
  for (const auto& [a, b] : report.boundary) {
    for (const std::size_t v : {a, b}) {
      const dvec3 p = surface.mesh.positions[v];
      if (std::max(std::abs(p.x), std::abs(p.z)) < half * (1 - 1e-9)) result.insert(v);
    }
  }
  return result;
}

void expect_contact_on(const TriangleMesh& solid, const Surface& surface, const Report& report, double half) {
  const auto contacts = contact_vertices(surface, report, half);
  EXPECT_GE(contacts.size(), 48u);
  double worst = 0;
  for (const std::size_t v : contacts) worst = std::max(worst, distance_to(solid, surface.mesh.positions[v]));
  EXPECT_LT(worst, 1e-7) << "metres between contact line and solid";
}

}  // namespace surfaces
