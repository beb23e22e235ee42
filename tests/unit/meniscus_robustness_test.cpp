// Generated scenes: the surface must be sound and have the expected topology, at every scale and place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meniscus/check.h"
#include "tests/support/meniscus/scenes.h"
#include "tests/support/meniscus/soundness.h"

using meniscus::Surface;
using shapes::Case;
using shapes::Scene;

namespace {

double size_of(const meniscus::TriangleMesh& mesh) {
  meniscus::Box box;
  for (const glm::dvec3& p : mesh.positions) box.add(p);
  return glm::length(box.high - box.low);
}

void expect_topology(const Surface& surface, const shapes::Expected& expected) {
  const meniscus::Report report = meniscus::inspect(surface.mesh);
  EXPECT_EQ(report.rejected, 0u) << "triangles make the surface non-manifold";
  EXPECT_EQ(surface.contacts.size(), expected.contours);
  EXPECT_EQ(std::count_if(surface.contacts.begin(), surface.contacts.end(), [](const auto& c) { return !c.closed; }),
            static_cast<long>(expected.open));
  EXPECT_EQ(report.components, expected.components);
  EXPECT_EQ(report.boundary_loops, expected.loops);
  EXPECT_EQ(report.genus, expected.genus);
}

// 1000 where the warning does not say that.
int percent_after(const std::string& what, const std::string& warning) {
  const std::size_t at = warning.find(what);
  return at == std::string::npos ? 1000 : std::stoi(warning.substr(at + what.size()));
}

void expect_warnings(const Surface& surface, const Case& scene) {
  std::vector<std::string> expected = scene.expected.warnings;
  for (const std::string& warning : surface.warnings) {
    if (percent_after("is pinned along ", warning) <= scene.held.pinned) continue;
    if (percent_after("is lowered along ", warning) <= scene.held.lowered) continue;
    const auto known = std::find_if(expected.begin(), expected.end(),
                                    [&](const auto& part) { return warning.find(part) != std::string::npos; });
    if (known == expected.end()) {
      ADD_FAILURE() << "unexpected warning: " << warning;
    } else {
      expected.erase(known);
    }
  }
  for (const std::string& part : expected) ADD_FAILURE() << "no warning says: " << part;
}

// `scale` is that of the scene: lengths in metres are for 1.
void expect_sound(const Surface& surface, const Scene& scene, bool thin, double scale) {
  const auto& mesh = surface.mesh;
  EXPECT_EQ(soundness::self_intersections(mesh), 0u);
  if (!thin) {
    EXPECT_GE(soundness::smallest_new_angle(mesh, scene.liquid.mesh), 1);
  }
  std::vector<soundness::Shell> shells;
  double size = scale;  // 1e-7 of a solid's size, or 0.1 um
  for (const meniscus::Solid& s : scene.solids) {
    shells.emplace_back(s.mesh);
    size = std::max(size, size_of(s.mesh));
  }
  std::vector<bool> raised(mesh.positions.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) raised[mesh.triangles[t][i]] = raised[mesh.triangles[t][i]] || surface.meniscus[t];
  }
  double farthest = 0;
  for (const std::size_t v : soundness::contact_vertices(mesh, scene.liquid.mesh)) {
    const auto within = [&](const auto& shell) { return shell.winding(mesh.positions[v]) != 0; };
    // The walls of a closed liquid end within the solid that holds it.
    if (!raised[v] && std::any_of(shells.begin(), shells.end(), within)) continue;
    double least = 1e300;
    for (const auto& shell : shells) {
      if (shell.box().distance(mesh.positions[v]) < least) {
        least = std::min(least, shell.distance(mesh.positions[v]));
      }
    }
    farthest = std::max(farthest, least);
  }
  EXPECT_LE(farthest, 1e-7 * size) << "metres between the surface's edge and the solids";
  EXPECT_LE(soundness::deepest_within(surface, shells), 1e-5 * scale) << "metres that menisci run within solids";
}

void expect_coverage(const Scene& scene) {
  Scene flat = scene;
  flat.liquid.height_scale = 0;
  const Surface surface = build(flat.liquid, flat.solids);
  std::vector<soundness::Shell> shells;
  for (const meniscus::Solid& s : scene.solids) shells.emplace_back(s.mesh);
  const auto coverage = soundness::cover(surface.mesh, scene.liquid.mesh, shells, 4e-3 * scene.liquid.capillary_length);
  EXPECT_GT(coverage.asked, 1000u);
  EXPECT_EQ(coverage.wrong, 0u) << "of " << coverage.asked << " points, as (" << coverage.example.x << ", "
                                << coverage.example.y << ", " << coverage.example.z << ")";
}

class Generated : public testing::TestWithParam<Case> {};

TEST_P(Generated, IsSound) {
  const Scene scene = GetParam().make();
  const Surface surface = build(scene.liquid, scene.solids);
  expect_topology(surface, GetParam().expected);
  expect_warnings(surface, GetParam());
  expect_sound(surface, scene, GetParam().thin, 1);
  if (!GetParam().ill) expect_coverage(scene);
}

TEST_P(Generated, SweepOfScalesAndPlaces) {
  const Scene scene = GetParam().make();
  for (const double scale : {1e-3, 1e3}) {
    SCOPED_TRACE(scale);
    const Scene other = scaled(scene, scale);
    const Surface surface = build(other.liquid, other.solids);
    expect_topology(surface, GetParam().expected);
    expect_warnings(surface, GetParam());
    expect_sound(surface, other, GetParam().thin, scale);
  }
  SCOPED_TRACE("far away");
  const Scene other = rounded_at(scene, {1e4, -300, -7e3});
  const Surface surface = build(other.liquid, other.solids);
  expect_topology(surface, GetParam().expected);
  expect_sound(surface, other, GetParam().thin, 1);
}

std::string name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

std::vector<Case> chosen(bool slow) {
  std::vector<Case> result;
  for (const Case& c : shapes::cases()) {
    if (c.slow == slow) result.push_back(c);
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Generated, testing::ValuesIn(chosen(false)), name);
INSTANTIATE_TEST_SUITE_P(Sweep, Generated, testing::ValuesIn(chosen(true)), name);

}  // namespace
