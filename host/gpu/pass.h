// A compute shader ready to run, and the buffers it runs on.
#pragma once

#include <span>

#include "host/gpu/buffer.h"

namespace meniscal::gpu {

enum class Kind { storage, texel };

struct Binding {
  uint32_t binding;  // of descriptor set 0
  Kind kind;
};

struct Bound {
  uint32_t binding;
  const Buffer& buffer;
  Format format = Format::rgba32f;  // of a texel binding; ignored elsewhere
};

// The buffers of one ComputePass. Move-only; the buffers must live as long as dispatches with it run.
class BindingSet {
 public:
  VkDescriptorSet handle() const { return set_; }

 private:
  friend class ComputePass;
  BindingSet(Owned<VkDescriptorPool> pool, VkDescriptorSet set) : pool_(std::move(pool)), set_(set) {}
  Owned<VkDescriptorPool> pool_;  // owns the set
  VkDescriptorSet set_;
};

// Pipeline and layout. Move-only.
class ComputePass {
 public:
  // constants: specialisation constants of ids 0, 1, ...: uint and bool as they are, floats as bits (std::bit_cast).
  // push_bytes: a multiple of 4, at most Limits::max_push_bytes. Entry point `main`.
  ComputePass(const Device& device, std::string name, std::span<const uint32_t> spirv, std::vector<Binding> bindings,
              size_t push_bytes = 0, std::vector<uint32_t> constants = {});

  // Every binding exactly once, else Error(ExitCode::failed) naming the pass and the binding.
  BindingSet bind(const std::vector<Bound>& buffers) const;

  const std::string& name() const { return name_; }
  size_t recorded() const { return recorded_; }  // place in Record::passes
  size_t push_bytes() const { return push_bytes_; }
  VkPipeline pipeline() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }

 private:
  std::shared_ptr<Context> context_;
  std::string name_;
  std::vector<Binding> bindings_;
  size_t push_bytes_;
  size_t recorded_ = 0;
  Owned<VkDescriptorSetLayout> set_layout_;
  Owned<VkPipelineLayout> layout_;
  Owned<VkPipeline> pipeline_;
};

}  // namespace meniscal::gpu
