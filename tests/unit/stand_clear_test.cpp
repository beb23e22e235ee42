// Cameras on surfaces.
#include "host/render/stand_clear.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/world/triangles.h"

namespace meniscal {
namespace {

// A floor and a wall that stands on it, 2 m wide.
World corner() {
  World world;
  meniscus::TriangleMesh mesh;
  mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 2, -1}, {1, 2, -1}};
  mesh.normals.assign(6, {0, 1, 0});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  append(world.triangles, mesh, {});
  world.radius = radius_of(world.triangles);
  return world;
}

TEST(StandClear, LeavesAlonePointsInTheOpen) {
  const glm::dvec3 point(0.3, 0.5, 0.2);
  EXPECT_EQ(stand_clear(corner(), point), point);
}

TEST(StandClear, StepsInFrontOfTheFaceItLiesOn) {
  const glm::dvec3 clear = stand_clear(corner(), {0.3, 0, 0.2});
  EXPECT_GT(clear.y, 1e-6);
  EXPECT_LT(clear.y, 1e-5);
  EXPECT_EQ(clear.x, 0.3);
}

TEST(StandClear, StepsOffBothFacesOfACorner) {
  const glm::dvec3 clear = stand_clear(corner(), {0.3, 0, -1});
  EXPECT_GT(clear.y, 1e-6);
  EXPECT_GT(clear.z + 1, 1e-6);
  EXPECT_LT(glm::length(clear - glm::dvec3(0.3, 0, -1)), 1e-4);
}

}  // namespace
}  // namespace meniscal
