#include "host/gpu/queue.h"

namespace meniscal::gpu {

CommandBuffer make_command_buffer(const std::shared_ptr<Context>& context, const std::string& name) {
  const auto& vk = context->vk;
  const std::string doing = "making commands '" + name + "'";
  CommandBuffer made;
  auto pool_info = vk_structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.queueFamilyIndex = context->queue_family;
  VkCommandPool pool = VK_NULL_HANDLE;
  context->check(vk.vkCreateCommandPool(context->device, &pool_info, nullptr, &pool), doing);
  made.pool = own(context, pool, name, VK_OBJECT_TYPE_COMMAND_POOL, vk.vkDestroyCommandPool);

  auto info = vk_structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  context->check(vk.vkAllocateCommandBuffers(context->device, &info, &made.commands), doing);
  context->name(VK_OBJECT_TYPE_COMMAND_BUFFER, made.commands, name);

  const auto fence_info = vk_structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  VkFence fence = VK_NULL_HANDLE;
  context->check(vk.vkCreateFence(context->device, &fence_info, nullptr, &fence), doing);
  made.fence = own(context, fence, name, VK_OBJECT_TYPE_FENCE, vk.vkDestroyFence);
  return made;
}

void begin_commands(const Context& context, const CommandBuffer& buffer) {
  const std::string doing = "starting to record commands";
  context.check(context.vk.vkResetCommandPool(context.device, buffer.pool.get(), 0), doing);
  auto info = vk_structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  context.check(context.vk.vkBeginCommandBuffer(buffer.commands, &info), doing);
}

void submit_commands(const Context& context, const CommandBuffer& buffer, const std::string& doing) {
  const auto& vk = context.vk;
  memory_barrier(context, buffer.commands, true);
  context.check(vk.vkEndCommandBuffer(buffer.commands), doing);
  auto info = vk_structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &buffer.commands;
  const VkFence fence = buffer.fence.get();
  context.check(vk.vkQueueSubmit(context.queue, 1, &info, fence), doing);
  context.check(vk.vkWaitForFences(context.device, 1, &fence, VK_TRUE, UINT64_MAX), doing);
  context.check(vk.vkResetFences(context.device, 1, &fence), doing);
}

void memory_barrier(const Context& context, VkCommandBuffer commands, bool with_host) {
  constexpr VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  constexpr VkAccessFlags writes = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  constexpr VkAccessFlags reads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
  auto barrier = vk_structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = writes;
  barrier.dstAccessMask = reads | writes;
  VkPipelineStageFlags after = work;
  if (with_host) {
    barrier.dstAccessMask |= VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT;
    after |= VK_PIPELINE_STAGE_HOST_BIT;
  }
  context.vk.vkCmdPipelineBarrier(commands, work, after, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void copy_now(const std::shared_ptr<Context>& context, VkBuffer source, size_t source_offset, VkBuffer target,
              size_t target_offset, size_t bytes, const std::string& doing) {
  const CommandBuffer buffer = make_command_buffer(context, doing);
  begin_commands(*context, buffer);
  const VkBufferCopy region{source_offset, target_offset, bytes};
  context->vk.vkCmdCopyBuffer(buffer.commands, source, target, 1, &region);
  submit_commands(*context, buffer, doing);
}

}  // namespace meniscal::gpu
