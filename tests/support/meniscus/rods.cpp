#include "tests/support/meniscus/rods.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/unit/meniscus_shapes.h"

namespace shapes {

using glm::dvec3;

TriangleMesh rod(const std::function<dvec3(double)>& curve, const std::function<double(double)>& radius, int facets,
                 int steps) {
  TriangleMesh mesh;
  const auto tangent = [&](double t) {
    const double h = 1e-4 / steps;
    return glm::normalize(curve(std::min(t + h, 1.0)) - curve(std::max(t - h, 0.0)));
  };
  dvec3 side = std::abs(tangent(0).y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  for (int j = 0; j <= steps; ++j) {
    const double t = static_cast<double>(j) / steps;
    const dvec3 way = tangent(t);
    side = glm::normalize(side - glm::dot(side, way) * way);
    const dvec3 other = glm::cross(way, side);
    for (int i = 0; i < facets; ++i) {
      const double a = 2 * glm::pi<double>() * (i + 0.37) / facets;
      const dvec3 n = std::cos(a) * side + std::sin(a) * other;
      mesh.positions.push_back(curve(t) + radius(t) * n);
      mesh.normals.push_back(n);
    }
  }
  close_tube(mesh, facets, steps, {curve(0), -tangent(0)}, {curve(1), tangent(1)});
  return mesh;
}

TriangleMesh rod(const std::function<dvec3(double)>& curve, double radius, int facets, int steps) {
  return rod(
      curve, [=](double) { return radius; }, facets, steps);
}

std::function<dvec3(double)> helix(double radius, double pitch, double turns, double y0) {
  return [=](double t) {
    const double a = 2 * glm::pi<double>() * turns * t;
    return dvec3(radius * std::cos(a), y0 + pitch * turns * t, radius * std::sin(a));
  };
}

std::function<dvec3(double)> clip(double size) {
  // Straight runs joined by half circles, each bend narrower than the one before.
  struct Run {
    double x0, x1, z;
  };
  static const Run runs[] = {{4, 22, 4}, {22, 0, -4}, {0, 18, 2.4}, {18, 8, -2.4}};
  struct Piece {
    double length;
    std::function<dvec3(double)> at;
  };
  std::vector<Piece> pieces;
  for (int k = 0; k < 4; ++k) {
    const Run r = runs[k];
    pieces.push_back({std::abs(r.x1 - r.x0), [=](double t) { return dvec3(r.x0 + t * (r.x1 - r.x0), 0, r.z); }});
    if (k == 3) break;
    const double radius = 0.5 * std::abs(runs[k + 1].z - r.z), middle = 0.5 * (runs[k + 1].z + r.z);
    const double out = r.x1 > r.x0 ? 1 : -1, up = r.z > middle ? 1 : -1;
    pieces.push_back({glm::pi<double>() * radius, [=](double t) {
                        const double a = glm::pi<double>() * t;
                        return dvec3(r.x1 + out * radius * std::sin(a), 0, middle + up * radius * std::cos(a));
                      }});
  }
  double total = 0;
  for (const Piece& p : pieces) total += p.length;
  return [=](double t) {
    double way = t * total;
    for (const Piece& p : pieces) {
      if (way <= p.length || &p == &pieces.back()) {
        return size * (p.at(std::min(way / p.length, 1.0)) - dvec3(11, 0, 0));
      }
      way -= p.length;
    }
    return dvec3(0);
  };
}

std::vector<TriangleMesh> needles(int count, double half, double radius, double length, double slant, double apart) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<dvec3> feet;
  std::vector<TriangleMesh> result;
  while (static_cast<int>(feet.size()) < count) {
    const dvec3 foot(half * (2 * uniform() - 1), 0, half * (2 * uniform() - 1));
    const double off = glm::radians(slant) * uniform(), round = 2 * glm::pi<double>() * uniform();
    if (std::any_of(feet.begin(), feet.end(), [&](const dvec3& p) { return glm::distance(p, foot) < apart; })) continue;
    feet.push_back(foot);
    const dvec3 way(std::sin(off) * std::cos(round), std::cos(off), std::sin(off) * std::sin(round));
    result.push_back(rod([=](double t) { return foot + (t - 0.5) * length * way; }, radius, 12, 1));
  }
  return result;
}

TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
  TriangleMesh all;
  for (const TriangleMesh& part : parts) {
    const auto first = static_cast<unsigned>(all.positions.size());
    all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
    all.normals.insert(all.normals.end(), part.normals.begin(), part.normals.end());
    for (const glm::uvec3& t : part.triangles) all.triangles.push_back(t + first);
  }
  return all;
}

}  // namespace shapes
