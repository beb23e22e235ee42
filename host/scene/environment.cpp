#include "host/scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/image/exr.h"
#include "host/scene/extras.h"
#include "host/scene/guard.h"

namespace meniscal::gltf {
namespace {

// Colours, or grey, of each pixel.
std::vector<glm::vec3> colours_of(const Image& image, const std::string& object, const Messages& messages) {
  const Layer* layer = image.find("");
  const bool colour =
      layer && layer->channels.size() >= 3 &&
      std::equal(layer->channels.begin(), layer->channels.begin() + 3, std::array{"R", "G", "B"}.begin());
  const bool grey = layer && !colour && layer->channels.front() == "Y";
  if (!colour && !grey) messages.fail(object, "has no channels R, G, B, nor Y", "save it as an RGB image");
  const std::size_t stride = layer->channels.size();
  std::vector<glm::vec3> colours;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float* pixel = layer->pixels.data() + i * stride;
    colours.push_back(grey ? glm::vec3(pixel[0]) : glm::vec3(pixel[0], pixel[1], pixel[2]));
  }
  return colours;
}

// Makes radiance of them; gives how many numbers could not be.
std::size_t scale(std::vector<glm::vec3>& colours, double strength) {
  std::size_t unusable = 0;
  for (glm::vec3& colour : colours)
    for (int c = 0; c < 3; ++c) {
      const double value = strength * double(colour[c]);
      const bool usable = value >= light_range.low && value <= light_range.high;
      colour[c] = usable ? static_cast<float>(value) : 0;
      unusable += usable ? 0 : 1;
    }
  return unusable;
}

}  // namespace

std::optional<Environment> read_environment(const tinygltf::Model& model, AssetFolder& folder, Messages& messages,
                                            std::string& file, Stages& stages) {
  if (model.scenes.empty()) return std::nullopt;
  const auto index = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  const Extras extras(model.scenes[index].extras, label("scene", model.scenes[index].name, index), messages);
  const double rotation = extras.number("environment_rotation", {-1e6, 1e6}).value_or(0);
  const double strength = extras.number("environment_strength", {0, 1e9}).value_or(1);
  const std::optional<std::string> uri = extras.text("environment", {});
  if (!uri) return std::nullopt;

  const Stopwatch watch;
  const std::string object = fmt::format("environment \"{}\"", *uri);
  const std::vector<unsigned char> bytes = folder.read_beside(*uri);
  file = *uri;
  const auto decoded = [&] {
    try {
      return decode_exr({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const std::exception& error) {
      messages.fail(object, fmt::format("is not a readable EXR image: {}", error.what()), "save it as OpenEXR");
    }
  };
  const Image image = decoded();
  if (image.width != image.full_width || image.height != image.full_height)
    messages.fail(object, "is a part of an image", "save all of it");
  if (image.width != 2 * image.height)
    messages.warn(object,
                  fmt::format("has {} x {} pixels: all directions in latitude and longitude are twice as wide as high",
                              image.width, image.height));
  Environment environment{image.width, image.height, colours_of(image, object, messages), glm::radians(rotation)};
  const std::size_t unusable = scale(environment.radiance, strength);
  stages.add("environment image", watch.seconds());
  if (unusable > 0)
    messages.warn(object, fmt::format("{} numbers that are negative, beyond {} or none are taken as 0", unusable,
                                      light_range.high));
  if (std::all_of(environment.radiance.begin(), environment.radiance.end(),
                  [](const glm::vec3& c) { return c == glm::vec3(0); })) {
    messages.warn(object, "is black");
    return std::nullopt;
  }
  return environment;
}

}  // namespace meniscal::gltf
