// What was measured, and as a table.
#pragma once

#include "host/tradeoff/errors.h"
#include "host/tradeoff/front.h"
#include "host/tradeoff/sweep.h"

namespace meniscal {

struct Point {
  Setting setting;
  double cpu_seconds = 0, wall_seconds = 0;
  Errors errors;
};

// By the clock that counts: CPU seconds say nothing of what a GPU did.
enum class Clock { cpu, wall };
double seconds_of(const Point& point, Clock clock);
const char* name_of(Clock clock);  // "CPU seconds", "seconds"

std::vector<Trade> trades_of(const std::vector<Point>& points, Clock clock, const Measure& measure);

// RFC 4180 with a header: a row a point; an error that is not known is empty, and front_... is 1 on the front by that
// error.
std::string as_csv(const std::vector<Point>& points, Clock clock);

}  // namespace meniscal
