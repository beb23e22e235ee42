#include "host/scene/embedded.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace meniscal::gltf {
namespace {

// RFC 4648, section 4; 64 for what is no digit.
constexpr std::array<std::uint8_t, 256> digit_values = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(64);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::uint8_t i = 0; i < 64; ++i) values[static_cast<unsigned char>(digits[i])] = i;
  return values;
}();

// The bytes of padded base64; nothing if it is not that.
std::optional<std::vector<unsigned char>> decode(std::string_view text) {
  if (text.empty() || text.size() % 4 != 0) return std::nullopt;
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::size_t bytes = text.size() / 4 * 3 - padding;
  std::vector<unsigned char> result(bytes + padding);
  const auto value = [&](std::size_t i) -> unsigned {
    return i < text.size() - padding ? digit_values[static_cast<unsigned char>(text[i])] : 0;
  };
  unsigned seen = 0;
  const auto put = [&](std::size_t group, unsigned a, unsigned b, unsigned c, unsigned d) {
    seen |= a | b | c | d;
    const unsigned word = a << 18 | b << 12 | c << 6 | d;
    for (std::size_t k = 0; k < 3; ++k) result[3 * group + k] = static_cast<unsigned char>(word >> (16 - 8 * k));
  };
  const std::size_t last = text.size() / 4 - 1;  // the only group that may be padded
  const auto* in = reinterpret_cast<const unsigned char*>(text.data());
  for (std::size_t g = 0; g < last; ++g, in += 4)
    put(g, digit_values[in[0]], digit_values[in[1]], digit_values[in[2]], digit_values[in[3]]);
  put(last, value(4 * last), value(4 * last + 1), value(4 * last + 2), value(4 * last + 3));
  if (seen >= 64) return std::nullopt;
  result.resize(bytes);
  return result;
}

constexpr std::string_view openings[] = {"\"data:application/octet-stream;base64,",
                                         "\"data:application/gltf-buffer;base64,"};

}  // namespace

std::string embedded_name(std::size_t index) { return fmt::format("embedded:{}", index); }

Embedded take_out_buffers(std::string_view json) {
  Embedded result;
  std::size_t done = 0, end = 0;  // copied up to `done`; looked at up to `end`
  for (std::size_t at; (at = json.find("\"data:application/", end)) != json.npos;) {
    end = at + 1;
    for (const std::string_view opening : openings) {
      const bool escaped = at > 0 && json[at - 1] == '\\';
      if (escaped || !json.substr(at).starts_with(opening)) continue;
      const std::size_t first = at + opening.size(), quote = json.find('"', first);
      if (quote == json.npos) continue;
      auto bytes = decode(json.substr(first, quote - first));
      if (!bytes) continue;
      result.json += json.substr(done, at + 1 - done);
      result.json += embedded_name(result.buffers.size());
      result.buffers.push_back(std::move(*bytes));
      done = end = quote;
    }
  }
  result.json += json.substr(done);
  return result;
}

}  // namespace meniscal::gltf
