#include "host/gpu/record.h"

#include <algorithm>

namespace meniscal::gpu {

std::size_t Record::add_pass(const std::string& name, const std::map<std::string, double>& variant) {
  const auto found = std::find_if(passes.begin(), passes.end(),
                                  [&](const PassRecord& p) { return p.name == name && p.variant == variant; });
  const auto index = static_cast<std::size_t>(found - passes.begin());
  if (found == passes.end()) passes.push_back({name, variant, {}});
  return index;
}

void Record::change_buffer(const std::string& name, std::ptrdiff_t bytes) {
  if (bytes == 0) return;
  std::size_t &now = bytes_now_[name], &most = buffers[name];
  now += static_cast<std::size_t>(bytes);
  most = std::max(most, now);
}

}  // namespace meniscal::gpu
