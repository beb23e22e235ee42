// `extras`: what glTF cannot say (interface.md, "Scenes"). A wrong type or range is an error, an unknown key a warning.
#pragma once

#include <tiny_gltf.h>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "host/scene/messages.h"

namespace meniscal::gltf {

// Every key this loader reads, and whatever else begins with `meniscus_`.
bool is_own_extra(std::string_view key);

class Extras {
 public:
  // `object` names the owner in messages. Absent extras read as empty.
  Extras(const tinygltf::Value& value, std::string object, const Messages& messages)
      : value_(value), object_(std::move(object)), messages_(messages) {}

  bool has(const std::string& key) const { return value_.Has(key); }
  std::optional<double> number(const std::string& key, Range range) const;
  std::optional<int> integer(const std::string& key) const;
  // 1, 0, true or false; absent is false.
  bool flag(const std::string& key) const;
  // Empty `allowed`: any text.
  std::optional<std::string> text(const std::string& key, std::initializer_list<std::string_view> allowed) const;
  // PREFIX_NAME = number, by NAME.
  std::map<std::string, double> numbers_by_name(const std::string& prefix, Range range) const;

  const std::string& object() const { return object_; }
  const Messages& messages() const { return messages_; }

 private:
  const tinygltf::Value& value_;
  std::string object_;
  const Messages& messages_;
};

// Where a key is read; a key in the wrong place would be silently without effect.
enum class Place { material, light, scene, elsewhere };

// Warns of keys that begin with `meniscus_` and are unknown (naming the nearest known one), and of known keys that are
// not read in this place.
void warn_of_unread_extras(const tinygltf::Value& extras, Place place, const std::string& object, Messages& messages);

}  // namespace meniscal::gltf
