#include "host/gpu/buffer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "host/error.h"
#include "host/gpu/queue.h"

namespace meniscal::gpu {
namespace {

constexpr size_t texel_bytes = 16;
constexpr size_t staging_bytes = size_t{16} << 20;

std::optional<uint32_t> find_type(const Context& context, uint32_t allowed, VkMemoryPropertyFlags wanted,
                                  VkMemoryPropertyFlags unwanted = 0) {
  for (uint32_t i = 0; i < context.memory.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = context.memory.memoryTypes[i].propertyFlags;
    if ((allowed >> i & 1u) && (flags & wanted) == wanted && (flags & unwanted) == 0) return i;
  }
  return std::nullopt;
}

// The first that the device has. Device memory is mapped only where the host caches it (shared memory, lavapipe):
// reading a GPU's own memory over the bus, uncached, is slower than a copy by an order of magnitude.
std::optional<uint32_t> memory_type(const Context& context, uint32_t allowed, Memory memory) {
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
  constexpr VkMemoryPropertyFlags coherent = visible | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags cached = coherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  if (memory == Memory::host) {
    const auto type = find_type(context, allowed, cached);
    return type ? type : find_type(context, allowed, coherent);  // Vulkan guarantees the latter
  }
  if (memory == Memory::device) {
    if (const auto type = find_type(context, allowed, local | cached)) return type;
  }
  if (const auto type = find_type(context, allowed, local, visible)) return type;
  return find_type(context, allowed, local);
}

std::string mebibytes(size_t bytes) {
  return std::to_string(bytes >> 20) + " MiB (" + std::to_string(bytes) + " bytes)";
}

[[noreturn]] void too_large(const Context& context, const std::string& name, size_t bytes, const std::string& limit) {
  throw Error(ExitCode::device,
              "device '" + context.info.name + "': buffer '" + name + "' of " + mebibytes(bytes) + " exceeds " + limit +
                  "; try fewer photons per pass (--photons), a smaller picture (--resolution) or scene");
}

size_t bytes_of(Format format) { return format == Format::r32ui ? 4 : format == Format::rg32ui ? 8 : texel_bytes; }

size_t texels(size_t bytes) { return std::max((bytes + texel_bytes - 1) / texel_bytes, size_t{1}); }

// Memory that counts towards its heap and the device's total for as long as it lives; in the record, as `asked`.
Owned<VkDeviceMemory> allocate(const std::shared_ptr<Context>& context, size_t bytes, size_t asked, uint32_t type,
                               const std::string& name, const std::string& doing) {
  const uint32_t heap = context->memory.memoryTypes[type].heapIndex;
  const size_t size = context->memory.memoryHeaps[heap].size, used = context->heap_bytes[heap];
  if (bytes > size - std::min(size, used)) {
    too_large(*context, name, bytes,
              "what is left of a heap of " + mebibytes(size) + ", " + mebibytes(used) + " in use");
  }
  auto info = vk_structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = bytes;
  info.memoryTypeIndex = type;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  context->check(context->vk.vkAllocateMemory(context->device, &info, nullptr, &memory), doing);
  context->name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, name);
  context->account(heap, static_cast<ptrdiff_t>(bytes));
  context->record.change_buffer(name, static_cast<ptrdiff_t>(asked));
  return {memory, [context, heap, bytes, asked, name](VkDeviceMemory gone) {
            context->vk.vkFreeMemory(context->device, gone, nullptr);  // unmaps as well
            context->account(heap, -static_cast<ptrdiff_t>(bytes));
            context->record.change_buffer(name, -static_cast<ptrdiff_t>(asked));
          }};
}

}  // namespace

Buffer::Buffer(const Device& device, std::string name, size_t bytes, Memory memory)
    : Buffer(device.context(), std::move(name), bytes, memory) {}

Buffer::Buffer(std::shared_ptr<Context> context, std::string name, size_t bytes, Memory memory)
    : context_(std::move(context)), name_(std::move(name)), bytes_(bytes) {
  if (bytes > context_->limits.max_buffer)
    too_large(*context_, name_, bytes,
              "the largest that the device allocates, " + mebibytes(context_->limits.max_buffer));
  const auto& vk = context_->vk;
  const std::string doing = "making buffer '" + name_ + "' of " + mebibytes(bytes_);
  auto info = vk_structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = texels(bytes_) * texel_bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  context_->check(vk.vkCreateBuffer(context_->device, &info, nullptr, &buffer), doing);
  buffer_ = own(context_, buffer, name_, VK_OBJECT_TYPE_BUFFER, vk.vkDestroyBuffer);

  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(context_->device, buffer, &needs);
  const auto type = memory_type(*context_, needs.memoryTypeBits, memory);
  if (!type) context_->check(VK_ERROR_OUT_OF_DEVICE_MEMORY, doing);
  memory_ = allocate(context_, needs.size, bytes_, *type, name_, doing);
  context_->check(vk.vkBindBufferMemory(context_->device, buffer, memory_.get(), 0), doing);

  constexpr VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const auto flags = context_->memory.memoryTypes[*type].propertyFlags;
  const bool cheap = memory == Memory::host || (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  if ((flags & coherent) == coherent && cheap && memory != Memory::staged) {
    context_->check(vk.vkMapMemory(context_->device, memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped_), doing);
  }
}

VkBuffer Buffer::storage() const {
  if (bytes_ > context_->limits.max_storage_range)
    too_large(*context_, name_, bytes_,
              "the device's storage buffer range of " + mebibytes(context_->limits.max_storage_range));
  return buffer_.get();
}

VkBufferView Buffer::view(Format format) const {
  if (const auto made = views_.find(format); made != views_.end()) return made->second.get();
  const size_t bytes = texels(bytes_) * texel_bytes, count = bytes / bytes_of(format);
  if (count > context_->limits.max_texel_elements) {
    throw Error(ExitCode::device, "device '" + context_->info.name + "': buffer '" + name_ + "' has " +
                                      std::to_string(count) + " texels, a texel buffer at most " +
                                      std::to_string(context_->limits.max_texel_elements) +
                                      "; bind it as a storage buffer, or use another device or a smaller scene");
  }
  auto info = vk_structure<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = buffer_.get();
  info.format = format == Format::rgba32f    ? VK_FORMAT_R32G32B32A32_SFLOAT
                : format == Format::rgba32ui ? VK_FORMAT_R32G32B32A32_UINT
                : format == Format::rg32ui   ? VK_FORMAT_R32G32_UINT
                                             : VK_FORMAT_R32_UINT;
  info.range = bytes;
  VkBufferView view = VK_NULL_HANDLE;
  context_->check(context_->vk.vkCreateBufferView(context_->device, &info, nullptr, &view),
                  "making a texel view of buffer '" + name_ + "'");
  views_.emplace(format, own(context_, view, name_, VK_OBJECT_TYPE_BUFFER_VIEW, context_->vk.vkDestroyBufferView));
  return view;
}

void Buffer::check_range(size_t bytes, size_t offset) const {
  if (offset <= bytes_ && bytes <= bytes_ - offset) return;
  throw Error(ExitCode::failed, "buffer '" + name_ + "' holds " + std::to_string(bytes_) + " bytes; " +
                                    std::to_string(bytes) + " at offset " + std::to_string(offset) +
                                    " do not fit: an error in the program, please report it");
}

void Buffer::write(const void* source, size_t bytes, size_t offset) {
  check_range(bytes, offset);
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(static_cast<std::byte*>(mapped_) + offset, source, bytes);
    return;
  }
  const Buffer staging(context_, "staging", std::min(bytes, staging_bytes), Memory::host);
  for (size_t done = 0; done < bytes; done += staging_bytes) {
    const size_t part = std::min(staging_bytes, bytes - done);
    std::memcpy(staging.mapped_, static_cast<const std::byte*>(source) + done, part);
    copy_now(context_, staging.handle(), 0, handle(), offset + done, part, "filling buffer '" + name_ + "'");
  }
}

void Buffer::read(void* target, size_t bytes, size_t offset) const {
  check_range(bytes, offset);
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(target, static_cast<const std::byte*>(mapped_) + offset, bytes);
    return;
  }
  const Buffer staging(context_, "staging", std::min(bytes, staging_bytes), Memory::host);
  for (size_t done = 0; done < bytes; done += staging_bytes) {
    const size_t part = std::min(staging_bytes, bytes - done);
    copy_now(context_, handle(), offset + done, staging.handle(), 0, part, "reading buffer '" + name_ + "'");
    std::memcpy(static_cast<std::byte*>(target) + done, staging.mapped_, part);
  }
}

}  // namespace meniscal::gpu
