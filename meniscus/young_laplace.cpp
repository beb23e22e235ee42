#include "meniscus/young_laplace.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace meniscus {
namespace {

enum class Wall { post, tube };

// Height per slope of the linearised equation at radius r: K0 / K1 round a post, I0 / I1 within a tube.
double linear_rise(Wall wall, double r) {
  if (r > 100) {  // where the Bessel functions leave the range of a double: their asymptotic series
    const double x = wall == Wall::post ? 1 / r : -1 / r;
    return 1 - x / 2 + 3 * x * x / 8 - 3 * x * x * x / 8;
  }
  return wall == Wall::post ? std::cyl_bessel_k(0, r) / std::cyl_bessel_k(1, r)
                            : std::cyl_bessel_i(0, r) / std::cyl_bessel_i(1, r);
}

// About ln K1 and ln I1: how the slope of the linearised equation falls off with the distance from the wall.
double log_slope(Wall wall, double r) {
  return wall == Wall::post ? 0.5 * std::log(glm::half_pi<double>() / r + 1 / (r * r)) - r
                            : r + std::log(r / 2) - 0.5 * std::log(1 + glm::half_pi<double>() * r * r * r);
}

// The radius at which the slope is e^change times that at r.
double where_slope_changes(Wall wall, double r, double change) {
  const double wanted = log_slope(wall, r) + change;
  double low = std::log(r), high = low;
  const double step = wall == Wall::post ? 1 : -1;  // the slope falls away from the wall
  while ((log_slope(wall, std::exp(high)) > wanted) && std::abs(high - low) < 50) high += step;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (log_slope(wall, std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

struct Point {
  double radius, height;
};

// Change of a meniscus' point with ln u, u = tan(slope / 2), in which the level far away and the overhang are both far
// off. Along the arc towards the wall: d slope / ds = height +- sin(slope) / radius, d height / ds = sin(slope),
// d radius / ds = -+cos(slope).
Point change(Wall wall, const Point& p, double u) {
  const double sine = 2 * u / (1 + u * u), cosine = (1 - u * u) / (1 + u * u), sense = wall == Wall::post ? 1 : -1;
  const double arc = sine / (p.height + sense * sine / p.radius);
  return {-sense * cosine * arc, sine * arc};
}

// From one u to a larger one; Runge-Kutta, fourth order.
Point integrated(Wall wall, Point p, double from, double to) {
  constexpr double kStep = 0.04;
  const double way = std::log(to / from), steps = std::ceil(way / kStep), h = way / steps, half = std::exp(h / 2);
  const auto moved = [&](const Point& by, double f) {
    return Point{p.radius + f * by.radius, p.height + f * by.height};
  };
  double u = from;
  for (double i = 0; i < steps; ++i) {
    const double middle = half * u, end = half * middle;
    const Point a = change(wall, p, u), b = change(wall, moved(a, h / 2), middle),
                c = change(wall, moved(b, h / 2), middle), d = change(wall, moved(c, h), end);
    p.radius += h / 6 * (a.radius + 2 * b.radius + 2 * c.radius + d.radius);
    p.height += h / 6 * (a.height + 2 * b.height + 2 * c.height + d.height);
    u = end;
  }
  return p;
}

constexpr int kPoints = 6;  // of each interpolation

// Lagrange's interpolation through (x_i, y_i).
double interpolated(const double x[kPoints], const double y[kPoints], double at) {
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    double weight = 1;
    for (int k = 0; k < kPoints; ++k) {
      if (k != i) weight *= (at - x[k]) / (x[i] - x[k]);
    }
    sum += weight * y[i];
  }
  return sum;
}

// ln(height / (2 sin(slope / 2))) by slope and ln radius, both smooth. One meniscus, followed from far away until it
// overhangs, gives one entry to each row.
class Table {
 public:
  explicit Table(Wall wall) : rows_(kSlopes) {
    constexpr double kLeast = 1e-7, kMost = 1e4, kStep = 0.1;  // radii, and the step of their logarithm
    constexpr double kStart = 1e-3;                            // slope below which the equation is linear
    for (double x = std::log(kLeast); x < std::log(kMost) + kStep; x += kStep) {
      const double radius = std::exp(x);
      rows_[0].push_back({x, std::log(linear_rise(wall, radius))});
      Point p{where_slope_changes(wall, radius, std::log(kStart)), 0};
      p.height = 2 * std::sin(kStart / 2) * linear_rise(wall, p.radius);
      double from = std::tan(kStart / 2);
      for (int k = 1; k < kSlopes; ++k) {
        const double slope = k * kSlopeStep, to = std::tan(slope / 2);
        p = integrated(wall, p, from, to);
        from = to;
        rows_[k].push_back({std::log(p.radius), std::log(p.height / (2 * std::sin(slope / 2)))});
      }
    }
  }

  // `slope` in [0, pi).
  double height(double slope, double radius) const {
    slope = std::min(slope, (kSlopes - 1) * kSlopeStep);
    const int first =
        std::clamp(static_cast<int>(slope / kSlopeStep) - kPoints / 2 + 1, 1 - kSlopes, kSlopes - kPoints);
    double x[kPoints], y[kPoints];
    for (int i = 0; i < kPoints; ++i) {  // even in the slope
      x[i] = (first + i) * kSlopeStep;
      y[i] = in_row(rows_[std::abs(first + i)], radius);
    }
    return 2 * std::sin(slope / 2) * std::exp(interpolated(x, y, slope));
  }

 private:
  static constexpr double kSlopeStep = glm::pi<double>() / 36;
  static constexpr int kSlopes = 36;  // from 0 to 175 degrees

  struct Entry {
    double log_radius, value;
  };

  static double in_row(const std::vector<Entry>& row, double radius) {
    const double wanted = std::log(radius);
    const Entry &least = row.front(), &most = row.back();
    if (wanted >= most.log_radius) return most.value * std::exp(most.log_radius - wanted);  // 1 - c / radius
    if (wanted <= least.log_radius) return least.value;
    const auto after =
        std::partition_point(row.begin(), row.end(), [&](const Entry& e) { return e.log_radius < wanted; });
    const auto last = static_cast<std::ptrdiff_t>(row.size()) - kPoints;
    const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(after - row.begin() - kPoints / 2, 0, last);
    double x[kPoints], y[kPoints];
    for (int i = 0; i < kPoints; ++i) x[i] = row[first + i].log_radius, y[i] = row[first + i].value;
    return interpolated(x, y, wanted);
  }

  std::vector<std::vector<Entry>> rows_;  // per slope, by ascending radius
};

}  // namespace

double exact_rise(double slope, double curvature) {
  if (curvature == 0) return 2 * std::sin(slope / 2);
  const auto height = [&](const Table& table) {
    return std::copysign(table.height(std::abs(slope), 1 / std::abs(curvature)), slope);
  };
  if (curvature > 0) {
    static const Table posts(Wall::post);
    return height(posts);
  }
  static const Table tubes(Wall::tube);
  return height(tubes);
}

}  // namespace meniscus
