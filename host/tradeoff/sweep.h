// What is tried: the presets, and one knob turned at a time from each of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meniscal {

struct SweptPreset {
  std::string name;
  std::uint32_t photons, passes, samples, highlight_samples, diffuse_bounces;
  bool gathers;  // final gathering
};

// What the scene has that knobs turn at, and the side of a pixel on what is seen, m.
struct SweptScene {
  bool menisci = true, highlights = true;
  double footprint = 0;
};

struct Setting {
  std::string knob, preset;            // knob: "preset" where none is turned
  std::string value;                   // the knob's
  std::vector<std::string> arguments;  // of `meniscal render`, after the scene
};
std::string command_line(const Setting& setting);

// Settings of one knob and preset in the order of the knob's values, the preset itself among them.
struct Curve {
  std::string knob, preset;
  std::vector<std::size_t> settings;  // indices into Sweep::settings
  std::vector<std::string> values;    // of the knob
};

struct Sweep {
  std::vector<Setting> settings;  // the presets first
  std::vector<Curve> curves;
};

// quick: the presets and four settings more, for tests.
Sweep make_sweep(const std::vector<SweptPreset>& presets, const SweptScene& scene, bool quick);

}  // namespace meniscal
