#include "host/gpu/choices.h"

namespace meniscal::gpu {

Choices choose(const DeviceInfo& info, const Limits& limits) {
  Choices choices{};
  // Faster on Mesa's software driver by 1.6 to 4 times.
  choices.texel_elements = limits.max_texel_elements;
  // A desktop's GPU is to draw the desktop in between, and its watchdog ends dispatches of some 2 s. A CPU has neither.
  choices.batch_seconds = info.type == "cpu" ? 0.2 : 0.05;
  choices.first_batch = 1u << 16;
  choices.largest_batch = 1u << 22;
  return choices;
}

Choices choose(const DeviceInfo& info, const Limits& limits, const FetchSeconds& measured) {
  constexpr double error = 0.1;
  Choices choices = choose(info, limits);
  if (measured.storage < (1 - error) * measured.texel) choices.texel_elements = 0;
  return choices;
}

}  // namespace meniscal::gpu
