#include "host/gpu/context.h"

#include <algorithm>

#include "host/error.h"

namespace meniscal::gpu {

Context::~Context() {
  if (device) vk.vkDestroyDevice(device, nullptr);
  if (messenger) destroy_messenger(instance, messenger, nullptr);
  if (instance) vkDestroyInstance(instance, nullptr);
}

namespace {

std::string result_name(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost (VK_ERROR_DEVICE_LOST)";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory (VK_ERROR_OUT_OF_DEVICE_MEMORY)";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory (VK_ERROR_OUT_OF_HOST_MEMORY)";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver did not start (VK_ERROR_INITIALIZATION_FAILED)";
    default:
      return "Vulkan error " + std::to_string(static_cast<int>(result));
  }
}

}  // namespace

void Context::check(VkResult result, const std::string& doing) const {
  if (result == VK_SUCCESS) return;
  std::string remedy = "try another device (`meniscal devices` lists them) or `--device cpu`, the reference path";
  if (result == VK_ERROR_DEVICE_LOST) {
    remedy = "a driver ends work that runs too long: try fewer photons per pass (--photons); else " + remedy;
  } else if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    remedy = "try fewer photons per pass (--photons) or a smaller picture (--resolution); else " + remedy;
  }
  throw Error(ExitCode::device,
              "device '" + info.name + "': " + result_name(result) + " while " + doing + "; " + remedy);
}

void Context::account(size_t heap, std::ptrdiff_t change) {
  heap_bytes[heap] += static_cast<size_t>(change);
  bytes_now += static_cast<size_t>(change);
  bytes_peak = std::max(bytes_peak, bytes_now);
}

void Context::name_object(VkObjectType type, uint64_t handle, const std::string& text) const {
  if (!set_object_name) return;
  auto object = vk_structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  object.objectType = type;
  object.objectHandle = handle;
  object.pObjectName = text.c_str();
  set_object_name(device, &object);
}

}  // namespace meniscal::gpu
