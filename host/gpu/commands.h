// Work for the queue: recorded, submitted, waited for, timed.
#pragma once

#include "host/gpu/pass.h"
#include "host/gpu/queue.h"

namespace meniscal::gpu {

// Dispatches use at most this many workgroups along x, the most that Vulkan guarantees.
inline constexpr uint32_t max_groups_x = 65535;

// Recording starts with the first call after construction or submit_and_wait(). Move-only, reusable.
class Commands {
 public:
  explicit Commands(const Device& device);

  // Runs at least `groups` workgroups. Over 65,535 they spread over y as well, so shaders compute a linear workgroup
  // index
  //   gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x
  // and guard it against their item count: up to one row of workgroups is surplus. groups == 0 records nothing.
  // push_bytes must equal the pass's; else Error(ExitCode::failed). Times and errors go by `stage`, or the pass's name.
  void dispatch(const ComputePass& pass, const BindingSet& buffers, const void* push, size_t push_bytes,
                uint32_t groups, const std::string& stage = {});
  template <class Push>
  void dispatch(const ComputePass& pass, const BindingSet& buffers, const Push& push, uint32_t groups,
                const std::string& stage = {}) {
    static_assert(std::is_trivially_copyable_v<Push> && !std::is_pointer_v<Push>);
    dispatch(pass, buffers, &push, sizeof(Push), groups, stage);
  }
  void dispatch(const ComputePass& pass, const BindingSet& buffers, uint32_t groups) {
    dispatch(pass, buffers, nullptr, 0, groups);
  }

  void fill(Buffer& target, uint32_t value);  // every 4 bytes of the whole buffer
  // Bytes, offsets: multiples of 4 inside both buffers.
  void copy(const Buffer& source, Buffer& target, size_t bytes, size_t source_offset = 0, size_t target_offset = 0);
  // What dispatches, fills and copies before it wrote is seen by those after it. Not implied between calls.
  void barrier();

  // Runs what was recorded; results are then visible to the host. Throws Error(ExitCode::device) where the device is
  // lost or out of memory, naming the passes submitted.
  void submit_and_wait();

  const Choices& choices() const;  // of the device

  // Wall time of the last submission, from submit to the end of the wait: what the next one's size is chosen by.
  double last_submit_seconds() const { return last_submit_seconds_; }
  // Seconds on the device, summed since construction by stage; dispatches that overlap (no barrier) count in each.
  // Without Limits::timestamps: wall time, under the stage's name where a submission held one alone, else under
  // "mixed".
  const std::map<std::string, double>& seconds_by_stage() const { return seconds_by_stage_; }

 private:
  void begin();  // unless begun
  void start_timing();
  void stop_timing();
  void add_timings();

  std::shared_ptr<Context> context_;
  CommandBuffer buffer_;
  bool recording_ = false;
  std::vector<Owned<VkQueryPool>> queries_;  // grown to hold two timestamps a dispatch
  std::vector<std::string> dispatched_;      // stage of each dispatch of this recording
  double last_submit_seconds_ = 0;
  std::map<std::string, double> seconds_by_stage_;
};

}  // namespace meniscal::gpu
