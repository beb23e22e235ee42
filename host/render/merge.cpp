#include "host/render/merge.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/error.h"

namespace meniscal {
namespace {

const char* const variance_layer = "variance";

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw Error(ExitCode::scene,
              fmt::format("{}: {}; merge different passes of one scene with the same settings", name, reason));
}

}  // namespace

PassRanges Merge::require_own_passes(const Image& image, const std::string& name) const {
  const Layer *beauty = image.find(""), *variance = image.find(variance_layer);
  if (variance && !(beauty && beauty->channels == variance->channels)) refuse(name, "its variance is of no beauty");
  const std::optional<PassRanges> passes = passes_of(image);
  if (!passes) refuse(name, "its header does not say which passes it holds");
  for (const Part& other : parts_)
    if (const auto both = overlap(*passes, other.passes))
      refuse(name, fmt::format("passes {} are in {}, too", to_text({*both}), other.name));
  return *passes;
}

// Chan, Golub and LeVeque 1979: squared deviations from the mean of both are those from each one's own mean, and what
// the means are apart. A single pass deviates by nothing from its own, so it needs no variance to count here.
void Merge::add_deviations(Sum& deviations, const Image& image, double passes) const {
  const auto beauty = std::find_if(sums_.begin(), sums_.end(), [](const Sum& s) { return s.layer.empty(); });
  const Layer *mean = image.find(""), *variance = image.find(variance_layer);
  const double before = double(count(passes_));
  for (std::size_t i = 0; i < deviations.values.size(); ++i) {
    deviations.values[i] += double(variance->pixels[i]) * passes * (passes - 1);
    if (before == 0) continue;
    const double apart = double(mean->pixels[i]) - beauty->values[i] / before;
    deviations.values[i] += apart * apart * before * passes / (before + passes);
  }
}

void Merge::add(const Image& image, const std::string& name) {
  const Identity identity = identity_of(image);
  if (parts_.empty()) {
    identity_ = identity;
    frame_ = image;
    for (Layer& layer : frame_.layers) {
      sums_.push_back({layer.name, std::vector<double>(layer.pixels.size())});
      layer.pixels = {};
    }
  }
  const PassRanges ranges = require_own_passes(image, name);
  if (identity != identity_)
    refuse(name, fmt::format("it does not go with {}: {}", parts_.front().name, differences(identity, identity_)));

  const double passes = double(count(ranges));
  for (Sum& sum : sums_)
    if (sum.layer == variance_layer) add_deviations(sum, image, passes);
  for (Sum& sum : sums_) {
    if (sum.layer == variance_layer) continue;
    const std::vector<float>& mean = image.find(sum.layer)->pixels;
    for (std::size_t i = 0; i < mean.size(); ++i) sum.values[i] += passes * double(mean[i]);
  }
  passes_ = joined(passes_, ranges);
  seconds_ += render_seconds_of(image);
  parts_.push_back({name, ranges});
}

Image Merge::result() const {
  Image image = frame_;
  describe_passes(image, passes_, seconds_);
  const double n = double(count(passes_));
  for (std::size_t l = 0; l < sums_.size(); ++l) {
    const double divisor = sums_[l].layer != variance_layer ? n : n > 1 ? n * (n - 1) : 1;
    std::vector<float>& pixels = image.layers[l].pixels;
    pixels.reserve(sums_[l].values.size());
    for (const double sum : sums_[l].values) pixels.push_back(static_cast<float>(sum / divisor));
  }
  return image;
}

}  // namespace meniscal
