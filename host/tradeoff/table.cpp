#include "host/tradeoff/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meniscal {

double seconds_of(const Point& point, Clock clock) {
  return clock == Clock::cpu ? point.cpu_seconds : point.wall_seconds;
}

const char* name_of(Clock clock) { return clock == Clock::cpu ? "CPU seconds" : "seconds"; }

std::vector<Trade> trades_of(const std::vector<Point>& points, Clock clock, const Measure& measure) {
  std::vector<Trade> trades;
  for (const Point& p : points) trades.push_back({seconds_of(p, clock), p.errors.*measure.value});
  return trades;
}

std::string as_csv(const std::vector<Point>& points, Clock clock) {
  std::string text = "knob,preset,value,options,cpu_s,wall_s";
  std::vector<std::vector<std::size_t>> fronts;
  for (const Measure& m : measures) {
    text += fmt::format(",{0},front_{0}", m.column);
    fronts.push_back(pareto_front(trades_of(points, clock, m)));
  }
  text += "\r\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    text += fmt::format("{},{},{},{},{:.4f},{:.4f}", p.setting.knob, p.setting.preset, p.setting.value,
                        command_line(p.setting), p.cpu_seconds, p.wall_seconds);
    for (std::size_t m = 0; m < measures.size(); ++m) {
      const double error = p.errors.*measures[m].value;
      const bool on_front = std::find(fronts[m].begin(), fronts[m].end(), i) != fronts[m].end();
      text += fmt::format(",{},{}", std::isfinite(error) ? fmt::format("{:.6g}", error) : "", on_front ? 1 : 0);
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace meniscal
