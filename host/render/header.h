// What the EXR header says of a render: enough to repeat it, to merge it, and to place it in a compositor.
#pragma once

#include "host/image/layers.h"
#include "host/render/statistics.h"

namespace meniscal {

void describe(Image& image, const Scene& scene, const RenderSettings& settings, MeniscusModel model,
              const RunStatistics& run, double render_seconds);

}  // namespace meniscal
