#include "host/render/widening.h"

#include <algorithm>
#include <cmath>

#include "host/render/pilot.h"
#include "host/render/plan.h"

namespace meniscal {
namespace {

// What pixels see of caustics.
std::vector<glm::dvec3> caustics_of(const Samples& samples) {
  std::vector<glm::dvec3> radiances;
  for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
    const shared::PixelSample& s = samples.pixels[i];
    radiances.emplace_back(s.weight * (s.targeted + s.caustic));
    if (!samples.gloss.empty()) radiances.back() += glm::dvec3(samples.gloss[i].targeted + samples.gloss[i].caustic);
  }
  return radiances;
}

}  // namespace

double find_widening(Backend& backend, const World& world, const RenderSettings& settings,
                     const std::vector<StartSet>& starts, std::uint32_t photons) {
  constexpr double widest = 2.8, steps = 4, wider = 2;
  constexpr std::uint32_t least = 4096, most = 16384;
  const std::uint32_t few = std::min(std::clamp(photons / 8, least, most), photons);
  const double part = double(few) / photons;
  RenderSettings look = coarse_view(settings);
  look.seed = ~look.seed;  // what is rendered does not decide on itself
  look.global.beams.clear();
  const auto light = [&](double widening) {
    // Reach goes by the photons' spacing and, from there, as their number to the power of 0.2.
    look.caustics.beams = make_beams(world, starts, few, widening * std::pow(part, 0.5 - 0.2));
    look.caustics.discs = default_discs(look, world.radius);
    backend.configure(look);
    return std::array{caustics_of(backend.light_camera(0, View{}, 0)), caustics_of(backend.light_camera(0, View{}, 1))};
  };
  const auto usual = light(1), wide = light(wider);
  double noise = 0, blur = 0, squares = 0;  // sums over pixels
  for (std::size_t i = 0; i < usual[0].size(); ++i) {
    const glm::dvec3 d = usual[0][i] - usual[1][i];
    noise += glm::dot(d, d) / 2;
    const double agreed = glm::dot(wide[0][i] - usual[0][i], wide[1][i] - usual[1][i]);
    blur += agreed;
    squares += agreed * agreed;
  }
  if (!(noise > 0)) return 1;
  // Starts are spread evenly: by more photons in a disc noise falls faster than by chance.
  noise *= std::pow(part, 1.5);
  // Blur that chance may hide counts as blur.
  blur = std::max(blur, 0.0) + std::sqrt(squares);
  // Of discs m times as wide, noise is that / m^4 and blur m^2 blur: their sum is least there.
  const double best = std::pow(2 * noise / (blur / ((wider - 1) * (wider - 1))), 1.0 / 6);
  return std::clamp(std::exp2(std::round(steps * std::log2(best)) / steps), 1.0, widest);
}

}  // namespace meniscal
