#include "host/reference/sky.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/path.h"
#include "host/world/lights.h"
#include "shaders/shared/highlights.h"

namespace meniscal::reference {
namespace {

constexpr double pi = glm::pi<double>();

double solid_angle(const shared::Light& sun) { return 2 * pi * double(sun.cone_versine); }

DistantSample sample_sun(const shared::Light& sun, const glm::dvec2& place) {
  const glm::dvec3 axis = -glm::normalize(glm::dvec3(sun.direction));
  const double versine = double(sun.cone_versine) * place.x;
  return {around(axis, std::sqrt(versine * (2 - versine)), 1 - versine, place.y), glm::dvec3(sun.intensity),
          solid_angle(sun)};
}

// All bits that a uniform number has in float.
std::uint32_t bits_of(double unit) { return static_cast<std::uint32_t>(unit * 0x1p32); }

// The row by place.x, in it the column by place.y; what is left of both is the place in the pixel.
DistantSample sample_environment(const World& world, const glm::dvec2& place) {
  const SampledEnvironment& e = world.environment;
  const Picked row = pick(world.cdf, e.first, e.rows, bits_of(place.x));
  const Picked column = pick(world.cdf, e.first + e.rows + row.index * e.columns, e.columns, bits_of(place.y));
  const glm::vec4 pixel = e.pixels[std::size_t(row.index) * e.columns + column.index];
  const double high = std::cos(pi * row.index / e.rows), low = std::cos(pi * (row.index + 1) / e.rows);
  const double cosine = high + (low - high) * row.rest, sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
  const double azimuth = 2 * pi * ((column.index + column.rest) / e.columns - 0.5 - e.turn);
  const double density = double(pixel.w);
  return {{sine * std::cos(azimuth), cosine, sine * std::sin(azimuth)}, glm::dvec3(pixel) / density, 1 / density};
}

}  // namespace

DistantSample sample_distant(const World& world, const shared::Light& light, const glm::dvec2& place) {
  if (light.type == shared::LIGHT_ENVIRONMENT) return sample_environment(world, place);
  if (is_sun(light)) return sample_sun(light, place);
  return {-glm::normalize(glm::dvec3(light.direction)), glm::dvec3(light.intensity), 0};
}

SkySample sky(const World& world, const glm::dvec3& direction, bool in_meniscus) {
  SkySample s{glm::dvec3(0), 0};
  for (const shared::Light& light : world.lights) {
    if (is_sun(light)) {
      if (in_meniscus && light.cone_versine <= shared::MOST_VERSINE) continue;
      const double sine = glm::length(glm::cross(direction, glm::normalize(glm::dvec3(light.direction))));
      const double edge = double(light.cone_versine) * (2 - double(light.cone_versine));  // sine squared
      if (glm::dot(direction, glm::dvec3(light.direction)) >= 0 || sine * sine >= edge) continue;
      s.radiance += glm::dvec3(light.intensity) / solid_angle(light);
      s.pdf += double(light.probability) / solid_angle(light);
    } else if (light.type == shared::LIGHT_ENVIRONMENT) {
      const SampledEnvironment& e = world.environment;
      const double turns = std::atan2(direction.z, direction.x) / (2 * pi) + 0.5 + e.turn;
      const double down = std::acos(glm::clamp(direction.y, -1.0, 1.0)) / pi;
      const auto column = std::min(static_cast<std::uint32_t>((turns - std::floor(turns)) * e.columns), e.columns - 1);
      const auto row = std::min(static_cast<std::uint32_t>(down * e.rows), e.rows - 1);
      const glm::vec4 pixel = e.pixels[std::size_t(row) * e.columns + column];
      s.radiance += glm::dvec3(pixel);
      s.pdf += double(light.probability) * double(pixel.w);
    }
  }
  return s;
}

}  // namespace meniscal::reference
