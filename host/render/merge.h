// One picture of several that rendered passes of their own: as if one run had rendered them all.
#pragma once

#include "host/render/header.h"

namespace meniscal {

class Merge {
 public:
  // `name` is for messages. Throws Error(ExitCode::scene) where the image does not say which passes it holds, holds
  // some that another does, or is of another scene or other settings.
  void add(const Image& image, const std::string& name);

  // Means over all passes; `variance` as the spread of all of them gives it. At least one image must have been added.
  Image result() const;

 private:
  struct Part {
    std::string name;
    PassRanges passes;
  };
  struct Sum {
    std::string layer;
    std::vector<double> values;  // passes times means; of `variance`, the sum of the passes' squared deviations
  };
  PassRanges require_own_passes(const Image& image, const std::string& name) const;
  void add_deviations(Sum& deviations, const Image& image, double passes) const;

  std::vector<Part> parts_;
  Image frame_;  // the first image, without pixels
  Identity identity_;
  PassRanges passes_;
  double seconds_ = 0;
  std::vector<Sum> sums_;
};

}  // namespace meniscal
