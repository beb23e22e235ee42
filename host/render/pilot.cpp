#include "host/render/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/render/seen.h"
#include "shaders/shared/starts.h"

namespace meniscal {
namespace {

constexpr std::uint32_t most_rays = 4096, photons_a_round = 4096, photons_for_noise = 2048;
constexpr std::size_t enough = 16;                // photons seen, to know where more will be
constexpr double zoom = 8;                        // of what is looked at, from a round to the next: 1 / 64 of its area
constexpr std::uint32_t pilot_pass = 0x80000000;  // first of the passes whose random numbers the pilot takes
// What is thought to be unseen still gets a share: rare paths are noisy then, but not lost.
constexpr double unseen_share = 0.03;
// Where photons were seen round what is seen, but not there.
constexpr double unseen_share_beside = 0.5;

}  // namespace

RenderSettings coarse_view(RenderSettings settings) {
  const double width = settings.width, height = settings.height;
  const double factor = std::max(1.0, std::sqrt(double(settings.crop.pixels()) / most_rays));
  const auto shrunk = [&](std::uint32_t pixels) { return static_cast<std::uint32_t>(pixels / factor); };
  // The aspect decides what is seen: the shorter side is rounded, the longer one follows.
  std::uint32_t &longer = settings.width > settings.height ? settings.width : settings.height,
                &shorter = settings.width > settings.height ? settings.height : settings.width;
  const double aspect = double(longer) / shorter;
  shorter = std::max(shrunk(shorter), 1u);
  longer = static_cast<std::uint32_t>(std::round(shorter * aspect));
  Crop& c = settings.crop;
  c.x0 = static_cast<std::uint32_t>(c.x0 * settings.width / width);
  c.y0 = static_cast<std::uint32_t>(c.y0 * settings.height / height);
  c.x1 = std::max(static_cast<std::uint32_t>(std::ceil(c.x1 * settings.width / width)), c.x0 + 1);
  c.y1 = std::max(static_cast<std::uint32_t>(std::ceil(c.y1 * settings.height / height)), c.y0 + 1);
  return settings;
}

namespace {

// Where in the square the photons started that were seen, and what they brought.
struct Seen {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  double flux = 0;

  bool any() const { return flux > 0; }
  void add(const glm::dvec2& place, double photon_flux) {
    low = glm::min(low, place);
    high = glm::max(high, place);
    flux += photon_flux;
  }
  void widen(const Seen& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  // With what may lie between the starts.
  StartWindow window(const glm::dvec2& margin) const {
    return {glm::max(low - margin, 0.0), glm::min(high + margin, 1.0)};
  }
};
struct SeenSet {
  Seen all, targeted;
  bool missed = false;  // by the last look: what is known is of one before
};

enum class Look { wider, narrower, again };  // than the one before, or at the same

// What a round's photons tell of the sets that their beams belong to. How many were seen.
std::size_t look(Backend& backend, RenderSettings& settings, const std::vector<std::size_t>& set_of_beam,
                 std::uint32_t round, const SeenCells& cells, Look how, std::vector<SeenSet>& seen) {
  backend.configure(settings);
  const std::vector<PhotonEnd> ends = backend.trace_photons(pilot_pass + round);
  std::vector<SeenSet> found(seen.size());
  std::size_t count = 0;
  for (std::uint32_t b = 0; b < settings.caustics.beams.size(); ++b) {
    const shared::Beam& beam = settings.caustics.beams[b];
    for (std::uint32_t i = 0; i < beam.count; ++i) {
      const PhotonEnd& photon = ends[beam.first + i];
      if (photon.end >= shared::END_FIRST || !cells.contains(photon.position)) continue;
      const shared::RandomKey key{settings.seed, pilot_pass + round, shared::STREAM_BEAM + b, start_index(beam, i)};
      const glm::dvec2 place = glm::dvec2(shared::start_bits(key, beam.start, beam.extent)) * 0x1p-32;
      SeenSet& s = found[set_of_beam[b]];
      s.all.add(place, mean_of(photon.flux));
      if (photon.map == shared::MAP_TARGETED) s.targeted.add(place, mean_of(photon.flux));
      ++count;
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!found[i].all.any()) {
      seen[i].missed = true;
      if (how == Look::narrower) seen[i].all.flux /= zoom * zoom;  // as if it lay evenly where it was seen
      continue;
    }
    if (how == Look::again && !seen[i].missed)
      found[i].all.widen(seen[i].all), found[i].targeted.widen(seen[i].targeted);
    seen[i] = found[i];
  }
  return count;
}

std::vector<std::size_t> sets_of_beams(const std::vector<StartSet>& sets) {
  std::vector<std::size_t> set_of_beam;
  for (std::size_t s = 0; s < sets.size(); ++s) set_of_beam.insert(set_of_beam.end(), sets[s].windows.size(), s);
  return set_of_beam;
}

// Mean distance between the starts of a window, in the square.
glm::dvec2 spacing(const StartWindow& window) {
  return (window.high - window.low) / std::sqrt(std::max(window.share * photons_a_round, 1.0));
}

// The whole square; round what is seen; and round the menisci, if they are a small part of that. Shares are the square
// roots of flux.
std::vector<StartWindow> windows_round(const SeenSet& seen, const StartSet& looked, bool menisci) {
  std::vector<StartWindow> windows = {StartWindow{.seen = false}};
  if (!seen.all.any()) return windows;
  constexpr double least = 1.0 / 65536;  // of starts: the unit of beams
  const glm::dvec2 margin = glm::max(1.5 * spacing(looked.windows.back()), least);
  windows.push_back(seen.missed ? looked.windows.back() : seen.all.window(margin));
  windows[1].share = std::sqrt(seen.all.flux);
  const StartWindow finer = seen.targeted.window(margin);
  if (!menisci || seen.missed || !looked.light || !seen.targeted.any() || finer.part() > 0.5 * windows[1].part())
    return windows;
  windows.push_back(finer);
  windows[1].share = std::sqrt(std::max(seen.all.flux - seen.targeted.flux, 0.0));
  windows[2].share = std::sqrt(seen.targeted.flux);
  return windows;
}

// Makes shares of what windows weigh; the whole squares get the part that is for what is not seen.
void share_out(std::vector<StartSet>& sets, double unseen) {
  double total = 0;
  for (const StartSet& s : sets)
    for (const StartWindow& w : s.windows) total += w.share;
  for (StartSet& s : sets)
    for (StartWindow& w : s.windows)
      w.share = w.seen ? (1 - unseen) * w.share / total : (total > 0 ? unseen : 1) / double(sets.size());
}

// What the camera sees differently by photons of two passes. The samples are the same but for these.
MapNoise difference(const Samples& a, const Samples& b) {
  MapNoise sum;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const shared::PixelSample &p = a.pixels[i], &q = b.pixels[i];
    glm::dvec3 caustics = p.weight * (p.targeted + p.caustic - q.targeted - q.caustic);  // squares outgrow floats
    glm::dvec3 global = p.weight * (p.global - q.global);
    if (!a.gloss.empty()) {
      const shared::PixelGloss &g = a.gloss[i], &h = b.gloss[i];
      caustics += glm::dvec3(g.targeted + g.caustic - h.targeted - h.caustic);
      global += glm::dvec3(g.global - h.global);
    }
    sum.caustics += mean_of(caustics * caustics);
    sum.global += mean_of(global * global);
  }
  return sum;
}

double crowding_in(const Samples& samples, const RenderSettings& settings, double scene_radius) {
  double held = 0, points = 0;
  for (const shared::PixelSample& s : samples.pixels)
    if (s.weight != glm::vec3(0)) held += double(s.global_count), ++points;
  const double part = std::pow(settings.global.discs.widest / scene_radius, 2);  // of the scene, in a disc
  if (!(held > 0)) return 0;
  constexpr double steps = 4;  // an octave
  return std::exp2(std::round(steps * std::log2(held / points / (part * settings.global.count()))) / steps);
}

// Noise is variance by one photon. The discs are those of the first passes to come; the random numbers are others.
void look_at_maps(Backend& backend, const World& world, RenderSettings settings, Pilot& pilot) {
  settings.seed = ~settings.seed;
  settings.caustics.beams = make_beams(world, pilot.starts, photons_for_noise);
  settings.global.beams = global_beams(world, photons_for_noise, false);
  backend.configure(settings);
  const auto look_at = [&](const View& view) {
    const Samples samples = backend.light_camera(0, view, 0);
    pilot.crowding = crowding_in(samples, settings, world.radius);
    return difference(samples, backend.light_camera(0, view, 1));
  };
  MapNoise noise = look_at(View{});
  // Of one bounced path a sample: their mean evens out what each sees of the map.
  if (settings.final_gathering) noise.global = look_at(View{.bounced = true}).global / settings.samples;
  pilot.noise = {photons_for_noise * noise.caustics, photons_for_noise * noise.global};
}

}  // namespace

Pilot look_ahead(Backend& backend, const World& world, const RenderSettings& settings) {
  RenderSettings pilot = coarse_view(settings);
  backend.configure(pilot);
  std::uint32_t width = pilot.crop.width();
  std::vector<shared::PixelSample> samples = backend.trace_camera(pilot_pass, View{});
  double least = 0;           // size of cells, m
  if (samples.size() == 1) {  // no pixel beside it tells how wide it is: cells beside its middle's are to hold it
    samples.push_back(backend.trace_camera(pilot_pass + 1, View{}).front());
    width = 2, least = settings.footprint / 2;
  }
  const auto part = [&](float surfaces) {
    return double(std::count_if(samples.begin(), samples.end(), [=](const auto& s) { return s.split >= surfaces; })) /
           double(samples.size());
  };
  constexpr double worth_a_path = 0.01;  // of the picture
  const std::uint32_t split = part(2) > worth_a_path ? 2 : part(1) > 0 ? 1 : 0;
  const SeenCells cells(samples, width, least);

  std::vector<StartSet> sets = default_starts(world);
  if (cells.empty()) return {sets, split, {}};
  for (StartSet& s : sets) s.windows = {StartWindow{.share = 1.0 / double(sets.size())}};
  std::vector<SeenSet> seen(sets.size());
  std::uint32_t round = 0;
  std::size_t landed = 0;  // in the last look
  const auto look_at = [&](const SeenCells& what, Look how) {
    pilot.caustics.beams = make_beams(world, sets, photons_a_round);
    landed = look(backend, pilot, sets_of_beams(sets), round++, what, how, seen);
  };
  const auto narrow = [&](bool menisci) {
    for (std::size_t i = 0; i < sets.size(); ++i) sets[i].windows = windows_round(seen[i], sets[i], menisci);
    share_out(sets, landed > 0 ? unseen_share : unseen_share_beside);
  };
  // Where so little is seen that hardly a photon lands there, first what lies round it: as wide as some land in, then
  // narrower by steps.
  double around = 0;
  look_at(cells, Look::wider);
  while (landed < enough && around < world.radius) {
    around = zoom * std::max(around, cells.widest());
    look_at(SeenCells(samples, width, around), Look::wider);
  }
  if (landed == 0) around = 0;
  while (around > 0) {
    narrow(false);
    around = around > zoom * cells.widest() ? around / zoom : 0;
    look_at(around > 0 ? SeenCells(samples, width, around) : cells, Look::narrower);
  }
  narrow(false);
  look_at(cells, Look::again);
  narrow(true);
  Pilot result{sets, split, {}};
  if (pilot.global.count() > 0 && !sets.empty()) look_at_maps(backend, world, pilot, result);
  return result;
}

}  // namespace meniscal
