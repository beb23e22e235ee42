// What the EXR header says of a render: enough to repeat it, to merge it, and to place it in a compositor.
#pragma once

#include "host/image/layers.h"
#include "host/render/film.h"
#include "host/render/pass_ranges.h"

namespace meniscal {

// The scene and all settings that passes depend on.
// `meniscus_tolerance`: factor on that of the scene's menisci.
void describe_settings(Image& image, const Scene& scene, const RenderSettings& settings, MeniscusModel model,
                       double meniscus_tolerance, const MapScale& scale);

// The passes that the image is the mean of, and what they took. The latter, and 0 where nothing is said of it, back.
void describe_passes(Image& image, const PassRanges& passes, double render_seconds);
std::optional<PassRanges> passes_of(const Image& image);
double render_seconds_of(const Image& image);

// All that images of one scene and with one set of settings have in common: windows, layers, and the header but for
// describe_passes; by name, as text that tells apart whatever differs.
using Identity = std::map<std::string, std::string>;
Identity identity_of(const Image& image);

// "seed is 1 instead of 2, ..." for all that differs.
std::string differences(const Identity& identity, const Identity& other);

}  // namespace meniscal
