// The page: curves, fronts, pictures with their errors, and what presets should be; complete in one file.
#pragma once

#include "host/tradeoff/table.h"

namespace meniscal {

struct ShownPicture {
  std::string name, command;       // "draft", "--quality draft"
  std::size_t point;               // index
  std::vector<std::uint8_t> srgb;  // as the reference is shown
  std::vector<float> error, flip;  // maps, [0, 1]
};

struct Report {
  std::string scene, device, version;
  Clock clock = Clock::cpu;
  std::string reference_command;
  double reference_error = -1;  // estimated, relative; negative: unknown
  Sweep sweep;
  std::vector<Point> points;  // of the sweep's settings, in that order; fewer where it was interrupted
  std::vector<ShownPicture> pictures;
  std::string csv_name;  // the table's file, beside the page
};

std::string as_html(const Report& report, const Reference& reference);

// What buys the least error for no more seconds than a preset takes; as many as presets were measured.
struct Advice {
  std::size_t preset, best;  // indices of points
  double ratio;              // the preset's error over the best's
};
std::vector<Advice> advice(const std::vector<Point>& points, Clock clock, const Measure& measure);

}  // namespace meniscal
