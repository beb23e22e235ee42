// Pictures of the page, as PNG in data URIs.
#pragma once

#include "host/tradeoff/errors.h"

namespace meniscal {

// A scale of colours from black through red to pale yellow, brighter with every step: values in [0, 1] to 8-bit sRGB.
std::vector<std::uint8_t> false_colours(const std::vector<float>& values);

// What the error maps span: logarithmically from the least to 1, where the luminance is off by the reference's RMS.
constexpr double least_shown_error = 1e-3;
std::vector<float> error_map(const Image& image, const Image& reference);

// Everything but the caustic darkened.
std::vector<std::uint8_t> caustic_alone(const Reference& reference);

// "data:image/png;base64,..."
std::string data_uri(const std::vector<std::uint8_t>& srgb, int width, int height);

}  // namespace meniscal
