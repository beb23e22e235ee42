#include "host/render/beams.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "host/world/light_view.h"
#include "shaders/shared/starts.h"

namespace meniscal {
namespace {

// Lengths here are in units of the mean distance between starts.

// Discs of fewer starts are noisy, wider ones blur; where the two balance was measured on the benchmark with 15,000 to
// 1,000,000 photons.
double fine_reach(std::uint32_t photons) { return std::clamp(3 * std::pow(photons / 30000.0, 0.2), 2.0, 8.0); }

// Of a window that others lie in. The border is wide enough that discs of the two sizes disagree by 4 % at its ends at
// the most: half of the fade's curvature, 6 / border^2, times a disc's variance, reach^2 / 8.
constexpr double coarse_reach = 3.5, border = 11, unseen_border = 2;
// The hash grid's levels are few: no disc is wider than so many of the narrowest beam's.
constexpr float widest_reach = 8;
// Of photons that start where nothing is thought to be seen: wider discs would reach into the picture from its border,
// where others are already all of the light (measured: 4 % too much).
constexpr float unseen_reach = 2;

}  // namespace

double start_area(const World& world, const StartSet& set) {
  return set.light ? world.views[*set.light]->area : world.strata[set.stratum].area;
}

std::vector<StartSet> default_starts(const World& world) {
  std::vector<StartSet> sets;
  const auto targeted = std::find_if(world.strata.begin(), world.strata.end(),
                                     [](const Stratum& s) { return s.map == shared::MAP_TARGETED; });
  for (std::uint32_t l = 0; l < world.lights.size(); ++l) {
    if (!world.views[l]) continue;
    StartSet set{l, 0, {StartWindow{}}};
    if (targeted != world.strata.end() && world.strata.size() > 1) {
      const glm::dvec4 menisci = bounds_in(*world.views[l], world, *targeted);
      const StartWindow window{glm::max(glm::dvec2(menisci), 0.0), glm::min(glm::dvec2(menisci.z, menisci.w), 1.0)};
      if (window.part() < 0.5) set.windows.push_back(window);
    }
    sets.push_back(set);
  }
  const bool near = std::any_of(world.views.begin(), world.views.end(), [](const auto& v) { return !v; });
  for (std::uint32_t s = 0; near && s < world.strata.size(); ++s) sets.push_back({std::nullopt, s, {StartWindow{}}});

  std::size_t windows = 0;
  double roots = 0;
  const auto root = [&](const StartSet& s, const StartWindow& w) { return std::sqrt(start_area(world, s) * w.part()); };
  for (const StartSet& s : sets)
    for (const StartWindow& w : s.windows) ++windows, roots += root(s, w);
  for (StartSet& s : sets)
    for (StartWindow& w : s.windows) w.share = 0.5 / double(windows) + 0.5 * root(s, w) / roots;
  return sets;
}

namespace {

constexpr glm::vec4 everywhere(-1, -1, 2, 2), nowhere(2, 2, 3, 3);

// A window with the border over which it fades in. `core` is the part with all the weight.
struct Bordered {
  StartWindow core;
  glm::dvec2 fade;
  glm::dvec2 low() const { return core.low - fade; }
  glm::dvec2 high() const { return core.high + fade; }
  glm::vec4 box() const { return {low(), high()}; }
};

double spacing(double area, double part, std::uint32_t photons) {
  return std::sqrt(area * part / std::max(photons, 1u));
}

// Windows of a set with their borders, each as wide as the spacing of the window around asks for, and each grown to
// hold those within. Starts on triangles lie in the square in no order that a border could follow.
std::vector<Bordered> add_borders(const World& world, const StartSet& set, const std::vector<std::uint32_t>& counts) {
  std::vector<Bordered> windows;
  for (const StartWindow& w : set.windows) windows.push_back({w, glm::dvec2(1e-6)});
  for (std::size_t k = windows.size() - 1; k > 0; --k) {
    StartWindow& around = windows[k - 1].core;
    if (set.light) {
      const LightView& view = *world.views[*set.light];
      const bool seen = k > 1 || around.seen;
      windows[k].fade = (seen ? border * spacing(view.area, around.part(), counts[k - 1])
                              : unseen_border * spacing(view.area, windows[k].core.part(), counts[k])) /
                        glm::dvec2(glm::length(view.u), glm::length(view.v));
    }
    if (k == 1) break;
    around.low = glm::min(around.low, windows[k].low());
    around.high = glm::max(around.high, windows[k].high());
  }
  return windows;
}

shared::Beam make_beam(const World& world, const StartSet& set) {
  const Stratum& stratum = world.strata[set.stratum];
  shared::Beam beam{};
  beam.map = stratum.map;
  beam.light_first = world.near_first;
  beam.target_first = stratum.first;
  beam.target_count = stratum.count;
  if (set.light) {
    const LightView& view = *world.views[*set.light];
    beam.kind = shared::START_IN_VIEW;
    beam.light = *set.light;
    beam.corner = view.corner, beam.u = view.u, beam.v = view.v;
  }
  return beam;
}

// The matrix of shared::Beam::order for blocks of 2^bits: the inverse, over GF(2), of the one that gives a Sobol index'
// place along a Z-curve. A block has one point in each cell of a grid of 2^bits cells, scrambled or not.
std::array<std::uint32_t, 32> order_columns(std::uint32_t bits) {
  std::array<std::uint32_t, 32> place{}, index{};  // rows of the system: place along the curve -> index
  for (std::uint32_t b = 0; b < bits; ++b) {
    const shared::uvec2 point = shared::sobol_index_point(1u << b);
    for (std::uint32_t d = 0; d < bits; ++d)
      place[b] |= ((d % 2 == 0 ? point.x : point.y) >> (31 - d / 2) & 1u) << (bits - 1 - d);
    index[b] = 1u << b;
  }
  for (std::uint32_t c = 0; c < bits; ++c) {
    const std::uint32_t bit = 1u << c;
    std::uint32_t pivot = c;
    while (!(place[pivot] & bit)) ++pivot;  // the points of a net are all different: the matrix is regular
    std::swap(place[c], place[pivot]), std::swap(index[c], index[pivot]);
    for (std::uint32_t r = 0; r < bits; ++r)
      if (r != c && place[r] & bit) place[r] ^= place[c], index[r] ^= index[c];
  }
  return index;
}

// In blocks of at most an eighth of the photons, so that few are left over.
void set_order(shared::Beam& beam) {
  const auto bits = static_cast<std::uint32_t>(std::bit_width(beam.count)) - 1;
  beam.order_bits = std::min(bits > 3 ? bits - 3 : 0, 20u);
  const auto columns = order_columns(beam.order_bits);
  for (std::uint32_t b = 0; b < beam.order_bits; ++b) beam.order[b / 4][static_cast<int>(b % 4)] = columns[b];
}

// The part of the square that holds a window, in whole units of 2^-16.
void set_extent(shared::Beam& beam, const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 first = glm::floor(glm::clamp(low, 0.0, 1.0) * 65536.0);
  beam.start = glm::min(first, 65535.0);
  beam.extent = glm::max(glm::ceil(glm::clamp(high, 0.0, 1.0) * 65536.0) - glm::dvec2(beam.start), 1.0);
}

}  // namespace

std::uint32_t start_index(const shared::Beam& beam, std::uint32_t i) {
  const std::uint32_t bits = beam.order_bits;
  if (i >> bits >= beam.count >> bits) return i;
  std::uint32_t index = i >> bits << bits;
  for (std::uint32_t c = 0; 4 * c < bits; ++c) index ^= shared::xor_columns(i >> (4 * c), beam.order[c], bits - 4 * c);
  return index;
}

std::vector<shared::Beam> light_beams(const World& world, std::uint32_t photons) {
  if (world.lights.empty()) return {};
  shared::Beam beam{};
  beam.kind = shared::START_ON_LIGHTS;
  beam.map = shared::MAP_CAUSTIC;
  beam.light_first = world.light_first;
  beam.count = photons;
  beam.power = 1 / static_cast<float>(photons);
  beam.extent = glm::uvec2(65536);
  beam.own = everywhere, beam.finer = nowhere;
  beam.own_fade = beam.finer_fade = glm::vec2(1);
  return {beam};
}

std::vector<shared::Beam> global_beams(const World& world, std::uint32_t photons, bool from_lights) {
  std::vector<shared::Beam> beams;
  if (!from_lights) beams = make_beams(world, default_starts(world), photons / 2);
  const std::uint32_t first = beams.empty() ? 0 : beams.back().first + beams.back().count;
  for (shared::Beam beam : light_beams(world, std::max(photons, first + 1) - first)) {
    beam.map = shared::MAP_GLOBAL;
    beam.first = first;
    beams.push_back(beam);
  }
  return beams;
}

std::vector<shared::Beam> make_beams(const World& world, const std::vector<StartSet>& starts, std::uint32_t photons,
                                     double widening) {
  std::vector<shared::Beam> beams;
  std::vector<bool> wanted;
  std::uint32_t first = 0;
  double shared_out = 0;
  for (const StartSet& set : starts) {
    // Shares are rounded so that they add up to what was asked for; no window goes without.
    std::vector<std::uint32_t> counts;
    for (const StartWindow& w : set.windows) {
      const double before = shared_out;
      shared_out += w.share * photons;
      counts.push_back(static_cast<std::uint32_t>(std::max(std::round(shared_out) - std::round(before), 1.0)));
    }
    const std::vector<Bordered> windows = add_borders(world, set, counts);
    for (std::size_t k = 0; k < windows.size(); ++k) {
      shared::Beam beam = make_beam(world, set);
      beam.first = first;
      beam.count = counts[k];
      first += counts[k];
      set_order(beam);
      set_extent(beam, windows[k].low(), windows[k].high());
      beam.own = k == 0 ? everywhere : windows[k].box();
      beam.own_fade = k == 0 ? glm::vec2(1) : glm::vec2(windows[k].fade);
      const bool finest = k + 1 == windows.size();
      beam.finer = finest ? nowhere : windows[k + 1].box();
      beam.finer_fade = finest ? glm::vec2(1) : glm::vec2(windows[k + 1].fade);
      const double part = double(beam.extent.x) * beam.extent.y / (65536.0 * 65536.0);
      beam.power = static_cast<float>(start_area(world, set) * part / beam.count);
      const double reach = widening * (finest ? fine_reach(beam.count) : coarse_reach);
      beam.reach = static_cast<float>(reach * std::sqrt(double(beam.power)));
      beams.push_back(beam);
      wanted.push_back(windows[k].core.seen);
    }
  }
  float finest = std::numeric_limits<float>::infinity();
  for (const shared::Beam& b : beams) finest = std::min(finest, b.reach);
  for (std::size_t b = 0; b < beams.size(); ++b)
    beams[b].reach = std::min(beams[b].reach, (wanted[b] ? widest_reach : unseen_reach) * finest);
  return beams;
}

}  // namespace meniscal
