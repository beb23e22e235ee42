// The creases on which two menisci, or two parts of one, meet: rows of points that both share.
#pragma once

#include <optional>
#include <vector>

#include "meniscus/band.h"

namespace meniscus {

// How far out creases matter, in sweep lengths: a little beyond the meniscus, so that the row does not end before it.
constexpr double kCreaseReach = 1.1;

// Where the column from `origin` along the foot's direction meets a crease, with the second foot that is as near there;
// at the distance `beyond` another foot must be nearer than the column's own.
BandPoint end_on_crease(const Field& field, const std::vector<ContactLine>& lines, const glm::dvec2& origin, Foot foot,
                        double beyond);

// Of the angle between the crease and either way to a wall.
double sine_to_crease(const BandPoint& end);

// The crease along one contact line: the ends of its columns, and between those of neighbouring columns points near
// enough that edges from one to the next are Delaunay where all other points keep half the spacing away.
class CreaseRow {
 public:
  // Along a line with this grading. Appends to `points`, as far out as creases matter.
  CreaseRow(const Field& field, const std::vector<ContactLine>& lines, const Grading& grading,
            std::vector<BandPoint>& points)
      : field_(field), lines_(lines), grading_(grading), points_(points) {}

  // The end of the column with this number; numbers ascend.
  void add(std::size_t column, const BandPoint& end);
  // After the last of `columns` columns comes the first.
  void close(std::size_t columns);

 private:
  struct End {
    std::size_t column;
    BandPoint point;
  };
  void fill(const BandPoint& a, const BandPoint& b);
  void keep(const BandPoint& p);

  const Field& field_;
  const std::vector<ContactLine>& lines_;
  const Grading& grading_;
  std::vector<BandPoint>& points_;
  std::optional<End> first_, last_;
};

}  // namespace meniscus
