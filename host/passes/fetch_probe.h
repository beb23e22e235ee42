// Whether texel or storage buffers are read faster: host side of shaders/fetch_probe.comp.
#pragma once

#include "host/gpu/choices.h"

namespace meniscal::passes {

struct FetchProbe {
  gpu::FetchSeconds seconds;
  std::vector<std::uint32_t> texel, storage;  // what was read: the same
};

// Takes some hundredths of a second. Throws Error(ExitCode::device) where the device fails.
FetchProbe probe_fetch(const gpu::Device& device);

// Sets the choices of a device whose reads are worth measuring: a GPU. On a CPU texel buffers are known to be faster.
void choose_by_measurement(gpu::Device& device);

}  // namespace meniscal::passes
