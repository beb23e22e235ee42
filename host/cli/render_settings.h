// From what was asked for to what is rendered: every default is filled in here.
#pragma once

#include "host/cli/render_options.h"

namespace meniscal {

// The camera of that name; the first without one. Throws Error(ExitCode::usage) that names those there are.
const Camera& find_camera(const Scene& scene, const std::optional<std::string>& name);

// Pixels of a picture so wide, as high as the camera's aspect wants.
Resolution size_of(const Camera& camera, int width);

// The scene with menisci as fine as its view needs them. Throws Error(ExitCode::usage) as choose_settings does.
World build_world(const RenderOptions& options, const Scene& scene);

// Rays a pixel and pass that look for lights in menisci: sparks of narrow ones ask for more.
std::uint32_t highlight_samples_of(const RenderOptions& options, const Scene& scene);

// Throws Error(ExitCode::usage) for a camera that the scene has not, or a crop beyond the image.
RenderSettings choose_settings(const RenderOptions& options, const Scene& scene, const World& world);

// Starts photons where the camera will see what they give: asks the backend, which was made with these settings, and
// has it render with the better ones. False: there was nothing to look for.
bool focus(RenderSettings& settings, const RenderOptions& options, const World& world, Backend& backend);

}  // namespace meniscal
