// Solids and liquids for the tests of the meniscus library, in metres.
#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "meniscus/meniscus.h"

namespace shapes {

using meniscus::TriangleMesh;
constexpr double kMm = 1e-3;
constexpr double kWater = 2.727072 * kMm;  // capillary length

inline void add_triangle(TriangleMesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         const glm::dvec3& normal) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  for (const glm::dvec3& p : {a, b, c}) mesh.positions.push_back(p), mesh.normals.push_back(normal);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

struct TubeEnd {
  glm::dvec3 centre, normal;
};
// Joins `rings` + 1 rings of `facets` vertices each, which are all the mesh has, to a closed solid with flat ends.
inline void close_tube(TriangleMesh& mesh, int facets, int rings, const TubeEnd& start, const TubeEnd& end) {
  const auto at = [&](int i, int j) { return static_cast<unsigned>(j * facets + i % facets); };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < facets; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  for (int i = 0; i < facets; ++i) {
    const glm::dvec3 a = mesh.positions[at(i, 0)], b = mesh.positions[at(i + 1, 0)];
    const glm::dvec3 c = mesh.positions[at(i, rings)], d = mesh.positions[at(i + 1, rings)];
    add_triangle(mesh, b, a, start.centre, start.normal);
    add_triangle(mesh, c, d, end.centre, end.normal);
  }
}

// A closed surface of revolution about +Y with smooth normals on its side and flat caps; radius(y) from y0 to y1.
inline TriangleMesh revolve(const std::function<double(double)>& radius, double y0, double y1, int facets, int rings) {
  TriangleMesh mesh;
  const double h = 1e-6 * (y1 - y0);
  for (int j = 0; j <= rings; ++j) {
    const double y = y0 + (y1 - y0) * j / rings;
    const double slope =
        (radius(std::min(y + h, y1)) - radius(std::max(y - h, y0))) / (std::min(y + h, y1) - std::max(y - h, y0));
    for (int i = 0; i < facets; ++i) {
      const double a = 2 * glm::pi<double>() * i / facets;
      mesh.positions.push_back({radius(y) * std::sin(a), y, radius(y) * std::cos(a)});
      mesh.normals.push_back(glm::normalize(glm::dvec3(std::sin(a), -slope, std::cos(a))));
    }
  }
  close_tube(mesh, facets, rings, {{0, y0, 0}, {0, -1, 0}}, {{0, y1, 0}, {0, 1, 0}});
  return mesh;
}

inline TriangleMesh post(double radius, double y0, double y1, int facets) {
  return revolve([=](double) { return radius; }, y0, y1, facets, 1);
}

inline TriangleMesh sphere(double radius, int facets, int rings) {
  TriangleMesh mesh;
  const auto at = [=](int i, int j) {
    return j == 0 ? 0u : j == rings ? 1u : static_cast<unsigned>(2 + (j - 1) * facets + i % facets);
  };
  mesh.positions = {{0, -radius, 0}, {0, radius, 0}};
  for (int j = 1; j < rings; ++j) {
    const double b = glm::pi<double>() * j / rings;
    for (int i = 0; i < facets; ++i) {
      const double a = 2 * glm::pi<double>() * i / facets;
      mesh.positions.push_back(radius * glm::dvec3(std::sin(b) * std::sin(a), -std::cos(b), std::sin(b) * std::cos(a)));
    }
  }
  for (const glm::dvec3& p : mesh.positions) mesh.normals.push_back(p / radius);
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < facets; ++i) {
      if (j > 0) mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      if (j + 1 < rings) mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

// A closed profile (radius, y) turned about +Y; it must run so that the solid lies to its left. Sharp rings, smooth
// around.
inline TriangleMesh lathe(const std::vector<glm::dvec2>& profile, int facets) {
  TriangleMesh mesh;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const glm::dvec2 a = profile[k], b = profile[(k + 1) % profile.size()],
                     n = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
    if (a.x == 0 && b.x == 0) continue;
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (int i = 0; i <= facets; ++i) {
      const double w = i == facets ? 0 : 2 * glm::pi<double>() * i / facets;
      for (const glm::dvec2& p : {a, b}) {
        mesh.positions.push_back({p.x * std::sin(w), p.y, p.x * std::cos(w)});
        mesh.normals.push_back({n.x * std::sin(w), n.y, n.x * std::cos(w)});
      }
    }
    for (unsigned i = 0; i < static_cast<unsigned>(facets); ++i) {
      const unsigned p = first + 2 * i;
      if (a.x > 0) mesh.triangles.emplace_back(p, p + 2, p + 1);
      if (b.x > 0) mesh.triangles.emplace_back(p + 1, p + 2, p + 3);
    }
  }
  return mesh;
}
inline TriangleMesh cup(double inner, double outer, double floor, double rim) {
  return lathe({{0, floor - 2 * kMm}, {outer, floor - 2 * kMm}, {outer, rim}, {inner, rim}, {inner, floor}, {0, floor}},
               96);
}
inline TriangleMesh torus(double major, double minor, int facets, int rings) {
  std::vector<glm::dvec2> profile;
  for (int k = 0; k < rings; ++k) {
    const double w = 2 * glm::pi<double>() * (k + 0.25) / rings;
    profile.emplace_back(major + minor * std::cos(w), minor * std::sin(w));
  }
  return lathe(profile, facets);
}

// A vertical prism over a polygon (z, x), counter-clockwise from above; flat-shaded.
inline TriangleMesh prism(const std::vector<glm::dvec2>& polygon, double y0, double y1) {
  TriangleMesh mesh;
  const auto at = [](const glm::dvec2& p, double y) { return glm::dvec3(p.y, y, p.x); };
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % n];
    const glm::dvec3 normal = glm::normalize(at({b.y - a.y, a.x - b.x}, 0));
    add_triangle(mesh, at(a, y0), at(b, y0), at(b, y1), normal);
    add_triangle(mesh, at(a, y0), at(b, y1), at(a, y1), normal);
    add_triangle(mesh, at({0, 0}, y1), at(a, y1), at(b, y1), {0, 1, 0});
    add_triangle(mesh, at({0, 0}, y0), at(b, y0), at(a, y0), {0, -1, 0});
  }
  return mesh;
}
inline TriangleMesh star(int points, double inner, double outer, double y0, double y1) {
  std::vector<glm::dvec2> polygon;
  for (int i = 0; i < 2 * points; ++i) {
    const double w = glm::pi<double>() * i / points + 0.1, r = i % 2 ? inner : outer;
    polygon.emplace_back(r * std::cos(w), r * std::sin(w));
  }
  return prism(polygon, y0, y1);
}

// Flat-shaded.
inline TriangleMesh box(const glm::dvec3& low, const glm::dvec3& high) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      glm::dvec3 n(0), p[4];
      n[axis] = side ? 1 : -1;
      for (int k = 0; k < 4; ++k) {
        p[k][axis] = side ? high[axis] : low[axis];
        p[k][u] = (k == 1 || k == 2) ? high[u] : low[u];
        p[k][v] = k >= 2 ? high[v] : low[v];
      }
      if (!side) std::swap(p[1], p[3]);
      add_triangle(mesh, p[0], p[1], p[2], n);
      add_triangle(mesh, p[0], p[2], p[3], n);
    }
  }
  return mesh;
}

// A square tray, flat-shaded: walls of thickness `wall` round the square of half-width `half`.
inline TriangleMesh tray(double half, double wall, double floor, double rim) {
  TriangleMesh mesh;
  const auto at = [](double h, int k, double y) {
    return glm::dvec3(k == 2 || k == 3 ? h : -h, y, k == 1 || k == 2 ? h : -h);
  };
  const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    add_triangle(mesh, a, b, c, n);
    add_triangle(mesh, a, c, d, n);
  };
  const double outer = half + wall, bottom = floor - wall;
  for (int k = 0; k < 4; ++k) {
    const int l = (k + 1) % 4;
    quad(at(outer, l, bottom), at(outer, l, rim), at(outer, k, rim), at(outer, k, bottom));
    quad(at(half, k, floor), at(half, k, rim), at(half, l, rim), at(half, l, floor));
    quad(at(outer, k, rim), at(outer, l, rim), at(half, l, rim), at(half, k, rim));
  }
  quad(at(half, 0, floor), at(half, 1, floor), at(half, 2, floor), at(half, 3, floor));
  quad(at(outer, 3, bottom), at(outer, 2, bottom), at(outer, 1, bottom), at(outer, 0, bottom));
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const glm::dmat4& m) {
  for (glm::dvec3& p : mesh.positions) p = glm::dvec3(m * glm::dvec4(p, 1));
  for (glm::dvec3& n : mesh.normals) n = glm::normalize(glm::dvec3(m * glm::dvec4(n, 0)));
  return mesh;
}
inline TriangleMesh translated(const TriangleMesh& mesh, const glm::dvec3& by) {
  return moved(mesh, glm::translate(glm::dmat4(1), by));
}
inline TriangleMesh turned(const TriangleMesh& mesh, double degrees, const glm::dvec3& axis) {
  return moved(mesh, glm::rotate(glm::dmat4(1), glm::radians(degrees), axis));
}
inline TriangleMesh scaled(TriangleMesh mesh, double s) {
  for (glm::dvec3& p : mesh.positions) p *= s;
  return mesh;
}
inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (glm::dvec3& n : mesh.normals) n = -n;
  return mesh;
}

// A square sheet of n x n cells with half-width `half`, facing up, shaped by height(x, z).
inline TriangleMesh sheet(
    double half, int n, const std::function<double(double, double)>& height = [](double, double) { return 0.0; }) {
  TriangleMesh mesh;
  const double h = 1e-4 * half;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = half * (2.0 * i / n - 1), z = half * (2.0 * j / n - 1);
      mesh.positions.push_back({x, height(x, z), z});
      mesh.normals.push_back(glm::normalize(glm::dvec3((height(x - h, z) - height(x + h, z)) / (2 * h), 1,
                                                       (height(x, z - h) - height(x, z + h)) / (2 * h))));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<unsigned>(j * (n + 1) + i), b = a + 1, c = a + static_cast<unsigned>(n) + 1, d = c + 1;
      mesh.triangles.emplace_back(a, c, d);
      mesh.triangles.emplace_back(a, d, b);
    }
  }
  return mesh;
}

inline meniscus::Liquid water(TriangleMesh mesh) {
  meniscus::Liquid liquid{};
  liquid.name = "water", liquid.mesh = std::move(mesh), liquid.capillary_length = kWater;
  liquid.height_scale = liquid.sweep_scale = 1;
  return liquid;
}
inline meniscus::Solid solid(TriangleMesh mesh, double degrees, const std::string& name = "solid") {
  return {name, std::move(mesh), glm::radians(degrees)};
}

}  // namespace shapes
