// From radiance of any unit to the 8-bit sRGB of a preview.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/image/layers.h"

namespace meniscal {

enum class ToneMap {
  ward,    // contrast-based scale factor, the paper's operator; visibility as on the scene itself
  aces,    // filmic curve after automatic exposure
  linear,  // white is the 99th percentile, or 1 where an exposure is given
};

// Ward, "A contrast-based scalefactor for luminance display", Graphics Gems IV (1994), pp. 415-421: the factor from
// scene luminance (cd/m2) to display value (1: white) that keeps just visible contrasts just visible. `adaptation`:
// luminance the eye is adapted to, cd/m2, >= 0; `display_maximum`: Ldmax, cd/m2, > 0.
double ward_scale(double adaptation, double display_maximum = 100);

// Narkowicz' fit to the ACES reference tone curve ("ACES Filmic Tone Mapping Curve", 2016): scene-linear x >= 0 to [0,
// 1].
double aces_curve(double x);

// Log-average of the finite Rec. 709 luminances of interleaved R, G, B that are above 1e-4 of their mean; 0 where there
// is none.
double log_average_luminance(const std::vector<float>& rgb);

// The sRGB transfer function (IEC 61966-2-1), linear [0, 1] to encoded [0, 1].
double srgb_encode(double linear);

// Interleaved linear R, G, B to interleaved 8-bit sRGB. `exposure` in EV multiplies the display value by 2^EV, after
// the operator's own scale. Values that are negative or not a number become 0, infinite ones white.
std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, ToneMap operation, std::optional<double> exposure);

// The same with the scale that `like` gets: pictures to compare must not differ by how bright they are shown.
std::vector<std::uint8_t> tone_map_like(const std::vector<float>& like, const std::vector<float>& rgb,
                                        ToneMap operation, std::optional<double> exposure);

}  // namespace meniscal
