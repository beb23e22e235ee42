#include "host/gpu/commands.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "host/error.h"

namespace meniscal::gpu {
namespace {

constexpr uint32_t dispatches_per_pool = 256;

// The passes of a submission, for messages: each once.
std::string names(const std::vector<std::string>& dispatched) {
  std::string text;
  for (const auto& name : std::set(dispatched.begin(), dispatched.end())) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "copies" : text;
}

[[noreturn]] void misuse(const std::string& reason) {
  throw Error(ExitCode::failed, reason + ": an error in the program, please report it");
}

}  // namespace

Commands::Commands(const Device& device)
    : context_(device.context()), buffer_(make_command_buffer(context_, "commands")) {}

void Commands::begin() {
  if (recording_) return;
  begin_commands(*context_, buffer_);
  dispatched_.clear();
  recording_ = true;
}

void Commands::dispatch(const ComputePass& pass, const BindingSet& buffers, const void* push, size_t push_bytes,
                        uint32_t groups, const std::string& stage) {
  if (push_bytes != pass.push_bytes()) {
    misuse("pass '" + pass.name() + "' takes " + std::to_string(pass.push_bytes()) + " bytes of push constants, not " +
           std::to_string(push_bytes));
  }
  if (groups == 0) return;
  begin();
  const auto& vk = context_->vk;
  const VkCommandBuffer commands = buffer_.commands;
  if (context_->begin_label) {
    auto label = vk_structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = pass.name().c_str();
    context_->begin_label(commands, &label);
  }
  start_timing();
  const VkDescriptorSet set = buffers.handle();
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline());
  vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout(), 0, 1, &set, 0, nullptr);
  if (push_bytes > 0) {
    vk.vkCmdPushConstants(commands, pass.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<uint32_t>(push_bytes),
                          push);
  }
  const uint32_t rows = (groups - 1) / max_groups_x + 1;
  vk.vkCmdDispatch(commands, (groups - 1) / rows + 1, rows, 1);
  stop_timing();
  dispatched_.push_back(stage.empty() ? pass.name() : stage);
  ++context_->record.passes[pass.recorded()].dispatches[dispatched_.back()];
  if (context_->end_label) context_->end_label(commands);
}

void Commands::fill(Buffer& target, uint32_t value) {
  begin();
  context_->vk.vkCmdFillBuffer(buffer_.commands, target.handle(), 0, VK_WHOLE_SIZE, value);
}

void Commands::copy(const Buffer& source, Buffer& target, size_t bytes, size_t source_offset, size_t target_offset) {
  const auto fits = [&](const Buffer& buffer, size_t offset) {
    return offset <= buffer.bytes() && bytes <= buffer.bytes() - offset;
  };
  if (!fits(source, source_offset) || !fits(target, target_offset)) {
    misuse("copy of " + std::to_string(bytes) + " bytes from '" + source.name() + "' to '" + target.name() +
           "' passes an end");
  }
  if (bytes == 0) return;
  begin();
  const VkBufferCopy region{source_offset, target_offset, bytes};
  context_->vk.vkCmdCopyBuffer(buffer_.commands, source.handle(), target.handle(), 1, &region);
}

const Choices& Commands::choices() const { return context_->choices; }

void Commands::barrier() {
  begin();
  memory_barrier(*context_, buffer_.commands);
}

void Commands::submit_and_wait() {
  if (!recording_) return;
  recording_ = false;  // also when submitting throws: what was recorded is not tried again
  const auto start = std::chrono::steady_clock::now();
  submit_commands(*context_, buffer_, "running " + names(dispatched_));
  last_submit_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  add_timings();
}

// Two timestamps a dispatch: query 2 i before and 2 i + 1 after dispatch i of this recording.
void Commands::start_timing() {
  if (!context_->limits.timestamps) return;
  const size_t index = dispatched_.size(), pool_index = index / dispatches_per_pool;
  if (pool_index == queries_.size()) {
    auto info = vk_structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2 * dispatches_per_pool;
    VkQueryPool pool = VK_NULL_HANDLE;
    context_->check(context_->vk.vkCreateQueryPool(context_->device, &info, nullptr, &pool), "making timestamps");
    queries_.push_back(own(context_, pool, "timestamps", VK_OBJECT_TYPE_QUERY_POOL, context_->vk.vkDestroyQueryPool));
  }
  const VkQueryPool pool = queries_[pool_index].get();
  const auto query = static_cast<uint32_t>(2 * (index % dispatches_per_pool));
  if (query == 0) context_->vk.vkCmdResetQueryPool(buffer_.commands, pool, 0, 2 * dispatches_per_pool);
  context_->vk.vkCmdWriteTimestamp(buffer_.commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool, query);
}

void Commands::stop_timing() {
  if (!context_->limits.timestamps) return;
  const size_t index = dispatched_.size();
  context_->vk.vkCmdWriteTimestamp(buffer_.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                                   queries_[index / dispatches_per_pool].get(),
                                   static_cast<uint32_t>(2 * (index % dispatches_per_pool) + 1));
}

void Commands::add_timings() {
  if (dispatched_.empty()) return;
  if (!context_->limits.timestamps) {
    const bool one = std::ranges::all_of(dispatched_, [&](const auto& name) { return name == dispatched_.front(); });
    seconds_by_stage_[one ? dispatched_.front() : "mixed"] += last_submit_seconds_;
    return;
  }
  const uint64_t mask = context_->timestamp_bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << context_->timestamp_bits) - 1;
  for (size_t first = 0; first < dispatched_.size(); first += dispatches_per_pool) {
    const size_t n = std::min<size_t>(dispatches_per_pool, dispatched_.size() - first);
    std::vector<uint64_t> ticks(2 * n);
    context_->check(context_->vk.vkGetQueryPoolResults(context_->device, queries_[first / dispatches_per_pool].get(), 0,
                                                       static_cast<uint32_t>(ticks.size()),
                                                       ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                                                       VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                    "reading timestamps");
    for (size_t i = 0; i < n; ++i) {
      const uint64_t elapsed = (ticks[2 * i + 1] - ticks[2 * i]) & mask;  // the counter may have wrapped around
      seconds_by_stage_[dispatched_[first + i]] += static_cast<double>(elapsed) * context_->limits.timestamp_period;
    }
  }
}

}  // namespace meniscal::gpu
