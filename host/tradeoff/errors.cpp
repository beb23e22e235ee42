#include "host/tradeoff/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/image/compare.h"

namespace meniscal {
namespace {

const Layer& beauty(const Image& image) { return *image.find(""); }

// The light of the caustics, by pixel; the brightest channel stands for all.
std::vector<double> caustic_light(const Image& image) {
  std::vector<double> light(image.pixel_count(), 0);
  for (const char* name : {"targeted", "caustic"})
    if (const Layer* layer = image.find(name)) {
      const std::size_t n = layer->channels.size();
      for (std::size_t i = 0; i < light.size(); ++i)
        light[i] += double(*std::max_element(&layer->pixels[i * n], &layer->pixels[i * n] + n));
    }
  return light;
}

std::vector<bool> caustic_mask(const Image& image) {
  const std::vector<double> light = caustic_light(image);
  double brightest = 0;
  for (const double l : light)
    if (std::isfinite(l)) brightest = std::max(brightest, l);
  std::vector<bool> mask;
  for (const double l : light) mask.push_back(l > caustic_part * brightest);
  return mask;
}

// Black outside: what is black in both pictures adds neither to the difference nor to what it is relative to.
Image only_beauty(const Image& image, const std::vector<bool>* mask) {
  Image result = image;
  result.layers = {beauty(image)};
  Layer& layer = result.layers.front();
  if (mask)
    for (std::size_t i = 0; i < mask->size(); ++i)
      if (!(*mask)[i]) std::fill_n(&layer.pixels[3 * i], 3, 0.0f);
  return result;
}

double relative_rmse(const Image& image, const Image& reference, const std::vector<bool>* mask) {
  const LayerDifference d =
      compare(only_beauty(image, mask), "picture", only_beauty(reference, mask), "reference").front();
  return d.non_finite > 0 ? std::numeric_limits<double>::infinity() : d.relative_rmse;
}

}  // namespace

Reference::Reference(Image image, ToneMap operation, std::optional<double> exposure)
    : image_(std::move(image)), operation_(operation), exposure_(exposure), caustic_(caustic_mask(image_)) {
  srgb_ = show(image_);
}

std::size_t Reference::caustic_pixels() const {
  return static_cast<std::size_t>(std::count(caustic_.begin(), caustic_.end(), true));
}

std::vector<std::uint8_t> Reference::show(const Image& image) const {
  return tone_map_like(beauty(image_).pixels, beauty(image).pixels, operation_, exposure_);
}

Flip Reference::flip_of(const Image& image) const { return flip(srgb_, show(image), image_.width, image_.height); }

Errors Reference::errors_of(const Image& image) const {
  Errors errors;
  errors.image = relative_rmse(image, image_, nullptr);
  errors.caustic =
      caustic_pixels() > 0 ? relative_rmse(image, image_, &caustic_) : std::numeric_limits<double>::quiet_NaN();
  errors.flip = flip_of(image).mean;
  return errors;
}

}  // namespace meniscal
