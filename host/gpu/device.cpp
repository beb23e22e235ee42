#include "host/gpu/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

#include "host/error.h"
#include "host/gpu/instance.h"

namespace meniscal::gpu {
namespace {

constexpr uint32_t required_storage_buffers = 8;  // of one pass; Vulkan guarantees 4, every driver known has 8 or more

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

int preference(const DeviceInfo& info) {
  const char* const order[] = {"discrete", "integrated", "virtual", "cpu"};
  return static_cast<int>(std::ranges::find(order, info.type) - std::begin(order));
}

std::string describe(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const auto& [physical, family, info] : candidates) {
    text += (text.empty() ? "" : ", ") + std::to_string(info.index) + " '" + info.name + "' (" + info.type + ")";
  }
  return text;
}

const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& selector) {
  if (candidates.empty()) {
    throw Error(ExitCode::device, "no Vulkan 1.2 device found for --device '" + selector +
                                      "': install a driver (Debian: mesa-vulkan-drivers runs on any CPU) or use "
                                      "`--device cpu`, the reference path");
  }
  std::vector<const Candidate*> matches;
  int index = -1;
  const char* const end = selector.data() + selector.size();
  const bool is_index = std::from_chars(selector.data(), end, index).ptr == end && !selector.empty();
  for (const Candidate& candidate : candidates) {
    const bool match =
        selector == "auto" ||
        (is_index ? candidate.info.index == index
                  : !selector.empty() && lower(candidate.info.name).find(lower(selector)) != std::string::npos);
    if (match) matches.push_back(&candidate);
  }
  if (matches.empty()) {
    throw Error(ExitCode::device,
                "no Vulkan device matches --device '" + selector + "': there is " + describe(candidates) +
                    "; give its index or a part of its name, `auto`, or `cpu` for the reference path");
  }
  return **std::ranges::min_element(matches, {}, [](const Candidate* match) { return preference(match->info); });
}

bool has_extension(VkPhysicalDevice physical, const char* name) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::ranges::any_of(extensions, [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

void read_limits(Context& context) {
  auto allocation =
      vk_structure<VkPhysicalDeviceMaintenance3Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
  auto subgroup =
      vk_structure<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
  allocation.pNext = &subgroup;
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &allocation, {}};
  vkGetPhysicalDeviceProperties2(context.physical, &properties);
  vkGetPhysicalDeviceMemoryProperties(context.physical, &context.memory);
  uint32_t count = context.queue_family + 1;
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(context.physical, &count, families.data());
  context.timestamp_bits = families[context.queue_family].timestampValidBits;

  const VkPhysicalDeviceLimits& given = properties.properties.limits;
  Limits& limits = context.limits;
  limits.max_buffer = allocation.maxMemoryAllocationSize;
  limits.max_storage_range = std::min<size_t>(given.maxStorageBufferRange, limits.max_buffer);
  limits.max_storage_buffers = given.maxPerStageDescriptorStorageBuffers;
  limits.max_texel_buffers = given.maxPerStageDescriptorSampledImages;
  limits.max_texel_elements = given.maxTexelBufferElements;
  limits.max_workgroup_size = std::min(given.maxComputeWorkGroupSize[0], given.maxComputeWorkGroupInvocations);
  limits.subgroup_size = subgroup.subgroupSize;
  limits.max_shared_memory = given.maxComputeSharedMemorySize;
  limits.max_push_bytes = given.maxPushConstantsSize;
  limits.timestamps = context.timestamp_bits > 0;
  limits.timestamp_period = 1e-9 * static_cast<double>(given.timestampPeriod);
  limits.heap = 0;
  for (uint32_t i = 0; i < context.memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = context.memory.memoryHeaps[i];
    if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) limits.heap = std::max<size_t>(limits.heap, heap.size);
  }
  if (limits.max_storage_buffers < required_storage_buffers) {
    throw Error(ExitCode::device, "device '" + context.info.name + "' allows " +
                                      std::to_string(limits.max_storage_buffers) + " storage buffers in a shader, " +
                                      std::to_string(required_storage_buffers) +
                                      " are needed; choose another device or `--device cpu`");
  }
}

void create_device(Context& context) {
  auto supported =
      vk_structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  VkPhysicalDeviceFeatures2 query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &supported, {}};
  vkGetPhysicalDeviceFeatures2(context.physical, &query);
  auto features = vk_structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  features.scalarBlockLayout = supported.scalarBlockLayout;
  context.limits.scalar_block_layout = supported.scalarBlockLayout == VK_TRUE;

  // A device that is not fully Vulkan (MoltenVK) demands that one knows.
  const char* const portability_subset = "VK_KHR_portability_subset";
  const bool portable = has_extension(context.physical, portability_subset);

  const float priority = 1;
  auto queue = vk_structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = context.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = vk_structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = portable ? 1 : 0;
  info.ppEnabledExtensionNames = &portability_subset;
  context.check(vkCreateDevice(context.physical, &info, nullptr, &context.device), "opening it");
  volkLoadDeviceTable(&context.vk, context.device);
  context.vk.vkGetDeviceQueue(context.device, context.queue_family, 0, &context.queue);
  context.name(VK_OBJECT_TYPE_QUEUE, context.queue, "compute queue");
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
  Context context;
  std::vector<DeviceInfo> devices;
  if (!open_instance(context, false)) return devices;
  for (const Candidate& candidate : find_candidates(context.instance)) devices.push_back(candidate.info);
  return devices;
}

Device Device::open(const std::string& selector, bool validation) {
  auto context = std::make_shared<Context>();
  std::vector<Candidate> candidates;
  if (open_instance(*context, validation)) candidates = find_candidates(context->instance);
  const Candidate& chosen = choose(candidates, selector);
  context->physical = chosen.physical;
  context->queue_family = chosen.queue_family;
  context->info = chosen.info;
  read_limits(*context);
  create_device(*context);
  context->choices = choose(context->info, context->limits);
  return Device(std::move(context));
}

Device::Device(std::shared_ptr<Context> context) : context_(std::move(context)) {}

const DeviceInfo& Device::info() const { return context_->info; }
const Limits& Device::limits() const { return context_->limits; }
const Choices& Device::choices() const { return context_->choices; }
void Device::set_choices(const Choices& choices) { context_->choices = choices; }
bool Device::has_validation() const { return context_->validation; }
const std::vector<std::string>& Device::validation_messages() const { return context_->messages; }
size_t Device::bytes_now() const { return context_->bytes_now; }
size_t Device::bytes_peak() const { return context_->bytes_peak; }
const Record& Device::record() const { return context_->record; }

}  // namespace meniscal::gpu
