// How far a picture is from the converged one.
#pragma once

#include <array>
#include <optional>

#include "host/image/flip.h"
#include "host/image/layers.h"
#include "host/image/tonemap.h"

namespace meniscal {

struct Errors {
  double image = 0;    // relative RMSE per pixel: rmse / rms of the reference
  double caustic = 0;  // the same over the caustic alone; NaN where there is none
  double flip = 0;     // mean FLIP of the tone-mapped pictures
};

// In which the trade is measured.
struct Measure {
  const char* name;
  const char* column;  // in the CSV
  double Errors::*value;
};
inline constexpr std::array<Measure, 3> measures = {{{"relative RMSE per pixel", "relative_rmse", &Errors::image},
                                                     {"relative RMSE on the caustic", "caustic_rmse", &Errors::caustic},
                                                     {"FLIP", "flip", &Errors::flip}}};

// The caustic is where the maps of targeted and caustic photons bring more than this part of the brightest pixel.
constexpr double caustic_part = 0.05;

class Reference {
 public:
  // `image`: with the layers targeted and caustic.
  Reference(Image image, ToneMap operation, std::optional<double> exposure);

  const Image& image() const { return image_; }
  const std::vector<bool>& caustic() const { return caustic_; }  // by pixel
  std::size_t caustic_pixels() const;
  const std::vector<std::uint8_t>& srgb() const { return srgb_; }

  // As the reference is shown: by the same factor.
  std::vector<std::uint8_t> show(const Image& image) const;
  Flip flip_of(const Image& image) const;
  Errors errors_of(const Image& image) const;

 private:
  Image image_;
  ToneMap operation_;
  std::optional<double> exposure_;
  std::vector<bool> caustic_;
  std::vector<std::uint8_t> srgb_;
};

}  // namespace meniscal
