#include "host/reference/tracer.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace meniscal::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool meets_box(const Ray& ray, const glm::dvec3& low, const glm::dvec3& high, double reach) {
  double near = 0, far = reach;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (low[axis] - ray.origin[axis]) / ray.direction[axis];
    double b = (high[axis] - ray.origin[axis]) / ray.direction[axis];
    if (a > b) std::swap(a, b);
    // Written so that the NaN of a ray inside a box's flat side keeps the interval.
    if (a > near) near = a;
    if (b < far) far = b;
  }
  return near <= far * (1 + 1e-12);
}

}  // namespace

struct Tracer::Nearest {
  double t;
  std::uint32_t triangle = no_triangle;
  double u = 0, v = 0;
};

Tracer::Tracer(const World& world) : world_(world), order_(world.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t Tracer::build(std::uint32_t first, std::uint32_t count) {
  Node node{glm::dvec3(infinity), glm::dvec3(-infinity), first, count, 0};
  for (std::uint32_t i = first; i < first + count; ++i)
    for (const glm::dvec3& c : world_.triangles[order_[i]].corner) {
      node.low = glm::min(node.low, c);
      node.high = glm::max(node.high, c);
    }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (count <= 4) return index;

  const glm::dvec3 size = node.high - node.low;
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const auto key = [&](std::uint32_t t) {
    const auto& c = world_.triangles[t].corner;
    return c[0][axis] + c[1][axis] + c[2][axis];
  };
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  build(first, half);
  const std::uint32_t right = build(first + half, count - half);
  nodes_[index].right = right;
  return index;
}

void Tracer::visit(std::uint32_t index, const Ray& ray, std::uint32_t skip, Nearest& nearest) const {
  const Node& node = nodes_[index];
  if (!meets_box(ray, node.low, node.high, nearest.t)) return;
  if (node.right != 0) {
    visit(index + 1, ray, skip, nearest);
    visit(node.right, ray, skip, nearest);
    return;
  }
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    if (order_[i] == skip) continue;
    const auto& corner = world_.triangles[order_[i]].corner;
    // Cramer's rule: origin + t direction = (1 - u - v) a + u b + v c.
    const glm::dvec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0], s = ray.origin - corner[0];
    const double determinant = glm::dot(ab, glm::cross(ray.direction, ac));
    if (determinant == 0) continue;
    const double u = glm::dot(s, glm::cross(ray.direction, ac)) / determinant;
    const double v = glm::dot(ray.direction, glm::cross(s, ab)) / determinant;
    const double t = glm::dot(ac, glm::cross(s, ab)) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest.t) nearest = {t, order_[i], u, v};
  }
}

std::optional<Hit> Tracer::closest(const Ray& ray, double reach, std::uint32_t skip) const {
  ++rays_;
  Nearest nearest{reach};
  visit(0, ray, skip, nearest);
  if (nearest.triangle == no_triangle) return std::nullopt;
  const WorldTriangle& t = world_.triangles[nearest.triangle];
  const double w = 1 - nearest.u - nearest.v;
  return Hit{nearest.t, nearest.triangle, w * t.corner[0] + nearest.u * t.corner[1] + nearest.v * t.corner[2],
             glm::normalize(w * t.normal[0] + nearest.u * t.normal[1] + nearest.v * t.normal[2])};
}

}  // namespace meniscal::reference
