// Scenes of any number of triangles, made here: light from above through water on a floor.
#pragma once

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "host/cli/render_settings.h"
#include "host/render/gpu_backend.h"

namespace meniscal::bench {

struct Setup {
  Scene scene;
  World world;
  RenderSettings settings;
};

// Height of the water round a post that presses it down by 1.5 mm at its radius of 2 mm; m. An exponential will do.
inline double dent(double r) { return -1.5e-3 * std::exp((2e-3 - r) / 2.7e-3); }

// A grid of rows x columns quads of points vertex(u, v), u and v in [0, 1].
template <class Vertex>
meniscus::TriangleMesh grid(std::uint32_t rows, std::uint32_t columns, const Vertex& vertex) {
  meniscus::TriangleMesh mesh;
  constexpr double step = 1e-5;
  for (std::uint32_t i = 0; i <= rows; ++i)
    for (std::uint32_t j = 0; j <= columns; ++j) {
      const double u = double(i) / rows, v = double(j) / columns;
      mesh.positions.push_back(vertex(u, v));
      mesh.normals.push_back(glm::normalize(
          glm::cross(vertex(u, v + step) - vertex(u, v - step), vertex(u + step, v) - vertex(u - step, v))));
    }
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = i * (columns + 1) + j, b = a + columns + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({a + 1, b + 1, b});
    }
  return mesh;
}

inline Object object(const char* name, meniscus::TriangleMesh mesh, int material) {
  Object object;
  object.name = name;
  object.mesh = std::move(mesh);
  object.has_file_normals = true;
  object.material = material;
  return object;
}

// The dented water, of about `triangles` triangles, and a floor 50 mm below.
inline Scene dented_water(std::size_t triangles) {
  Scene scene;
  scene.file = "benchmark";
  Material water, floor;
  water.name = "water", floor.name = "floor";
  water.metallic = water.roughness = 0;
  water.transmission = 1;
  water.ior = 1.333;
  water.target = true;
  floor.base_color = glm::dvec3(0.5);
  floor.metallic = 0;
  scene.materials = {water, floor};
  const auto side = static_cast<std::uint32_t>(std::sqrt(double(triangles) / 2));
  scene.objects.push_back(object("water",
                                 grid(side, side,
                                      [](double u, double v) {
                                        const double r = 2e-3 + 12e-3 * u, a = v * glm::two_pi<double>();
                                        return glm::dvec3(r * std::cos(a), dent(r), r * std::sin(a));
                                      }),
                                 0));
  scene.objects.push_back(
      object("floor",
             grid(1, 1, [](double u, double v) { return glm::dvec3(0.12 * (u - 0.5), -0.05, -0.12 * (v - 0.5)); }), 1));
  Camera camera;
  camera.orthographic = true;
  camera.xmag = camera.ymag = 12.2e-3;
  camera.pose = glm::dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, -0.004, 0, 1});
  scene.cameras = {camera};
  PunctualLight sun;
  sun.type = PunctualLight::Type::directional;
  sun.direction = {0, -1, 0};
  scene.lights = {sun};
  return scene;
}

// The same with a rod of `facets` long quads, 4 mm thick, at 45 degrees from the floor through the water.
inline Scene rod_in_water(std::size_t triangles, std::uint32_t facets, std::uint32_t rows) {
  Scene scene = dented_water(triangles);
  scene.objects.push_back(object("rod",
                                 grid(rows, facets,
                                      [](double u, double v) {
                                        const double a = v * glm::two_pi<double>(), s = 0.12 * (u - 0.5);
                                        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 1, 0)), across(0, 0, 1),
                                                         up = glm::cross(across, axis);
                                        return s * axis + 2e-3 * (std::cos(a) * across + std::sin(a) * up);
                                      }),
                                 1));
  return scene;
}

inline std::unique_ptr<Setup> make_setup(Scene scene, std::uint32_t photons, int side = 512) {
  RenderOptions options;
  options.meniscus = MeniscusModel::none;
  options.photons = photons;
  options.resolution = Resolution{side, side};
  World world = build_world(scene, options.meniscus);
  RenderSettings settings = choose_settings(options, scene, world);
  return std::make_unique<Setup>(Setup{std::move(scene), std::move(world), std::move(settings)});
}

}  // namespace meniscal::bench
