// The points of which the band is made: layers at graded distances from the contact lines, along their normals (paper,
// figure 5).
#pragma once

#include <cstdint>
#include <vector>

#include "meniscus/field.h"
#include "meniscus/patch.h"

namespace meniscus {

// Wanted distance between layers at a distance from the contact line, metres: finest at the wall, in the band as
// the profile bends, growing beyond it so that the band blends into a coarse liquid.
class Grading {
 public:
  explicit Grading(const ContactLine& line, double sweep_length);
  double spacing(double distance) const;
  // Distances from the wall out to `extent`; one of them is exactly the sweep, where the profile has a kink.
  std::vector<double> layers(double extent) const;

 private:
  double sweep_;  // of the line; 0 for a hole without a meniscus
  double unit_;   // sweep length
  Fineness fineness_;
  double first_, most_, growth_;
};

// Points already taken, to keep others away from them.
class Spacing {
 public:
  // Takes p and returns true, unless some point taken earlier is nearer than `radius`.
  bool claim(const glm::dvec2& p, double radius);
  void take(const glm::dvec2& p);

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::size_t bucket(double i, double j) const;
  void enter(std::uint32_t point);
  void rebuild(double size);

  double size_ = 0;  // of a cell
  std::vector<glm::dvec2> points_;
  std::vector<std::uint32_t> first_, next_;  // per bucket of cells the point entered last; per point the one before it
};

struct BandPoint {
  glm::dvec2 x;
  Foot foot;
  Foot other;  // on a crease: the second foot, as near
};

// Every line sends its points along its own normals, at convex joints along a fan of directions between the two; a
// point is kept where it lies on the patch and no other foot is nearer: so neighbours share the liquid and concave
// parts trim themselves. Where they meet they share a row of points on the crease between them. `spacing` holds what is
// there already.
std::vector<BandPoint> sweep(const std::vector<ContactLine>& lines, const std::vector<Grading>& gradings,
                             const Field& field, const Patch& patch, Spacing& spacing);

}  // namespace meniscus
