#include "host/gpu/instance.h"

#include <algorithm>
#include <cstring>

namespace meniscal::gpu {
namespace {

constexpr const char* khronos_layer = "VK_LAYER_KHRONOS_validation";

template <class Property>
bool contains(const std::vector<Property>& properties, const char* name) {
  return std::ranges::any_of(properties, [&](const Property& property) {
    if constexpr (requires { property.layerName; }) {
      return std::strcmp(property.layerName, name) == 0;
    } else {
      return std::strcmp(property.extensionName, name) == 0;
    }
  });
}

// Vulkan's two-call idiom: ask for the count, then for the values. Empty on failure.
template <class Value, class Enumerate>
std::vector<Value> enumerate(Enumerate enumerate_into) {
  uint32_t count = 0;
  if (enumerate_into(&count, nullptr) != VK_SUCCESS) return {};
  std::vector<Value> values(count);
  if (enumerate_into(&count, values.data()) < 0) return {};
  values.resize(count);
  return values;
}

std::vector<VkExtensionProperties> instance_extensions(const char* layer) {
  return enumerate<VkExtensionProperties>([&](uint32_t* count, VkExtensionProperties* values) {
    return vkEnumerateInstanceExtensionProperties(layer, count, values);
  });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& context = *static_cast<Context*>(user);
  const std::lock_guard lock(context.messages_mutex);
  context.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

// Reports by the layer alone: the loader's own ("general") complain about other drivers of the machine.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(Context& context) {
  auto info = vk_structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = collect;
  info.pUserData = &context;
  return info;
}

template <class Function>
Function instance_function(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

std::string type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

std::optional<uint32_t> compute_family(VkPhysicalDevice physical) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (uint32_t i = 0; i < count; ++i) {
    if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
  }
  return std::nullopt;
}

}  // namespace

bool open_instance(Context& context, bool validation) {
  if (volkInitialize() != VK_SUCCESS || volkGetInstanceVersion() < required_api) return false;

  const auto layers = enumerate<VkLayerProperties>(
      [](uint32_t* count, VkLayerProperties* values) { return vkEnumerateInstanceLayerProperties(count, values); });
  auto available = instance_extensions(nullptr);
  std::vector<const char*> layer_names, extensions;
  if (validation && contains(layers, khronos_layer)) {
    layer_names.push_back(khronos_layer);
    for (const auto& extension : instance_extensions(khronos_layer)) available.push_back(extension);
  }
  const auto wants = [&](const char* name) {
    const bool there = contains(available, name);
    if (there) extensions.push_back(name);
    return there;
  };
  const bool debug_utils = wants(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  const bool portability = wants(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
  const bool watching = !layer_names.empty() && debug_utils && wants(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);

  auto application = vk_structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "meniscal";
  application.apiVersion = required_api;

  auto messenger = messenger_info(context);
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  auto features = vk_structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  features.pNext = &messenger;  // so that creation and destruction of the instance are watched as well

  auto info = vk_structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pNext = watching ? &features : nullptr;
  info.flags = portability ? VkInstanceCreateFlags{VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR} : 0;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<uint32_t>(layer_names.size());
  info.ppEnabledLayerNames = layer_names.data();
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  if (vkCreateInstance(&info, nullptr, &context.instance) != VK_SUCCESS) {
    context.instance = VK_NULL_HANDLE;
    return false;
  }
  volkLoadInstanceOnly(context.instance);

  const VkInstance instance = context.instance;
  if (debug_utils) {
    context.set_object_name =
        instance_function<PFN_vkSetDebugUtilsObjectNameEXT>(instance, "vkSetDebugUtilsObjectNameEXT");
    context.begin_label = instance_function<PFN_vkCmdBeginDebugUtilsLabelEXT>(instance, "vkCmdBeginDebugUtilsLabelEXT");
    context.end_label = instance_function<PFN_vkCmdEndDebugUtilsLabelEXT>(instance, "vkCmdEndDebugUtilsLabelEXT");
  }
  if (watching) {
    context.destroy_messenger =
        instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT");
    const auto create =
        instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT");
    context.validation = create(instance, &messenger, nullptr, &context.messenger) == VK_SUCCESS;
  }
  return true;
}

std::vector<Candidate> find_candidates(VkInstance instance) {
  const auto all = enumerate<VkPhysicalDevice>(
      [&](uint32_t* count, VkPhysicalDevice* values) { return vkEnumeratePhysicalDevices(instance, count, values); });
  std::vector<Candidate> candidates;
  for (const VkPhysicalDevice physical : all) {
    VkPhysicalDeviceProperties basic;
    vkGetPhysicalDeviceProperties(physical, &basic);
    const auto family = compute_family(physical);
    if (basic.apiVersion < required_api || !family) continue;

    auto driver = vk_structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(physical, &properties);
    std::string driver_text = driver.driverName;
    if (driver.driverInfo[0] != '\0') driver_text += std::string(" ") + driver.driverInfo;
    candidates.push_back({physical, *family,
                          DeviceInfo{static_cast<int>(candidates.size()), basic.deviceName, type_name(basic.deviceType),
                                     driver_text, basic.apiVersion}});
  }
  return candidates;
}

}  // namespace meniscal::gpu
