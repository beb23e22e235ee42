#include "host/scene/extras.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace meniscal::gltf {
namespace {

struct Key {
  std::string_view name;
  Place place;
};

constexpr std::array<Key, 18> keys = {{{"angular_diameter", Place::light},
                                       {"dielectric_priority", Place::material},
                                       {"environment", Place::scene},
                                       {"environment_rotation", Place::scene},
                                       {"environment_strength", Place::scene},
                                       {"gravity", Place::scene},
                                       {"meniscus_contact_angle", Place::material},
                                       {"meniscus_density", Place::material},
                                       {"meniscus_flatten", Place::material},
                                       {"meniscus_height_rule", Place::material},
                                       {"meniscus_height_scale", Place::material},
                                       {"meniscus_ignore", Place::material},
                                       {"meniscus_liquid", Place::material},
                                       {"meniscus_profile", Place::material},
                                       {"meniscus_surface_tension", Place::material},
                                       {"meniscus_sweep_scale", Place::material},
                                       {"meniscus_target", Place::material},
                                       {"meniscus_tolerance", Place::material}}};

constexpr std::string_view contact_angle_prefix = "meniscus_contact_angle_";

std::string_view place_name(Place place) {
  switch (place) {
    case Place::material:
      return "materials";
    case Place::light:
      return "lights";
    case Place::scene:
      return "scenes";
    default:
      return "nothing";
  }
}

// Levenshtein's distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, substituted});
    }
  }
  return row.back();
}

const Key* find_key(std::string_view name) {
  if (name.starts_with(contact_angle_prefix)) name = "meniscus_contact_angle";
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

// Names of values for messages, without printing whole arrays.
std::string shown(const tinygltf::Value& value) {
  if (value.IsString()) return fmt::format("the text \"{}\"", value.Get<std::string>());
  if (value.IsBool()) return value.Get<bool>() ? "true" : "false";
  if (value.IsNumber()) return fmt::format("{}", value.GetNumberAsDouble());
  return value.IsArray() ? "an array" : "an object";
}

}  // namespace

bool is_own_extra(std::string_view key) { return key.starts_with("meniscus_") || find_key(key) != nullptr; }

std::optional<double> Extras::number(const std::string& key, Range range) const {
  if (!has(key)) return std::nullopt;
  const tinygltf::Value& value = value_.Get(key);
  if (!value.IsNumber())
    messages_.fail(object_, fmt::format("{} is {}", key, shown(value)),
                   fmt::format("give a number from {} to {}", range.low, range.high));
  return messages_.in_range(object_, key, value.GetNumberAsDouble(), range);
}

std::optional<int> Extras::integer(const std::string& key) const {
  constexpr double limit = 1e9;
  const std::optional<double> value = number(key, {-limit, limit});
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) messages_.fail(object_, fmt::format("{} is {}", key, *value), "give an integer");
  return static_cast<int>(*value);
}

bool Extras::flag(const std::string& key) const {
  if (!has(key)) return false;
  const tinygltf::Value& value = value_.Get(key);
  if (value.IsBool()) return value.Get<bool>();
  if (!value.IsNumber() || (value.GetNumberAsDouble() != 0 && value.GetNumberAsDouble() != 1))
    messages_.fail(object_, fmt::format("{} is {}", key, shown(value)), "give 1 or 0");
  return value.GetNumberAsDouble() == 1;
}

std::optional<std::string> Extras::text(const std::string& key, std::initializer_list<std::string_view> allowed) const {
  if (!has(key)) return std::nullopt;
  const tinygltf::Value& value = value_.Get(key);
  if (!value.IsString() ||
      (allowed.size() != 0 && std::find(allowed.begin(), allowed.end(), value.Get<std::string>()) == allowed.end()))
    messages_.fail(object_, fmt::format("{} is {}", key, shown(value)),
                   allowed.size() ? fmt::format("give one of: {}", fmt::join(allowed, ", ")) : "give a text");
  return value.Get<std::string>();
}

std::map<std::string, double> Extras::numbers_by_name(const std::string& prefix, Range range) const {
  std::map<std::string, double> result;
  for (const std::string& key : value_.Keys())
    if (key.starts_with(prefix) && key.size() > prefix.size()) result[key.substr(prefix.size())] = *number(key, range);
  return result;
}

void warn_of_unread_extras(const tinygltf::Value& extras, Place place, const std::string& object, Messages& messages) {
  for (const std::string& name : extras.Keys()) {
    const Key* key = find_key(name);
    if (key == nullptr && name.starts_with("meniscus_")) {
      const auto nearest = std::min_element(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
        return edit_distance(name, a.name) < edit_distance(name, b.name);
      });
      messages.warn(object, fmt::format("unknown key {} ignored; did you mean {}?", name, nearest->name));
    } else if (key != nullptr && key->place != place) {
      messages.warn(object, fmt::format("{} has no effect here: it is read from {}", name, place_name(key->place)));
    }
  }
}

}  // namespace meniscal::gltf
