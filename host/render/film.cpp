#include "host/render/film.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace meniscal {
namespace {

using shared::PixelGloss;
using shared::PixelSample;

// What is beyond them, as variances of very bright pictures are, is the greatest that images hold.
float to_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -most, most));
}

// A sample with its gloss; all zeros where nothing reflects beyond Lambert's law.
struct Seen {
  const PixelSample& pixel;
  const PixelGloss& gloss;
};
Seen seen(const Samples& samples, std::size_t i) {
  static const PixelGloss none{};
  return {samples.pixels[i], samples.gloss.empty() ? none : samples.gloss[i]};
}

// Radiance by one map or the lights. Where a face holds nearly all light back, rounding leaves less than none.
using Part = glm::vec3 PixelSample::*;
glm::dvec3 reflected(const Seen& s, Part irradiance, glm::vec3 PixelGloss::*beyond, double scale) {
  const glm::dvec3 lambert = glm::dvec3(s.pixel.weight) * glm::dvec3(s.pixel.*irradiance);
  glm::dvec3 sum = lambert + glm::dvec3(s.gloss.*beyond);
  // No more than rounding: where samples keep what another was told, a sum alone may be below 0 that their mean is not.
  for (int c = 0; c < 3; ++c)
    if (sum[c] < 0 && -sum[c] <= 1e-4 * lambert[c]) sum[c] = 0;
  return sum * scale;
}
glm::dvec3 direct(const Seen& s) { return reflected(s, &PixelSample::direct, &PixelGloss::direct, 1); }
glm::dvec3 targeted(const Seen& s, double scale) {
  return reflected(s, &PixelSample::targeted, &PixelGloss::targeted, scale);
}
glm::dvec3 caustic(const Seen& s, double scale) {
  return reflected(s, &PixelSample::caustic, &PixelGloss::caustic, scale);
}
glm::dvec3 global(const Seen& s, double scale) {
  return reflected(s, &PixelSample::global, &PixelGloss::global, scale);
}

// What a layer keeps of a sample: up to three numbers.
struct Aov {
  std::string name;
  std::vector<std::string> channels;
  std::function<glm::dvec3(const Seen&, const MapScale&)> value;  // null: it is no sum over samples
  bool radiance = false;  // adds up over the paths that a pixel's path is split into; the others are of the main one
};

const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};

const std::vector<Aov>& all_aovs() {
  static const std::vector<Aov> aovs = {
      {"direct", rgb, [](const Seen& s, const MapScale&) { return direct(s); }, true},
      {"targeted", rgb, [](const Seen& s, const MapScale& m) { return targeted(s, m.targeted); }, true},
      {"caustic", rgb, [](const Seen& s, const MapScale& m) { return caustic(s, m.caustic); }, true},
      {"global", rgb, [](const Seen& s, const MapScale& m) { return global(s, m.global); }, true},
      {"highlight", rgb, nullptr},
      {"irradiance", rgb,
       [](const Seen& s, const MapScale& m) {
         return glm::dvec3(s.pixel.direct) + glm::dvec3(s.pixel.targeted) * m.targeted +
                glm::dvec3(s.pixel.caustic) * m.caustic + glm::dvec3(s.pixel.global) * m.global;
       }},
      {"albedo", rgb, [](const Seen& s, const MapScale&) { return glm::dvec3(s.pixel.albedo); }},
      {"normal", xyz, [](const Seen& s, const MapScale&) { return glm::dvec3(s.pixel.normal); }},
      {"depth", {"Z"}, [](const Seen& s, const MapScale&) { return glm::dvec3(double(s.pixel.depth)); }},
      {"position", xyz, [](const Seen& s, const MapScale&) { return glm::dvec3(s.pixel.position); }},
      {"meniscus", {"Y"}, [](const Seen& s, const MapScale&) { return glm::dvec3(double(s.pixel.meniscus)); }},
      {"density",
       {"Y"},
       [](const Seen& s, const MapScale&) {
         return glm::dvec3(double(s.pixel.targeted_count + s.pixel.caustic_count + s.pixel.global_count));
       }},
      {"variance", rgb, nullptr},
  };
  return aovs;
}

}  // namespace

const std::vector<std::string>& aov_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Aov& a : all_aovs()) list.push_back(a.name);
    return list;
  }();
  return names;
}

Film::Film(const Crop& crop, const std::vector<std::string>& aovs, const MapScale& scale, const glm::dvec3& origin)
    : crop_(crop),
      scale_(scale),
      origin_(origin),
      pass_(crop.pixels()),
      pass_weight_(crop.pixels()),
      beauty_(crop.pixels(), crop.width()) {
  for (const Aov& a : all_aovs())
    if (std::find(aovs.begin(), aovs.end(), a.name) != aovs.end())
      aovs_.push_back({a.name, a.channels, std::vector<double>(crop.pixels() * a.channels.size())});
}

void Film::add(const Samples& samples, const View& view) {
  if (view.bounced) {
    add_bounced(samples);
    return;
  }
  const std::size_t pixels = samples.pixels.size();
  if (view.main()) {
    ++pass_samples_;
    for (std::size_t i = 0; i < pixels; ++i) pass_weight_[i] += glm::dvec3(samples.pixels[i].weight);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    const Seen s = seen(samples, i);
    pass_[i] += glm::dvec3(s.pixel.emitted) + direct(s) + targeted(s, scale_.targeted) + caustic(s, scale_.caustic) +
                global(s, scale_.global);
  }
  if (!samples.highlights.empty()) add_highlights(samples.highlights);
  for (Sum& sum : aovs_) {
    const auto aov =
        std::find_if(all_aovs().begin(), all_aovs().end(), [&](const Aov& a) { return a.name == sum.name; });
    if (!aov->value || (!view.main() && !aov->radiance)) continue;
    const std::size_t channels = sum.channels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
      glm::dvec3 value = aov->value(seen(samples, i), scale_);
      if (sum.name == "position" && samples.pixels[i].triangle < shared::END_FIRST) value += origin_;
      for (std::size_t c = 0; c < channels; ++c) sum.values[i * channels + c] += value[static_cast<int>(c)];
    }
  }
}

void Film::add_highlights(const std::vector<glm::vec3>& highlights) {
  const auto layer = std::find_if(aovs_.begin(), aovs_.end(), [](const Sum& s) { return s.name == "highlight"; });
  for (std::size_t i = 0; i < highlights.size(); ++i) {
    const glm::dvec3 sum = double(pass_samples_) * glm::dvec3(highlights[i]);
    pass_[i] += sum;
    for (int c = 0; c < 3 && layer != aovs_.end(); ++c) layer->values[3 * i + static_cast<std::size_t>(c)] += sum[c];
  }
}

// Whatever a further diffuse surface is lit by, it is interreflection; the light that the bounce itself met is direct.
void Film::add_bounced(const Samples& samples) {
  std::vector<double>*of_lights = nullptr, *of_global = nullptr, *irradiance = nullptr;
  for (Sum& sum : aovs_) {
    if (sum.name == "direct") of_lights = &sum.values;
    if (sum.name == "global") of_global = &sum.values;
    if (sum.name == "irradiance") irradiance = &sum.values;
  }
  for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
    const Seen s = seen(samples, i);
    const double scale = scale_.global, scattered = samples.gloss.empty() ? 1 : double(s.gloss.scattered);
    const glm::dvec3 radiance = (direct(s) + targeted(s, 1) + caustic(s, 1) + global(s, 1)) * scale;
    pass_[i] += radiance + glm::dvec3(s.pixel.emitted);
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * i + static_cast<std::size_t>(c);
      if (of_lights) (*of_lights)[at] += double(s.pixel.emitted[c]);
      if (of_global) (*of_global)[at] += radiance[c];
      if (irradiance && pass_weight_[i][c] > 0)
        (*irradiance)[at] += scattered * radiance[c] / pass_weight_[i][c] * pass_samples_;
    }
  }
}

void Film::end_pass(std::uint32_t pass) {
  for (glm::dvec3& pixel : pass_) pixel /= double(pass_samples_);
  beauty_.add(pass, pass_);
  for (std::vector<glm::dvec3>* sums : {&pass_, &pass_weight_}) std::fill(sums->begin(), sums->end(), glm::dvec3(0));
  samples_ += pass_samples_;
  pass_samples_ = 0;
}

Image Film::image(std::uint32_t full_width, std::uint32_t full_height) const {
  Image image;
  image.width = static_cast<int>(crop_.width());
  image.height = static_cast<int>(crop_.height());
  image.x0 = static_cast<int>(crop_.x0);
  image.y0 = static_cast<int>(crop_.y0);
  image.full_width = static_cast<int>(full_width);
  image.full_height = static_cast<int>(full_height);
  const double scale = samples_ > 0 ? 1.0 / samples_ : 0;

  Layer beauty{"", rgb, {}};
  for (std::size_t i = 0; i < beauty_.pixels(); ++i)
    for (int c = 0; c < 3; ++c) beauty.pixels.push_back(to_float(beauty_.mean(i)[c]));
  image.layers.push_back(std::move(beauty));
  for (const Sum& sum : aovs_) {
    Layer layer{sum.name, sum.channels, {}};
    if (sum.name == "variance") {
      for (std::size_t i = 0; i < beauty_.pixels(); ++i)
        for (int c = 0; c < 3; ++c) layer.pixels.push_back(to_float(beauty_.variance(i)[c]));
    } else {
      for (double v : sum.values) layer.pixels.push_back(to_float(v * scale));
    }
    image.layers.push_back(std::move(layer));
  }
  return image;
}

}  // namespace meniscal
