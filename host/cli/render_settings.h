// From what was asked for to what is rendered: every default is filled in here.
#pragma once

#include "host/cli/render_options.h"

namespace meniscal {

// Throws Error(ExitCode::usage) for a camera that the scene has not, or a crop beyond the image.
RenderSettings choose_settings(const RenderOptions& options, const Scene& scene, const World& world);

// Starts photons where the camera will see what they give: asks the backend, which was made with these settings, and
// has it render with the better ones.
void focus(RenderSettings& settings, const RenderOptions& options, const World& world, Backend& backend);

}  // namespace meniscal
