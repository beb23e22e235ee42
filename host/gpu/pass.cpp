#include "host/gpu/pass.h"

#include <algorithm>
#include <numeric>

#include "host/error.h"
#include "host/gpu/constants.h"
#include "host/gpu/context.h"

namespace meniscal::gpu {
namespace {

VkDescriptorType descriptor_type(Kind kind) {
  return kind == Kind::storage ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

uint32_t count(const std::vector<Binding>& bindings, Kind kind) {
  return static_cast<uint32_t>(std::ranges::count(bindings, kind, &Binding::kind));
}

[[noreturn]] void misuse(const std::string& pass, const std::string& reason) {
  throw Error(ExitCode::failed, "pass '" + pass + "': " + reason + ": an error in the program, please report it");
}

void check_limits(const Context& context, const std::string& pass, const std::vector<Binding>& bindings,
                  size_t push_bytes) {
  const auto require = [&](const char* what, size_t needed, size_t allowed) {
    if (needed <= allowed) return;
    throw Error(ExitCode::device, "device '" + context.info.name + "': pass '" + pass + "' needs " +
                                      std::to_string(needed) + " " + what + ", the device allows " +
                                      std::to_string(allowed) +
                                      "; use another device or `--device cpu`, the reference path");
  };
  require("storage buffers", count(bindings, Kind::storage), context.limits.max_storage_buffers);
  require("texel buffers", count(bindings, Kind::texel), context.limits.max_texel_buffers);
  require("bytes of push constants", push_bytes, context.limits.max_push_bytes);
}

}  // namespace

ComputePass::ComputePass(const Device& device, std::string name, std::span<const uint32_t> spirv,
                         std::vector<Binding> bindings, size_t push_bytes, std::vector<uint32_t> constants)
    : context_(device.context()), name_(std::move(name)), bindings_(std::move(bindings)), push_bytes_(push_bytes) {
  check_limits(*context_, name_, bindings_, push_bytes_);
  const auto& vk = context_->vk;
  const VkDevice vk_device = context_->device;
  const std::string doing = "making pass '" + name_ + "'";

  std::vector<VkDescriptorSetLayoutBinding> slots;
  for (const Binding& binding : bindings_) {
    slots.push_back({binding.binding, descriptor_type(binding.kind), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  auto set_info = vk_structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = static_cast<uint32_t>(slots.size());
  set_info.pBindings = slots.data();
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  context_->check(vk.vkCreateDescriptorSetLayout(vk_device, &set_info, nullptr, &set_layout), doing);
  set_layout_ = own(context_, set_layout, name_, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, vk.vkDestroyDescriptorSetLayout);

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<uint32_t>(push_bytes_)};
  auto layout_info = vk_structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout;
  layout_info.pushConstantRangeCount = push_bytes_ > 0 ? 1 : 0;
  layout_info.pPushConstantRanges = &push;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  context_->check(vk.vkCreatePipelineLayout(vk_device, &layout_info, nullptr, &layout), doing);
  layout_ = own(context_, layout, name_, VK_OBJECT_TYPE_PIPELINE_LAYOUT, vk.vkDestroyPipelineLayout);

  auto module_info = vk_structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  context_->check(vk.vkCreateShaderModule(vk_device, &module_info, nullptr, &module), doing);
  const auto owned_module = own(context_, module, name_, VK_OBJECT_TYPE_SHADER_MODULE, vk.vkDestroyShaderModule);

  std::vector<VkSpecializationMapEntry> entries;
  for (uint32_t id = 0; id < constants.size(); ++id) entries.push_back({id, id * 4, 4});
  const VkSpecializationInfo specialization{static_cast<uint32_t>(entries.size()), entries.data(),
                                            constants.size() * sizeof(uint32_t), constants.data()};
  auto info = vk_structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = vk_structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  context_->check(vk.vkCreateComputePipelines(vk_device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), doing);
  pipeline_ = own(context_, pipeline, name_, VK_OBJECT_TYPE_PIPELINE, vk.vkDestroyPipeline);
  recorded_ = context_->record.add_pass(name_, named_constants(spirv, constants));
}

BindingSet ComputePass::bind(const std::vector<Bound>& buffers) const {
  for (const Binding& binding : bindings_) {
    const auto given = std::ranges::count(buffers, binding.binding, &Bound::binding);
    if (given != 1)
      misuse(name_, "binding " + std::to_string(binding.binding) + " given " + std::to_string(given) + " times");
  }
  if (buffers.size() != bindings_.size()) misuse(name_, "given a buffer for a binding that it does not have");

  const auto& vk = context_->vk;
  const std::string doing = "binding buffers to pass '" + name_ + "'";
  std::vector<VkDescriptorPoolSize> sizes;
  for (const Kind kind : {Kind::storage, Kind::texel}) {
    if (const uint32_t n = count(bindings_, kind)) sizes.push_back({descriptor_type(kind), n});
  }
  auto pool_info = vk_structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  pool_info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  context_->check(vk.vkCreateDescriptorPool(context_->device, &pool_info, nullptr, &pool), doing);
  auto owned_pool = own(context_, pool, name_, VK_OBJECT_TYPE_DESCRIPTOR_POOL, vk.vkDestroyDescriptorPool);

  const VkDescriptorSetLayout set_layout = set_layout_.get();
  auto set_info = vk_structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  set_info.descriptorPool = pool;
  set_info.descriptorSetCount = 1;
  set_info.pSetLayouts = &set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  context_->check(vk.vkAllocateDescriptorSets(context_->device, &set_info, &set), doing);
  context_->name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set, name_);

  for (const Bound& bound : buffers) {
    const Kind kind = std::ranges::find(bindings_, bound.binding, &Binding::binding)->kind;
    const VkBuffer buffer = kind == Kind::texel ? bound.buffer.handle() : bound.buffer.storage();
    const VkDescriptorBufferInfo range{buffer, 0, VK_WHOLE_SIZE};
    const VkBufferView view = kind == Kind::texel ? bound.buffer.view(bound.format) : VK_NULL_HANDLE;
    auto write = vk_structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.dstBinding = bound.binding;
    write.descriptorCount = 1;
    write.descriptorType = descriptor_type(kind);
    write.pBufferInfo = &range;
    write.pTexelBufferView = &view;
    vk.vkUpdateDescriptorSets(context_->device, 1, &write, 0, nullptr);
  }
  return BindingSet(std::move(owned_pool), set);
}

}  // namespace meniscal::gpu
