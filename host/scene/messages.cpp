#include "host/scene/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/error.h"

namespace meniscal::gltf {
namespace {

// Text of the file goes to terminals: no control characters, and no URI of a megabyte.
std::string printable(std::string_view text) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  constexpr std::size_t longest = 300;
  std::string result(text.substr(0, longest));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  if (text.size() > longest) result += "...";
  return result;
}

}  // namespace

void Messages::fail(std::string_view object, std::string_view reason, std::string_view remedy) const {
  throw Error(ExitCode::scene, fmt::format("{}: {}: {}; {}", file_, printable(object), printable(reason), remedy));
}

double Messages::in_range(std::string_view object, std::string_view key, double value, Range range) const {
  const bool inside = (range.low_open ? value > range.low : value >= range.low) && value <= range.high;
  if (!inside || std::isnan(value))
    fail(object, fmt::format("{} is {}", key, value),
         fmt::format("give a value {} {}{}", range.low_open ? "above" : "from", range.low,
                     std::isinf(range.high) ? "" : fmt::format(" to {}", range.high)));
  return value;
}

void Messages::require_near(std::string_view object, const glm::dvec3& position) const {
  const double distance = glm::length(position);
  if (!(distance <= greatest_extent))
    fail(object, fmt::format("is {:.3g} m from the scene", distance),
         fmt::format("bring it within {:.0e} m", greatest_extent));
}

void Messages::warn(std::string_view object, std::string_view what) {
  std::string warning = fmt::format("{}: {}: {}", file_, printable(object), printable(what));
  if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
    warnings_.push_back(std::move(warning));
}

std::string label(std::string_view kind, std::string_view name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} \"{}\"", kind, name);
}

}  // namespace meniscal::gltf
