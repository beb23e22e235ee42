// The device that was asked for, ready to render passes.
#pragma once

#include <memory>

#include "host/cli/render_options.h"

namespace meniscal {

// Opens the device and looks ahead: `settings`, those of choose_settings, have then the better starts. `world` must
// outlive the backend. Throws Error(ExitCode::device), or Error(ExitCode::usage) for an integrator that the device has
// not.
std::unique_ptr<Backend> start_backend(const RenderOptions& options, const World& world, RenderSettings& settings,
                                       Stages& stages);

}  // namespace meniscal
