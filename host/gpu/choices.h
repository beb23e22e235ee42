// What the renderer does in one way or another, depending on the device: all in one place. None of it changes the
// picture.
#pragma once

#include "host/gpu/device.h"

namespace meniscal::gpu {

struct Choices {
  // Invocations of a workgroup, in every shader: a multiple of all subgroup sizes known, and half of the 128 that
  // Vulkan guarantees.
  static constexpr uint32_t workgroup = 64;

  // Tables of up to so many elements of 16 bytes are read through texel buffers, larger ones through storage buffers;
  // 0: storage buffers always.
  size_t texel_elements;
  // Long work is cut into dispatches that are to take so many seconds each, starting with first_batch invocations;
  // none has more than largest_batch.
  double batch_seconds;
  uint32_t first_batch, largest_batch;

  bool reads_texels(size_t elements) const { return elements <= texel_elements; }
};

// Seconds that the same reads took through texel and through storage buffers.
struct FetchSeconds {
  double texel, storage;
};

// From what the driver says, and costs nothing.
Choices choose(const DeviceInfo& info, const Limits& limits);
// From a measurement as well: texel buffers, unless storage buffers are faster by more than such a measurement errs.
Choices choose(const DeviceInfo& info, const Limits& limits, const FetchSeconds& measured);

}  // namespace meniscal::gpu
