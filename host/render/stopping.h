// When a rendering ends: at the first limit that is reached.
#pragma once

#include <array>
#include <functional>

#include "host/render/film.h"
#include "host/render/pass_ranges.h"

namespace meniscal {

enum class Stop { passes, time, error, interrupt };
const char* to_text(Stop stop);

struct Limits {
  PassRange passes;
  std::optional<double> seconds;  // of the whole process
  std::optional<double> error;    // estimated, relative
};

class Stopping {
 public:
  // Fewer tell too little of where they lead: one in three stopped at 4 was 1.5 times further off than asked for.
  static constexpr std::uint32_t least_passes_for_error = 8;

  // `clock`: seconds since the process began. `reserve`: what it still takes after the last pass, seconds.
  Stopping(const Limits& limits, std::function<double()> clock, double reserve);

  // To be told of each pass: the next takes about as long.
  void pass_ended();

  // The limit that the film has reached.
  std::optional<Stop> reached(const Film& film) const;

  // Passes that there will be on the film, as far as can be told; 0: nobody knows.
  std::uint32_t expected_passes(const Film& film) const;

 private:
  Limits limits_;
  std::function<double()> clock_;
  double reserve_, last_end_;
  std::uint32_t ended_ = 0;
  std::array<double, 4> seconds_{};  // that the last passes took
};

}  // namespace meniscal
