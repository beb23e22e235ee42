#include "tests/support/meniscus/scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/support/meniscus/rods.h"
#include "tests/unit/meniscus_shapes.h"

namespace shapes {
namespace {

using glm::dvec3;
using meniscus::Solid;

constexpr dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

dvec3 mm(double x, double y, double z) { return kMm * dvec3(x, y, z); }
TriangleMesh level(double half = 40, int n = 1) { return sheet(half * kMm, n); }
TriangleMesh cube(double half) { return box(mm(-half, -half, -half), mm(half, half, half)); }
TriangleMesh long_post(double radius = 2, int facets = 96) { return post(radius * kMm, -60 * kMm, 60 * kMm, facets); }
TriangleMesh ball(double radius, double height) { return translated(sphere(radius * kMm, 64, 32), mm(0, height, 0)); }
TriangleMesh tilted(double degrees) { return turned(long_post(), degrees, kZ); }
TriangleMesh ring(double major, double minor) { return torus(major * kMm, minor * kMm, 96, 32); }
TriangleMesh pipe(double inner, double outer) {
  return lathe({{inner * kMm, 20 * kMm}, {inner * kMm, -20 * kMm}, {outer * kMm, -20 * kMm}, {outer * kMm, 20 * kMm}},
               96);
}
TriangleMesh waves(double height, double length, int n = 60) {
  const double k = 2 * glm::pi<double>() / (length * kMm);
  return sheet(40 * kMm, n,
               [=](double x, double z) { return height * kMm * std::sin(k * x + 0.3) * std::cos(0.7 * k * z); });
}

TriangleMesh disc(double radius, int facets) {
  TriangleMesh mesh;
  const auto at = [&](int i) {
    const double a = i % facets == 0 ? 0 : 2 * glm::pi<double>() * i / facets;
    return radius * kMm * dvec3(std::sin(a), 0, std::cos(a));
  };
  for (int i = 0; i < facets; ++i) add_triangle(mesh, dvec3(0), at(i), at(i + 1), kY);
  return mesh;
}

// A chain of rings, lying and standing in turn, each through the next.
std::vector<TriangleMesh> chain(int links) {
  std::vector<TriangleMesh> result;
  for (int i = 0; i < links; ++i) {
    const TriangleMesh link = torus(4 * kMm, 0.6 * kMm, 64, 24);
    const double x = 6 * (i - 0.5 * (links - 1));
    result.push_back(translated(turned(link, i % 2 ? 90 : 8, kX), mm(x, i % 2 ? 0.4 : 0, 0)));
  }
  return result;
}

// A body with a handle at its side and a spout that leaves it below the level: parts that overlap.
TriangleMesh teapot() {
  const auto handle = [](double t) {
    const double a = glm::radians(-115 + 230 * t);
    return mm(11 + 7 * std::cos(a), 3 + 7 * std::sin(a), 0);
  };
  const auto spout = [](double t) { return mm(-6 - 10 * t, -5 + 13 * t * t, 0); };
  return joined({ball(12, 2), rod(handle, kMm, 24, 48),
                 rod(
                     spout, [](double t) { return (3 - 2 * t) * kMm; }, 32, 24)});
}

// Wire that swims: held up at some places, under the surface at others.
TriangleMesh paper_clip(double amplitude, double waves_along) {
  const auto path = clip(kMm);
  return rod(
      [=](double t) {
        return path(t) + dvec3(0, amplitude * kMm * std::cos(2 * glm::pi<double>() * waves_along * t), 0);
      },
      0.4 * kMm, 24, 240);
}
TriangleMesh hair(int facets, int steps) {
  return rod(
      [](double t) {
        const double a = 2 * glm::pi<double>() * t;
        return mm(16 * (t - 0.5), 0.15 * std::cos(3 * a), 2 * std::sin(1.5 * a));
      },
      0.035 * kMm, facets, steps);
}

Scene in(TriangleMesh liquid, const std::vector<TriangleMesh>& solids, double theta = 30) {
  Scene scene{water(std::move(liquid)), {}};
  for (const TriangleMesh& mesh : solids) {
    scene.solids.push_back(solid(mesh, theta, "solid " + std::to_string(scene.solids.size())));
  }
  return scene;
}

std::vector<TriangleMesh> two_posts(double gap) {
  const double x = 2 + 0.5 * gap;
  return {translated(long_post(), mm(-x, 0, 0.01)), translated(long_post(), mm(x, 0, -0.02))};
}

TriangleMesh with_slivers(TriangleMesh mesh) {  // doubled, flat and needle-like triangles besides the good ones
  const dvec3 p = mesh.positions[mesh.triangles[0].x], q = mesh.positions[mesh.triangles[0].y];
  add_triangle(mesh, p, q, 0.5 * (p + q), kY);
  add_triangle(mesh, q, p, 0.5 * (p + q), kY);
  add_triangle(mesh, p, p, q, kY);
  return mesh;
}

TriangleMesh with_mixed_windings(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t].x, mesh.triangles[t].y);
  return mesh;
}

TriangleMesh doubled(TriangleMesh mesh) {
  const auto once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  return mesh;
}

TriangleMesh without_top(TriangleMesh mesh, double y) {
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    return mesh.positions[t.x].y > y && mesh.positions[t.y].y > y && mesh.positions[t.z].y > y;
  });
  return mesh;
}

std::vector<Case> make_cases() {
  std::vector<Case> result;
  const auto add = [&](const std::string& name, std::function<Scene()> make, Expected expected) -> Case& {
    result.push_back({name, std::move(make), std::move(expected)});
    return result.back();
  };
  const Expected one{1, 0, 1, 2};
  const std::string pinned = "pinned", snapped = "points of its border lie within";

  add(
      "Post", [] { return in(level(), {long_post()}); }, one);
  add(
      "PostNonWetting", [] { return in(level(), {long_post()}, 140); }, one);
  for (const int tilt : {15, 30, 45, 60, 75}) {
    add(
        "PostTilted" + std::to_string(tilt), [=] { return in(level(50), {tilted(tilt)}); }, one);
    add(
        "PostTilted" + std::to_string(tilt) + "NonWetting", [=] { return in(level(50), {tilted(tilt)}, 110); }, one);
  }
  add(
      "ConeUp",
      [] {
        return in(level(), {revolve([](double y) { return (20 * kMm - y) * 0.3; }, -20 * kMm, 19.9 * kMm, 64, 8)});
      },
      one);
  add(
      "ConeDown",
      [] {
        return in(level(), {revolve([](double y) { return (20 * kMm + y) * 0.3; }, -19.9 * kMm, 20 * kMm, 64, 8)});
      },
      one);
  for (const int depth : {-90, -50, 0, 50, 90}) {
    const std::string name = (depth < 0 ? "SphereRaised" : "SphereLowered") + std::to_string(std::abs(depth));
    add(
        name, [=] { return in(level(), {ball(5, -0.05 * depth)}); }, one);
    add(
        name + "NonWetting", [=] { return in(level(), {ball(5, -0.05 * depth)}, 120); }, one);
  }
  add(
      "Cube", [] { return in(level(), {cube(5)}); }, one);
  add(
      "CubeTurned", [] { return in(level(), {turned(cube(5), 45, kY)}); }, one);
  add(
      "CubeOnEdge", [] { return in(level(), {turned(cube(5), 45, kX)}); }, one);
  add(
      "CubeOnCorner", [] { return in(level(), {turned(turned(cube(5), 45, kX), 35.2644, kZ)}); }, one);
  add(
      "Star", [] { return in(level(), {star(5, 3 * kMm, 8 * kMm, -20 * kMm, 20 * kMm)}); }, one);
  add(
      "StarSharp", [] { return in(level(), {star(9, 2 * kMm, 9 * kMm, -20 * kMm, 20 * kMm)}); }, one);
  add(
      "StarTilted",
      [] {
        return in(level(),
                  {turned(star(5, 3 * kMm, 8 * kMm, -40 * kMm, 40 * kMm), 25, glm::normalize(dvec3(1, 0, 2)))});
      },
      one);
  add(
      "HelixStanding", [] { return in(level(), {rod(helix(5 * kMm, 9 * kMm, 3, -13 * kMm), 0.8 * kMm, 24, 180)}); },
      one);
  add("HelixLying",
      [] { return in(level(), {turned(rod(helix(3 * kMm, 7 * kMm, 4.25, -15 * kMm), 0.6 * kMm, 24, 240), 90, kZ)}); },
      {9, 0, 1, 10});
  add("TorusLying", [] { return in(level(), {ring(8, 3)}, 60); }, {2, 0, 2, 3});
  add("TorusLyingDeep", [] { return in(level(), {translated(ring(8, 3), mm(0.1, -2, 0.2))}, 60); }, {2, 0, 2, 3});
  add("TorusStanding", [] { return in(level(), {turned(ring(8, 2), 90, kX)}); }, {2, 0, 1, 3});
  add(
      "TorusStandingLow", [] { return in(level(), {translated(turned(ring(8, 2), 90, kX), mm(0, 8, 0))}); }, one);
  add("TorusTilted", [] { return in(level(), {turned(ring(8, 2), 60, kX)}); }, {2, 0, 1, 3});
  add("TorusTiltedLittle", [] { return in(level(), {turned(ring(8, 2), 20, kX)}); }, {2, 0, 1, 3});
  add("Tube", [] { return in(level(), {pipe(4, 5)}); }, {2, 0, 2, 3});
  add("TubeTilted", [] { return in(level(), {turned(pipe(4, 5), 30, kX)}); }, {2, 0, 2, 3});
  add("TubeThin", [] { return in(level(), {pipe(0.5, 0.6)}); }, {2, 0, 2, 3});
  add("RingChain", [] { return in(level(), chain(5)); }, {10, 0, 4, 11});
  add("Needles", [] { return in(level(30), needles(8, 12 * kMm, 0.3 * kMm, 60 * kMm, 30, 2.5 * kMm)); }, {8, 0, 1, 9});
  add("ThousandNeedles",
      [] { return in(level(120, 40), needles(1000, 110 * kMm, 0.2 * kMm, 40 * kMm, 30, 1.5 * kMm)); },
      {1000, 0, 1, 1001})
      .slow = true;
  for (const double gap : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    add("TwoPosts" + std::to_string(static_cast<int>(10 * gap)) + "Tenths", [=] { return in(level(), two_posts(gap)); },
        {2, 0, 1, 3});
  }
  add("PostsTouch",
      [] {
        return in(level(), {translated(long_post(), mm(-2, 0, 0)), translated(long_post(), mm(2, 0, 0))});
      },
      {2, 0, 1, 3});
  add("PostsOverlap",
      [] {
        return in(level(), {translated(long_post(), mm(-1.5, 0, 0)), translated(long_post(), mm(1.5, 0, 0))});
      },
      {2, 0, 1, 2});
  add("CubesFaceToFace",
      [] {
        return in(level(), {translated(cube(4), mm(-4, 0, 0)), translated(cube(4), mm(4, 0, 0))});
      },
      {2, 0, 1, 2});
  add("CubesEdgeToEdge",
      [] {
        return in(level(), {translated(cube(4), mm(-4, 0, -4)), translated(cube(4), mm(4, 0, 4))});
      },
      {2, 0, 1, 3});
  add("CrossOfBars",
      [] {
        return in(level(), {box(mm(-8, -9, -2), mm(8, 9, 2)), box(mm(-2, -8, -8), mm(2, 8, 8))});
      },
      {2, 0, 1, 2});
  add(
      "PostInWaves", [] { return in(waves(0.5, 12), {long_post()}); }, one);
  add(
      "TiltedPostInWaves", [] { return in(waves(0.5, 12), {tilted(30)}); }, one);
  add(
      "BallInWaves", [] { return in(waves(1, 20), {ball(5, 1)}); }, one);
  add(
      "PostInSteepWaves", [] { return in(waves(1.5, 9, 120), {long_post()}); }, one);
  add(
      "PostInSlope",
      [] { return in(sheet(40 * kMm, 4, [](double x, double z) { return 0.35 * x + 0.1 * z; }), {long_post()}); }, one);
  add(
      "PostInSteepSlope",
      [] { return in(sheet(40 * kMm, 4, [](double x, double) { return 1.2 * x; }), {long_post(2)}); }, one);
  add(
      "PostInFineLiquid", [] { return in(level(40, 120), {long_post()}); }, one);
  add("Teapot", [] { return in(level(), {teapot()}); }, {3, 0, 1, 3});
  add(
      "PaperClip", [] { return in(level(), {paper_clip(0.2, 2)}); }, one);
  add("PaperClipBent", [] { return in(level(), {paper_clip(1.2, 2)}); }, {4, 0, 1, 5});
  add("Hair", [] { return in(level(), {hair(12, 240)}); }, {6, 0, 1, 7});
  add("CupOfLiquid", [] { return in(sheet(8.3 * kMm, 16), {cup(8 * kMm, 12 * kMm, -10 * kMm, 8 * kMm)}); },
      {1, 0, 1, 1});
  add("CupWithPost",
      [] {
        return in(sheet(12 * kMm, 1), {cup(11 * kMm, 18 * kMm, -10 * kMm, 12 * kMm), long_post(2)});
      },
      {2, 0, 1, 2});
  add("CupSwims", [] { return in(level(), {cup(8 * kMm, 9 * kMm, -5 * kMm, 8 * kMm)}); }, {2, 0, 2, 3});
  add("TrayOfSheet", [] { return in(level(20.3), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)}); }, {1, 0, 1, 1});
  add("TrayOfLiquid",
      [] {
        return in(box(mm(-20.3, -10.3, -20.3), mm(20.3, 0, 20.3)), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)});
      },
      {1, 0, 2, 2});
  add("TrayOfExactSheet", [] { return in(level(20), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)}); },
      {1, 0, 1, 1, 0, {snapped}});
  add("TrayOfExactLiquid",
      [] { return in(box(mm(-20, -10, -20), mm(20, 0, 20)), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)}); },
      {1, 0, 2, 2, 0, {snapped}});
  add("TrayOfSmallSheet", [] { return in(level(19.95), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)}); },
      {1, 0, 1, 1, 0, {snapped}});
  add("TrayOfSmallerSheet", [] { return in(level(19.8), {tray(20 * kMm, 2 * kMm, -10 * kMm, 10 * kMm)}); },
      {0, 0, 1, 1});
  add("CupOfExactDisc", [] { return in(disc(8, 96), {cup(8 * kMm, 12 * kMm, -10 * kMm, 8 * kMm)}); },
      {1, 0, 1, 1, 0, {snapped}});
  add("TrayOfAll",
      [] {
        return in(level(31),
                  {tray(30 * kMm, 2 * kMm, -20 * kMm, 12 * kMm), translated(long_post(), mm(-20, 0, -20)),
                   translated(ring(5, 1.5), mm(15, 0, 15)), translated(turned(cube(4), 30, kY), mm(-15, 0, 12)),
                   translated(ball(4, 1), mm(15, 0, -12)), translated(tilted(30), mm(0, 0, -10)),
                   translated(pipe(2, 3), mm(-3, 0, 20))});
      },
      {9, 0, 3, 9});
  add("PostAtBorder", [] { return in(level(), {translated(long_post(), mm(39, 0, 3))}); }, {1, 1, 1, 1});
  add("WallAcross", [] { return in(level(20), {box(mm(-30, -9, -1), mm(30, 9, 1))}); }, {2, 2, 2, 2});
  add("PostInBlock", [] { return in(box(mm(-30, -60, -30), mm(30, 0, 30)), {long_post()}); }, {1, 0, 1, 1});
  add("PostAtBlocksBorder",
      [] { return in(box(mm(-30, -60, -30), mm(30, 0, 30)), {translated(long_post(), mm(29, 0, 3))}); }, {1, 1, 1, 1});
  add(
      "PostThroughGrid", [] { return in(level(8, 8), {box(mm(-2, -9, -2), mm(2, 9, 2))}); }, one);
  add("SlabAtLevel", [] { return in(level(), {box(mm(-5, -5, -4), mm(5, 0, 4))}, 90); },
      {1, 0, 1, 2, 0, {"exactly at the level"}});
  add("BoxOnBox",
      [] {
        return in(level(), {box(mm(-5, -9, -5), mm(5, 0, 5)), box(mm(-3, 0, -3), mm(3, 9, 3))});
      },
      {2, 0, 1, 2, 0, {"exactly at the level", "exactly at the level", pinned}});
  add(
      "PostInsideOut", [] { return in(level(), {inside_out(long_post())}); }, one);
  add(
      "PostWithSlivers", [] { return in(level(), {with_slivers(long_post())}); }, one);
  add(
      "PostOfDoubledFacets", [] { return in(level(), {doubled(long_post())}); }, one);
  add("TwoBoxesOnOneEdge",
      [] {
        return in(level(), {joined({box(mm(-5, -9, -5), mm(0, 9, 0)), box(mm(0, -9, 0), mm(5, 9, 5))})});
      },
      {2, 0, 1, 3});
  add(
      "OpenPost", [] { return in(level(), {without_top(long_post(), 59 * kMm)}); }, one)
      .ill = true;
  add(
      "HullWithoutThickness", [] { return in(level(), {without_top(box(mm(-5, -4, -5), mm(5, 6, 5)), 5 * kMm)}); }, one)
      .ill = true;
  add("Plate",
      [] {
        TriangleMesh plate;
        add_triangle(plate, mm(-1, -5, 0), mm(1, -5, 0), mm(0, 5, 0), kZ);
        return in(level(), {plate});
      },
      {0, 0, 1, 1, 0, {"open where it meets"}})
      .ill = true;
  add("MixedWindings", [] { return in(level(), {with_mixed_windings(ball(5, 1))}); },
      {1, 0, 1, 2, 0, {"face the other way than their neighbours"}})
      .ill = true;
  add("CurlingWave",
      [] {
        TriangleMesh wave = level(40, 80);
        for (dvec3& p : wave.positions) {
          p += dvec3(7 * kMm * std::sin(p.x / (4 * kMm) + 1), 0.6 * p.x, 0);
        }
        wave.normals.clear();
        return in(wave, {long_post()});
      },
      {0, 0, 1, 1, 0, {"lies over itself"}})
      .ill = true;
  add("SheetOfSolidAcross",
      [] {
        TriangleMesh wall;
        add_triangle(wall, mm(-90, -90, 1), mm(90, -90, 1), mm(90, 90, 1), kZ);
        add_triangle(wall, mm(-90, -90, 1), mm(90, 90, 1), mm(-90, 90, 1), kZ);
        return in(level(), {wall});
      },
      {1, 1, 1, 1, 0, {"solid 0' is open: which side"}})
      .ill = true;
  const std::vector<std::pair<std::string, Held>> held{{"PostTilted60", {45, 0}},
                                                       {"PostTilted75", {65, 0}},
                                                       {"PostTilted75NonWetting", {75, 0}},
                                                       {"CubeOnCorner", {0, 75}},
                                                       {"HelixStanding", {80, 60}},
                                                       {"HelixLying", {3, 20}},
                                                       {"TorusTiltedLittle", {10, 60}},
                                                       {"TorusStandingLow", {0, 15}},
                                                       {"RingChain", {100, 100}},
                                                       {"Teapot", {0, 20}},
                                                       {"Needles", {0, 60}},
                                                       {"ThousandNeedles", {0, 100}},
                                                       {"PaperClip", {100, 5}},
                                                       {"PaperClipBent", {80, 70}},
                                                       {"Hair", {100, 75}},
                                                       {"TrayOfAll", {100, 0}},
                                                       {"SheetOfSolidAcross", {0, 15}}};
  for (const auto& [name, share] : held) {
    for (Case& c : result)
      if (c.name == name) c.held = share;
  }
  // A wall's large facet divided along one edge; a sheet of solid whose other side has no columns.
  for (Case& c : result) c.thin = c.name == "PostAtBlocksBorder" || c.name == "SheetOfSolidAcross";
  return result;
}

template <class Change>
Scene changed(Scene scene, Change change) {
  for (dvec3& p : scene.liquid.mesh.positions) p = change(p);
  for (Solid& s : scene.solids) {
    for (dvec3& p : s.mesh.positions) p = change(p);
  }
  return scene;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = make_cases();
  return all;
}

Scene scaled(Scene scene, double factor) {
  scene.liquid.capillary_length *= factor;
  return changed(std::move(scene), [=](const dvec3& p) { return factor * p; });
}

Scene rounded_at(Scene scene, const dvec3& place) {
  return changed(std::move(scene), [=](const dvec3& p) { return (p + place) - place; });
}

}  // namespace shapes
