#include "meniscus/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace meniscus {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

// A number as an exact sum of non-overlapping doubles, smallest first (Shewchuk 1997, grow-expansion).
// 256 terms hold the determinant of three differences: 3 products of 2 * (2 * 2 * 2) * 2 * 2 terms at most.
class Exact {
 public:
  Exact() = default;
  Exact(double a, double b) {  // a - b
    add(a);
    add(-b);
  }

  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + terms_[i];
      const double part = sum - x;
      const double error = (x - (sum - part)) + (terms_[i] - part);
      if (error != 0) terms_[kept++] = error;
      x = sum;
    }
    if (x != 0) terms_[kept++] = x;
    size_ = kept;
  }

  void add_product(const Exact& a, const Exact& b, double factor) {
    for (std::size_t i = 0; i < a.size_; ++i) {
      for (std::size_t j = 0; j < b.size_; ++j) {
        const double high = a.terms_[i] * b.terms_[j];
        add(factor * std::fma(a.terms_[i], b.terms_[j], -high));
        add(factor * high);
      }
    }
  }

  int sign() const { return size_ == 0 ? 0 : meniscus::sign(terms_[size_ - 1]); }

 private:
  std::array<double, 256> terms_;
  std::size_t size_ = 0;
};

Exact minor(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {  // a d - b c
  Exact result;
  result.add_product(a, d, 1);
  result.add_product(b, c, -1);
  return result;
}

// Sign of component `axis` of (b - a) x (d - c).
int cross_sign(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double left = (b[i] - a[i]) * (d[j] - c[j]), right = (b[j] - a[j]) * (d[i] - c[i]);
  if (std::abs(left - right) > 1e-15 * (std::abs(left) + std::abs(right))) return sign(left - right);
  return minor({b[i], a[i]}, {b[j], a[j]}, {d[i], c[i]}, {d[j], c[j]}).sign();
}

}  // namespace

int orient2d_exactly(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return minor({b.x, a.x}, {b.y, a.y}, {c.x, a.x}, {c.y, a.y}).sign();
}

int orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const glm::dvec3 u = b - a, v = c - a, w = d - a;
  double det = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    det += w[i] * (u[j] * v[k] - u[k] * v[j]);
    size += std::abs(w[i]) * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
  }
  if (std::abs(det) > 2e-15 * size) return sign(det);
  Exact exact;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    exact.add_product(minor({b[j], a[j]}, {b[k], a[k]}, {c[j], a[j]}, {c[k], a[k]}), {d[i], a[i]}, 1);
  }
  return exact.sign();
}

int Shift::tie(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) const {
  if (const int y = cross_sign(a, b, c, d, 1)) return up * y;
  if (const int x = cross_sign(a, b, c, d, 0)) return x;
  return cross_sign(a, b, c, d, 2);
}

// All determinants are linear in the shift s; their derivatives are s . (difference x difference).
int Shift::solid_above_liquid(const glm::dvec3 liquid[3], const glm::dvec3& solid) const {
  const int s = orient3d(liquid[0], liquid[1], liquid[2], solid);
  return s ? s : tie(liquid[0], liquid[1], liquid[0], liquid[2]);
}

int Shift::liquid_before_solid(const glm::dvec3 solid[3], const glm::dvec3& liquid) const {
  const int s = orient3d(solid[0], solid[1], solid[2], liquid);
  return s ? s : -tie(solid[0], solid[1], solid[0], solid[2]);
}

int Shift::edges(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) const {
  const int s = orient3d(a, b, c, d);
  return s ? s : tie(c, d, a, b);  // s . ((d - c) x (b - a))
}

}  // namespace meniscus
