// Memory that passes read and write.
#pragma once

#include <cstring>
#include <map>
#include <ranges>
#include <span>
#include <type_traits>

#include "host/gpu/device.h"
#include "host/gpu/owned.h"
#include "host/gpu/vulkan.h"

namespace meniscal::gpu {

enum class Memory {
  device,  // fastest for shaders; the host reaches it directly where that is cheap, else through staging
  host,    // mapped, for what the host reads or writes often
  staged   // as device, never mapped: so that staging can be tested where all memory is shared
};

// How a texel view (samplerBuffer, usamplerBuffer) reads 16 bytes, or 8, or 4.
enum class Format { rgba32f, rgba32ui, rg32ui, r32ui };

// Storage buffer, transfer source and target, and texel buffer in one. Move-only. Contents undefined until written.
class Buffer {
 public:
  // bytes may be 0: the buffer is then small and valid. Throws Error(ExitCode::device), naming sizes, where bytes
  // exceed Limits::max_buffer or memory runs out.
  Buffer(const Device& device, std::string name, size_t bytes, Memory memory = Memory::device);

  const std::string& name() const { return name_; }
  size_t bytes() const { return bytes_; }  // as asked for

  // Writes a vector, span or array at a byte offset. It must fit, else Error(ExitCode::failed).
  template <std::ranges::contiguous_range R>
  void upload(const R& values, size_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<std::ranges::range_value_t<R>>);
    write(std::ranges::data(values), std::ranges::size(values) * sizeof(std::ranges::range_value_t<R>), offset);
  }

  // Reads elements [first, first + count); by default as many as lie whole in the buffer. Error(ExitCode::failed) past
  // the end.
  template <class T>
  std::vector<T> download(size_t first, size_t count) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read(values.data(), count * sizeof(T), first * sizeof(T));
    return values;
  }
  template <class T>
  std::vector<T> download() const {
    return download<T>(0, bytes_ / sizeof(T));
  }

  // For pass.cpp and commands.cpp.
  VkBuffer handle() const { return buffer_.get(); }
  VkBuffer storage() const;  // to bind as a storage buffer; Error(ExitCode::device) over max_storage_range
  VkBufferView view(Format format) const;  // made at the first call; Error(ExitCode::device) over max_texel_elements

 private:
  Buffer(std::shared_ptr<Context> context, std::string name, size_t bytes, Memory memory);
  void write(const void* source, size_t bytes, size_t offset);
  void read(void* target, size_t bytes, size_t offset) const;
  void check_range(size_t bytes, size_t offset) const;

  std::shared_ptr<Context> context_;
  std::string name_;
  size_t bytes_;
  Owned<VkDeviceMemory> memory_;  // before what is bound to it: destroyed after
  Owned<VkBuffer> buffer_;
  mutable std::map<Format, Owned<VkBufferView>> views_;
  void* mapped_ = nullptr;
};

}  // namespace meniscal::gpu
