// Owner of one Vulkan object: destroys it once, at the end of its life. Move-only.
#pragma once

#include <functional>
#include <utility>

namespace meniscal::gpu {

template <class Handle>
class Owned {
 public:
  Owned() = default;
  Owned(Handle handle, std::function<void(Handle)> destroy) : handle_(handle), destroy_(std::move(destroy)) {}
  ~Owned() {
    if (handle_) destroy_(handle_);
  }
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, {})), destroy_(std::move(other.destroy_)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }
  Handle get() const { return handle_; }

 private:
  Handle handle_{};
  std::function<void(Handle)> destroy_;  // keeps the device alive as long as the object
};

}  // namespace meniscal::gpu
