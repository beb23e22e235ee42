#include "host/tradeoff/sweep.h"

#include <fmt/format.h>

#include <algorithm>

namespace meniscal {
namespace {

struct Knob {
  std::string name, option;
  std::string usual;                // the preset's own value; empty: it is not between the others
  std::vector<std::string> values;  // in order, `usual` where it belongs
};

template <class Number>
std::vector<std::string> as_text(std::vector<Number> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<std::string> texts;
  for (const Number n : numbers) texts.push_back(fmt::format("{}", n));
  return texts;
}

template <class Number>
Knob numeric(const char* name, const char* option, Number usual, std::vector<Number> values) {
  values.push_back(usual);
  return {name, option, fmt::format("{}", usual), as_text(values)};
}

std::vector<Knob> knobs_of(const SweptPreset& p, const SweptScene& scene) {
  using Whole = std::uint32_t;
  const Whole more = static_cast<Whole>(std::min<std::uint64_t>(4ull * p.photons, 1u << 30));  // the option's limit
  std::vector<Knob> knobs = {
      numeric<Whole>("photons", "--photons", p.photons, {std::max(p.photons / 4, 1u), more}),
      numeric<Whole>("passes", "--passes", p.passes, {1, 2, 4, 8}),
      numeric<Whole>("samples", "--samples", p.samples, {1, 2, 4, 8}),
      numeric<Whole>("diffuse bounces", "--diffuse-bounces", p.diffuse_bounces, {0, 1, 2, 4, 16}),
      numeric<Whole>("specular bounces", "--specular-bounces", 16, {2, 4, 8}),
      {"final gathering", "--final-gathering", p.gathers ? "on" : "off", {"off", "on"}},
  };
  // The usual discs are each photon's own, narrower or wider than any of one radius.
  Knob radius{"radius", "--radius", "", {}};
  for (const double pixels : {1.0, 2.0, 4.0, 8.0})
    radius.values.push_back(fmt::format("{:.4g}", pixels * scene.footprint));
  if (scene.footprint > 0) knobs.push_back(radius);
  knobs.push_back({"kernel", "--kernel", "biweight", {"uniform", "epanechnikov", "biweight"}});
  if (scene.highlights)
    knobs.push_back(numeric<Whole>("highlight samples", "--highlight-samples", p.highlight_samples, {0, 4, 16, 64}));
  if (scene.menisci) {
    knobs.push_back({"meniscus", "--meniscus", "exact", {"paper", "exact"}});
    knobs.push_back(numeric<double>("meniscus tolerance", "--meniscus-tolerance", 1, {0.5, 2, 4, 16}));
  }
  return knobs;
}

bool is_quick(const Knob& knob, const std::string& preset) {
  return preset == "draft" && (knob.name == "photons" || knob.name == "diffuse bounces" || knob.name == "meniscus");
}

Curve turn(Sweep& sweep, const Knob& knob, const std::string& preset, std::size_t own, bool quick) {
  Curve curve{knob.name, preset, {}, {}};
  std::size_t turned = 0;
  for (const std::string& value : knob.values) {
    const bool usual = value == knob.usual;
    if (quick && !usual && ++turned > (knob.name == "photons" ? 2u : 1u)) continue;
    curve.settings.push_back(usual ? own : sweep.settings.size());
    curve.values.push_back(value);
    if (!usual) sweep.settings.push_back({knob.name, preset, value, {"--quality", preset, knob.option, value}});
  }
  return curve;
}

}  // namespace

std::string command_line(const Setting& setting) { return fmt::format("{}", fmt::join(setting.arguments, " ")); }

Sweep make_sweep(const std::vector<SweptPreset>& presets, const SweptScene& scene, bool quick) {
  Sweep sweep;
  for (const SweptPreset& p : presets) sweep.settings.push_back({"preset", p.name, p.name, {"--quality", p.name}});
  for (std::size_t i = 0; i < presets.size(); ++i)
    for (const Knob& knob : knobs_of(presets[i], scene))
      if (!quick || is_quick(knob, presets[i].name))
        sweep.curves.push_back(turn(sweep, knob, presets[i].name, i, quick));
  return sweep;
}

}  // namespace meniscal
