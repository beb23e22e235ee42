#include "host/render/stopping.h"

#include <algorithm>
#include <cmath>

namespace meniscal {

const char* to_text(Stop stop) {
  switch (stop) {
    case Stop::passes:
      return "passes";
    case Stop::time:
      return "time";
    case Stop::error:
      return "target error";
    case Stop::interrupt:
      break;
  }
  return "interrupt";
}

Stopping::Stopping(const Limits& limits, std::function<double()> clock, double reserve)
    : limits_(limits), clock_(std::move(clock)), reserve_(reserve), last_end_(clock_()) {}

void Stopping::pass_ended() {
  const double now = clock_();
  seconds_[ended_++ % seconds_.size()] = now - last_end_;
  last_end_ = now;
}

std::optional<Stop> Stopping::reached(const Film& film) const {
  if (limits_.error && film.passes() >= least_passes_for_error && film.error_estimate() <= *limits_.error)
    return Stop::error;
  // The longest of the last ones: the next is to fit, not to fit on average.
  if (limits_.seconds && last_end_ + *std::max_element(seconds_.begin(), seconds_.end()) + reserve_ > *limits_.seconds)
    return Stop::time;
  if (film.passes() >= limits_.passes.count()) return Stop::passes;
  return std::nullopt;
}

std::uint32_t Stopping::expected_passes(const Film& film) const {
  double passes = limits_.passes.count();
  const double kept = std::min(double(ended_), double(seconds_.size()));
  if (limits_.seconds && kept > 0) {
    double sum = 0;
    for (const double s : seconds_) sum += s;
    const double left = std::max(*limits_.seconds - reserve_ - last_end_, 0.0);
    passes = std::min(passes, film.passes() + std::floor(left * kept / std::max(sum, 1e-9)));
  }
  if (limits_.error && film.passes() >= least_passes_for_error) {
    const double excess = film.error_estimate() / *limits_.error;  // falls with the root of the passes
    passes = std::min(passes, std::ceil(film.passes() * std::max(excess * excess, 1.0)));
  }
  const bool unlimited = passes >= most_passes;
  return unlimited ? 0 : static_cast<std::uint32_t>(passes);
}

}  // namespace meniscal
