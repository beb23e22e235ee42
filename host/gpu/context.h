// What device, buffer, pass and commands share: Vulkan's handles, and the ways to fail and to name.
#pragma once

#include <array>
#include <mutex>

#include "host/gpu/choices.h"
#include "host/gpu/owned.h"
#include "host/gpu/record.h"
#include "host/gpu/vulkan.h"

namespace meniscal::gpu {

struct Context {
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  VolkDeviceTable vk{};  // functions of this device: several devices may be open at a time

  DeviceInfo info{};
  Limits limits{};
  Choices choices{};
  VkPhysicalDeviceMemoryProperties memory{};
  uint32_t timestamp_bits = 0;

  bool validation = false;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger = nullptr;
  PFN_vkSetDebugUtilsObjectNameEXT set_object_name = nullptr;  // null without VK_EXT_debug_utils
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
  std::mutex messages_mutex;  // layers report from any thread
  std::vector<std::string> messages;

  Record record;
  size_t bytes_now = 0, bytes_peak = 0;
  std::array<size_t, VK_MAX_MEMORY_HEAPS> heap_bytes{};  // allocated now

  // Counts an allocation, or its end where change is negative.
  void account(size_t heap, std::ptrdiff_t change);

  // Throws Error(ExitCode::device) unless result is VK_SUCCESS; `doing` completes "... while <doing>".
  void check(VkResult result, const std::string& doing) const;

  // Names an object for debuggers and validation messages.
  template <class Handle>
  void name(VkObjectType type, Handle handle, const std::string& text) const {
    name_object(type, reinterpret_cast<uint64_t>(handle), text);
  }

 private:
  void name_object(VkObjectType type, uint64_t handle, const std::string& text) const;
};

// Takes over a new object of the device, named; `destroy` is one of context->vk's functions.
template <class Handle>
Owned<Handle> own(std::shared_ptr<Context> context, Handle handle, const std::string& name, VkObjectType type,
                  void(VKAPI_PTR* destroy)(VkDevice, Handle, const VkAllocationCallbacks*)) {
  context->name(type, handle, name);
  return {handle, [context = std::move(context), destroy](Handle h) { destroy(context->device, h, nullptr); }};
}

}  // namespace meniscal::gpu
