#include "host/render/film.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/constants.hpp>

namespace meniscal {
namespace {

using shared::PixelSample;

// What a layer keeps of a sample: up to three numbers.
struct Aov {
  std::string name;
  std::vector<std::string> channels;
  std::function<glm::dvec3(const PixelSample&, const MapScale&)> value;
  bool radiance = false;  // adds up over the paths that a pixel's path is split into; the others are of the main one
};

const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};

glm::dvec3 weighted(const PixelSample& s, const glm::vec3& irradiance, double scale) {
  return glm::dvec3(s.weight) * glm::dvec3(irradiance) * scale;
}

const std::vector<Aov>& all_aovs() {
  static const std::vector<Aov> aovs = {
      {"direct", rgb, [](const PixelSample& s, const MapScale&) { return weighted(s, s.direct, 1); }, true},
      {"targeted", rgb, [](const PixelSample& s, const MapScale& m) { return weighted(s, s.targeted, m.targeted); },
       true},
      {"caustic", rgb, [](const PixelSample& s, const MapScale& m) { return weighted(s, s.caustic, m.caustic); }, true},
      {"global", rgb, [](const PixelSample& s, const MapScale& m) { return weighted(s, s.global, m.global); }, true},
      {"irradiance", rgb,
       [](const PixelSample& s, const MapScale& m) {
         return glm::dvec3(s.direct) + glm::dvec3(s.targeted) * m.targeted + glm::dvec3(s.caustic) * m.caustic +
                glm::dvec3(s.global) * m.global;
       }},
      {"albedo", rgb, [](const PixelSample& s, const MapScale&) { return glm::dvec3(s.albedo); }},
      {"normal", xyz, [](const PixelSample& s, const MapScale&) { return glm::dvec3(s.normal); }},
      {"depth", {"Z"}, [](const PixelSample& s, const MapScale&) { return glm::dvec3(double(s.depth)); }},
      {"position", xyz, [](const PixelSample& s, const MapScale&) { return glm::dvec3(s.position); }},
      {"meniscus", {"Y"}, [](const PixelSample& s, const MapScale&) { return glm::dvec3(double(s.meniscus)); }},
      {"density",
       {"Y"},
       [](const PixelSample& s, const MapScale&) {
         return glm::dvec3(double(s.targeted_count + s.caustic_count + s.global_count));
       }},
      {"variance", rgb, [](const PixelSample&, const MapScale&) { return glm::dvec3(0); }},
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
      beauty_(crop.pixels()) {
  for (const Aov& a : all_aovs())
    if (std::find(aovs.begin(), aovs.end(), a.name) != aovs.end())
      aovs_.push_back({a.name, a.channels, std::vector<double>(crop.pixels() * a.channels.size())});
}

void Film::add(const std::vector<PixelSample>& samples, const View& view) {
  if (view.bounced) {
    add_bounced(samples);
    return;
  }
  if (view.main()) {
    ++pass_samples_;
    for (std::size_t i = 0; i < samples.size(); ++i) pass_weight_[i] += glm::dvec3(samples[i].weight);
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PixelSample& s = samples[i];
    pass_[i] += glm::dvec3(s.emitted) + weighted(s, s.direct, 1) + weighted(s, s.targeted, scale_.targeted) +
                weighted(s, s.caustic, scale_.caustic) + weighted(s, s.global, scale_.global);
  }
  for (Sum& sum : aovs_) {
    const auto aov =
        std::find_if(all_aovs().begin(), all_aovs().end(), [&](const Aov& a) { return a.name == sum.name; });
    if (!view.main() && !aov->radiance) continue;
    const std::size_t channels = sum.channels.size();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      glm::dvec3 value = aov->value(samples[i], scale_);
      if (sum.name == "position" && samples[i].triangle < shared::END_FIRST) value += origin_;
      for (std::size_t c = 0; c < channels; ++c) sum.values[i * channels + c] += value[static_cast<int>(c)];
    }
  }
}

// Whatever a further diffuse surface is lit by, it is interreflection.
void Film::add_bounced(const std::vector<PixelSample>& samples) {
  std::vector<double>*global = nullptr, *irradiance = nullptr;
  for (Sum& sum : aovs_) {
    if (sum.name == "global") global = &sum.values;
    if (sum.name == "irradiance") irradiance = &sum.values;
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PixelSample& s = samples[i];
    const glm::dvec3 radiance = weighted(s, s.direct + s.targeted + s.caustic + s.global, scale_.global);
    pass_[i] += radiance;
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * i + static_cast<std::size_t>(c);
      if (global) (*global)[at] += radiance[c];
      if (irradiance && pass_weight_[i][c] > 0) (*irradiance)[at] += radiance[c] / pass_weight_[i][c] * pass_samples_;
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
    for (int c = 0; c < 3; ++c) beauty.pixels.push_back(static_cast<float>(beauty_.mean(i)[c]));
  image.layers.push_back(std::move(beauty));
  for (const Sum& sum : aovs_) {
    Layer layer{sum.name, sum.channels, {}};
    if (sum.name == "variance") {
      for (std::size_t i = 0; i < beauty_.pixels(); ++i)
        for (int c = 0; c < 3; ++c) layer.pixels.push_back(static_cast<float>(beauty_.variance(i)[c]));
    } else {
      for (double v : sum.values) layer.pixels.push_back(static_cast<float>(v * scale));
    }
    image.layers.push_back(std::move(layer));
  }
  return image;
}

}  // namespace meniscal
