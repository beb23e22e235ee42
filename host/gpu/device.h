// A Vulkan device with one compute queue. Everything of Vulkan stays in this folder: users see devices, buffers,
// passes, commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace meniscal::gpu {

struct Context;  // Vulkan's handles: context.h, for this folder alone
struct Choices;  // choices.h
struct Record;   // record.h

struct DeviceInfo {
  int index;             // what `--device INDEX` names; the order the drivers report
  std::string name;      // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string type;      // discrete | integrated | virtual | cpu | other
  std::string driver;    // driver's name and version
  uint32_t api_version;  // as VK_MAKE_API_VERSION packs it
};

// What the renderer cares for; sizes in bytes unless said otherwise.
struct Limits {
  size_t max_buffer;             // of any buffer
  size_t max_storage_range;      // of one read or written as a storage buffer
  uint32_t max_storage_buffers;  // of one pass
  uint32_t max_texel_buffers;
  size_t max_texel_elements;    // texels of one texel buffer; Vulkan guarantees no more than 65,536
  uint32_t max_workgroup_size;  // invocations of a workgroup of shape (n, 1, 1)
  uint32_t subgroup_size;       // invocations that run in lockstep
  size_t max_shared_memory;     // of one workgroup
  size_t max_push_bytes;        // 128 is guaranteed
  size_t heap;                  // largest device-local memory heap
  bool scalar_block_layout;     // GL_EXT_scalar_block_layout may be used
  bool timestamps;              // the queue can time dispatches
  double timestamp_period;      // seconds a tick
};

// The devices that could render, with Vulkan 1.2 and a compute queue; empty where there is no loader or no driver.
std::vector<DeviceInfo> list_devices();

// Movable handle; buffers, passes and commands share the device and may outlive it.
class Device {
 public:
  // selector: "auto" (discrete, then integrated, virtual, cpu), an index, or part of a name in either case.
  // validation: load the Khronos layer with synchronisation validation where it is installed; see has_validation().
  // Throws Error(ExitCode::device) that lists the devices there are and says what to install or try.
  static Device open(const std::string& selector, bool validation = false);

  const DeviceInfo& info() const;
  const Limits& limits() const;
  // How the renderer works on this device; by default choose(info(), limits()). To be set before passes are made.
  const Choices& choices() const;
  void set_choices(const Choices& choices);
  bool has_validation() const;
  // Text of every warning and error so far, from the layer and the loader.
  const std::vector<std::string>& validation_messages() const;
  size_t bytes_now() const;  // allocated through Buffer at this moment, staging included
  size_t bytes_peak() const;
  const Record& record() const;  // of all that it was made to do

  const std::shared_ptr<Context>& context() const { return context_; }

 private:
  explicit Device(std::shared_ptr<Context> context);
  std::shared_ptr<Context> context_;
};

}  // namespace meniscal::gpu
