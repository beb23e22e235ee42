// Vulkan's instance and the devices it offers.
#pragma once

#include <optional>

#include "host/gpu/context.h"

namespace meniscal::gpu {

struct Candidate {
  VkPhysicalDevice physical;
  uint32_t queue_family;  // first with compute
  DeviceInfo info;
};

inline constexpr uint32_t required_api = VK_API_VERSION_1_2;

// Fills instance and, where validation is wanted and installed, messenger and layer. False, and nothing filled, where
// there is no loader, or one older than Vulkan 1.2, or no driver that starts. Extension functions are fetched here.
bool open_instance(Context& context, bool validation);

// Devices with Vulkan 1.2 and a compute queue, in the drivers' order.
std::vector<Candidate> find_candidates(VkInstance instance);

}  // namespace meniscal::gpu
