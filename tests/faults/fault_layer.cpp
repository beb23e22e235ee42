// A Vulkan layer that lets a call fail: MENISCAL_TEST_FAULT="vkQueueSubmit 3 -4" gives the third call's result, and,
// where that is a lost device (-4), that of all which follow.
#include <vulkan/vk_layer.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

PFN_vkGetInstanceProcAddr next_of_instance;
PFN_vkGetDeviceProcAddr next_of_device;
PFN_vkCreateDevice next_create_device;

struct Fault {
  char function[64] = "";
  int call = 0, result = 0, calls = 0;
  bool lost = false;
};
Fault& fault() {
  static Fault f = [] {
    Fault read;
    if (const char* text = std::getenv("MENISCAL_TEST_FAULT"))
      std::sscanf(text, "%63s %d %d", read.function, &read.call, &read.result);
    return read;
  }();
  return f;
}

VkResult failure(const char* function) {
  Fault& f = fault();
  if (f.lost) return VK_ERROR_DEVICE_LOST;
  if (std::strcmp(f.function, function) != 0 || ++f.calls != f.call) return VK_SUCCESS;
  f.lost = f.result == VK_ERROR_DEVICE_LOST;
  return static_cast<VkResult>(f.result);
}

#define FUNCTIONS(X)                                                                                      \
  X(vkAllocateMemory)                                                                                     \
  X(vkMapMemory)                                                                                          \
  X(vkCreateBuffer)                                                                                       \
  X(vkCreateBufferView) X(vkCreateComputePipelines) X(vkCreateDescriptorPool) X(vkAllocateDescriptorSets) \
      X(vkBeginCommandBuffer) X(vkQueueSubmit) X(vkWaitForFences)

// In the place of a function of the next layer.
template <class Function, int tag>
struct Intercepted;
template <class... Arguments, int tag>
struct Intercepted<VkResult(VKAPI_PTR*)(Arguments...), tag> {
  static inline VkResult(VKAPI_PTR* next)(Arguments...) = nullptr;
  static inline const char* name = "";
  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    const bool was_lost = fault().lost;
    const VkResult failed = failure(name);
    if (failed == VK_SUCCESS) return next(arguments...);
    // A lost device executes nothing: what is under way would else use memory that the program frees.
    if (!was_lost && std::strcmp(name, "vkWaitForFences") == 0) next(arguments...);
    return failed;
  }
};

template <int tag, class Function>
PFN_vkVoidFunction intercept(const char* name, PFN_vkVoidFunction next, Function) {
  using Mine = Intercepted<Function, tag>;
  Mine::next = reinterpret_cast<Function>(next);
  Mine::name = name;
  return reinterpret_cast<PFN_vkVoidFunction>(&Mine::call);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction next = next_of_device(device, name);
  if (!next) return nullptr;
#define INTERCEPT(function) \
  if (std::strcmp(name, #function) == 0) return intercept<__COUNTER__>(#function, next, PFN_##function());
  FUNCTIONS(INTERCEPT)
  return next;
}

// Of the chain that the loader hands down.
template <class Chained, class Info>
Chained* link_of(const Info* info, VkStructureType type) {
  auto* chained = static_cast<Chained*>(const_cast<void*>(info->pNext));
  while (chained && !(chained->sType == type && chained->function == VK_LAYER_LINK_INFO))
    chained = static_cast<Chained*>(const_cast<void*>(chained->pNext));
  return chained;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link = link_of<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult failed = failure("vkCreateDevice");
  return failed == VK_SUCCESS ? next_create_device(physical, info, allocator, device) : failed;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  next_of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(next_of_instance(nullptr, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result == VK_SUCCESS)
    next_create_device = reinterpret_cast<PFN_vkCreateDevice>(next_of_instance(*instance, "vkCreateDevice"));
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_instance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_device);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
  return next_of_instance ? next_of_instance(instance, name) : nullptr;
}

}  // namespace

EXPORTED VkResult vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
  interface->loaderLayerInterfaceVersion = 2;
  interface->pfnGetInstanceProcAddr = instance_function;
  interface->pfnGetDeviceProcAddr = device_function;
  interface->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
