#include "host/render/header.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <set>

namespace meniscal {
namespace {

constexpr const char* own_footprints = "own";  // of each photon

// OpenEXR multiplies row vectors: GLM's columns are its rows.
std::array<float, 16> rows(const glm::dmat4& m) {
  std::array<float, 16> values{};
  for (int i = 0; i < 16; ++i) values[i] = static_cast<float>(m[i / 4][i % 4]);
  return values;
}

glm::dmat4 projection(const RenderSettings& settings) {
  const CameraAxes axes = camera_axes(settings.camera, settings.width, settings.height);
  const double half_width = glm::length(axes.right), half_height = glm::length(axes.up);
  const double near = std::max(settings.camera.znear, 1e-4), far = 1e4 * near;
  if (settings.camera.orthographic) return glm::ortho(-half_width, half_width, -half_height, half_height, near, far);
  return glm::frustum(-half_width * near, half_width * near, -half_height * near, half_height * near, near, far);
}

}  // namespace

void describe_settings(Image& image, const Scene& scene, const RenderSettings& settings, MeniscusModel model,
                       double meniscus_tolerance, const MapScale& scale) {
  image.text["software"] = "meniscal " MENISCAL_VERSION;
  image.text["sceneHash"] = scene.hash;
  image.text["meniscusModel"] = name_of(model);
  image.text["integrator"] = settings.integrator == Integrator::path       ? "path"
                             : settings.integrator == Integrator::ordinary ? "ordinary"
                                                                           : "targeted";
  image.text["interreflection"] = settings.final_gathering ? "gathered" : "map";
  image.text["mapScale"] = fmt::format("targeted={},caustic={},global={}", scale.targeted, scale.caustic, scale.global);
  image.text["footprints"] = settings.caustics.discs.round() ? "round" : own_footprints;
  image.text["kernel"] = kernel_names[settings.kernel];
  image.numbers["meniscusTolerance"] = meniscus_tolerance;
  image.numbers["seed"] = settings.seed;
  image.numbers["photonsPerPass"] = settings.photons;
  image.numbers["samplesPerPass"] = settings.samples;
  if (settings.highlights != shared::HIGHLIGHTS_NONE)
    image.numbers["highlightSamples"] = settings.highlight_cells * settings.highlight_cells;
  image.numbers["specularBounces"] = settings.specular_bounces;
  image.numbers["diffuseBounces"] = settings.diffuse_bounces;
  if (!settings.caustics.beams.empty()) image.numbers["radius"] = disc_radius(settings, 0);

  glm::dmat4 to_world = settings.camera.pose;
  to_world[3] += glm::dvec4(scene.origin, 0);
  const glm::dmat4 to_camera = glm::inverse(to_world);
  image.matrices["worldToCamera"] = rows(to_camera);
  image.matrices["worldToNDC"] = rows(projection(settings) * to_camera);
}

void describe_passes(Image& image, const PassRanges& passes, double render_seconds) {
  image.text["passRange"] = to_text(passes);
  image.numbers["renderTime"] = render_seconds;
}

std::optional<PassRanges> passes_of(const Image& image) {
  const auto found = image.text.find("passRange");
  return found == image.text.end() ? std::nullopt : parse_pass_ranges(found->second);
}

double render_seconds_of(const Image& image) {
  const auto found = image.numbers.find("renderTime");
  return found == image.numbers.end() ? 0 : found->second;
}

Identity identity_of(const Image& image) {
  Identity identity = {
      {"resolution", fmt::format("{}x{}", image.full_width, image.full_height)},
      {"crop", fmt::format("{},{},{},{}", image.x0, image.y0, image.x0 + image.width, image.y0 + image.height)}};
  std::set<std::string> layers;
  for (const Layer& layer : image.layers)
    for (const std::string& channel : layer.channels)
      layers.insert(layer.name.empty() ? channel : layer.name + "." + channel);
  identity["layers"] = fmt::format("{}", fmt::join(layers, ","));
  identity.insert(image.text.begin(), image.text.end());
  for (const auto& [name, value] : image.numbers) identity[name] = fmt::format("{}", value);
  for (const auto& [name, matrix] : image.matrices) identity[name] = fmt::format("{}", fmt::join(matrix, " "));
  identity.erase("passRange");
  identity.erase("renderTime");
  // Follows from the other settings, but on another device the pilot may see one photon more.
  const auto footprints = identity.find("footprints");
  if (footprints != identity.end() && footprints->second == own_footprints) identity.erase("radius");
  return identity;
}

std::string differences(const Identity& identity, const Identity& other) {
  const auto value = [](const Identity& of, const std::string& name) {
    const auto found = of.find(name);
    return found == of.end() ? "not given" : found->second;
  };
  Identity all = identity;
  all.insert(other.begin(), other.end());
  std::vector<std::string> found;
  for (const auto& [name, ignored] : all) {
    const std::string a = value(identity, name), b = value(other, name);
    if (a == b) continue;
    const bool matrix = std::max(a.size(), b.size()) > 80;
    found.push_back(matrix ? name + " differs" : fmt::format("{} is {} instead of {}", name, a, b));
  }
  return fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace meniscal
