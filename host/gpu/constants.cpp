#include "host/gpu/constants.h"

#include <bit>
#include <cstring>
#include <set>

namespace meniscal::gpu {
namespace {

// SPIR-V 1.3, sections 2.3 (words of a module) and 3.32 (instructions).
enum Op : std::uint32_t {
  OpName = 5,
  OpTypeFloat = 22,
  OpSpecConstantTrue = 48,
  OpSpecConstantFalse = 49,
  OpSpecConstant = 50,
  OpDecorate = 71
};
constexpr std::size_t header_words = 5;
constexpr std::uint32_t decoration_spec_id = 1;

struct Module {
  std::map<std::uint32_t, std::string> names;
  std::map<std::uint32_t, std::uint32_t> spec_ids;
  std::set<std::uint32_t> floats;  // types
  struct Constant {
    std::uint32_t result, bits;
    bool is_float;
  };
  std::vector<Constant> constants;
};

Module read(std::span<const std::uint32_t> spirv) {
  Module module;
  for (std::size_t i = header_words; i < spirv.size();) {
    const std::size_t words = spirv[i] >> 16;
    if (words == 0 || words > spirv.size() - i) break;
    const auto w = spirv.subspan(i, words);
    switch (w[0] & 0xFFFFu) {
      case OpName: {
        const char* text = reinterpret_cast<const char*>(&w[2]);
        module.names[w[1]] = std::string(text, strnlen(text, 4 * (words - 2)));
        break;
      }
      case OpDecorate:
        if (w[2] == decoration_spec_id) module.spec_ids[w[1]] = w[3];
        break;
      case OpTypeFloat:
        module.floats.insert(w[1]);
        break;
      case OpSpecConstantTrue:
      case OpSpecConstantFalse:
        module.constants.push_back({w[2], (w[0] & 0xFFFFu) == OpSpecConstantTrue ? 1u : 0u, false});
        break;
      case OpSpecConstant:
        module.constants.push_back({w[2], w[3], module.floats.contains(w[1])});
        break;
      default:
        break;
    }
    i += words;
  }
  return module;
}

}  // namespace

std::map<std::string, double> named_constants(std::span<const std::uint32_t> spirv,
                                              const std::vector<std::uint32_t>& given) {
  const Module module = read(spirv);
  std::map<std::string, double> values;
  for (const Module::Constant& c : module.constants) {
    const auto id = module.spec_ids.find(c.result);
    if (id == module.spec_ids.end()) continue;
    const std::uint32_t bits = id->second < given.size() ? given[id->second] : c.bits;
    const auto name = module.names.find(c.result);
    values[name != module.names.end() ? name->second : "constant " + std::to_string(id->second)] =
        c.is_float ? double(std::bit_cast<float>(bits)) : double(bits);
  }
  return values;
}

}  // namespace meniscal::gpu
