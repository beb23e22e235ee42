// What loading a scene has to say: errors that name file, object, reason and remedy, and warnings, each said once.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace meniscal::gltf {

// Numbers a property may take; `low_open` leaves `low` itself out.
struct Range {
  double low, high;
  bool low_open = false;
};

// What single precision leaves room for: products of three lengths, and light focused or from nearby.
constexpr Range light_range{0, 1e24}, color_range{0, 1e6};
constexpr double greatest_extent = 1e12, least_extent = 1e-12;  // of a scene, metres

class Messages {
 public:
  explicit Messages(std::string file) : file_(std::move(file)) {}

  // Throws Error(ExitCode::scene). `object` is what a user finds in the file, for instance `material "water"`.
  [[noreturn]] void fail(std::string_view object, std::string_view reason, std::string_view remedy) const;

  // Returns `value`, or fails where it is outside `range` or not a number.
  double in_range(std::string_view object, std::string_view key, double value, Range range) const;

  // Fails for a position further from the scene's origin than scenes may be wide, or not finite.
  void require_near(std::string_view object, const glm::dvec3& position) const;

  void warn(std::string_view object, std::string_view what);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::string file_;
  std::vector<std::string> warnings_;
};

// A kind of object with its name (quoted) or, where it has none, its index: `node "post"`, `node 3`.
std::string label(std::string_view kind, std::string_view name, std::size_t index);

}  // namespace meniscal::gltf
