// The queue's plain business: submission, waiting, barriers, and copies that cannot wait.
#pragma once

#include "host/gpu/context.h"

namespace meniscal::gpu {

// A primary command buffer with its pool and fence.
struct CommandBuffer {
  Owned<VkCommandPool> pool;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  Owned<VkFence> fence;
};
CommandBuffer make_command_buffer(const std::shared_ptr<Context>& context, const std::string& name);

// Restarts the recording; what was recorded must have ended.
void begin_commands(const Context& context, const CommandBuffer& buffer);
// Ends the recording, submits it and waits. The host then sees what it wrote, and so does all that is submitted later.
void submit_commands(const Context& context, const CommandBuffer& buffer, const std::string& doing);

// What dispatches and transfers wrote before it is seen by dispatches and transfers after it, and by the host where
// asked.
void memory_barrier(const Context& context, VkCommandBuffer commands, bool with_host = false);

// Copies between buffers and waits.
void copy_now(const std::shared_ptr<Context>& context, VkBuffer source, size_t source_offset, VkBuffer target,
              size_t target_offset, size_t bytes, const std::string& doing);

}  // namespace meniscal::gpu
