// Sums of passes, and the picture made of them.
#pragma once

#include <set>

#include "host/image/layers.h"
#include "host/render/backend.h"
#include "host/render/pass_sums.h"

namespace meniscal {

// User's factors on what the maps contribute.
struct MapScale {
  double targeted = 1, caustic = 1, global = 1;
};

// Names of the layers that `Film` can make beside the beauty, in the order in which they are written.
const std::vector<std::string>& aov_names();

class Film {
 public:
  // `aovs`: of aov_names(). Nothing is kept for a layer that is not asked for.
  // `origin`: of the local coordinates, in those of the scene, which the layer `position` is in.
  Film(const Crop& crop, const std::vector<std::string>& aovs, const MapScale& scale,
       const glm::dvec3& origin = glm::dvec3(0));

  // The samples of one view of a pass; after its last, end_pass.
  void add(const Samples& samples, const View& view = {});
  void end_pass(std::uint32_t pass);
  std::uint32_t passes() const { return beauty_.passes(); }

  // Means over the passes: the beauty and the layers asked for. `variance` is that of the mean, per channel, from the
  // spread of the passes; 0 while there is but one.
  Image image(std::uint32_t full_width, std::uint32_t full_height) const;

  // Reads or writes all sums of whole passes, in double precision.
  template <class Archive>
  void exchange(Archive& archive) {
    archive(samples_);
    beauty_.exchange(archive);
    for (Sum& sum : aovs_) archive(sum.values);
  }

  double error_estimate() const { return beauty_.error_estimate(); }

 private:
  struct Sum {
    std::string name;
    std::vector<std::string> channels;
    std::vector<double> values;  // over all samples
  };
  void add_bounced(const Samples& samples);
  void add_highlights(const std::vector<glm::vec3>& highlights);

  Crop crop_;
  MapScale scale_;
  glm::dvec3 origin_;
  std::uint32_t samples_ = 0;            // a pixel's, of all passes; split paths once
  std::uint32_t pass_samples_ = 0;       // of the pass that is under way: a pixel's, split paths once
  std::vector<glm::dvec3> pass_;         // their sum
  std::vector<glm::dvec3> pass_weight_;  // and that of their radiances per irradiance, of main paths
  PassSums beauty_;
  std::vector<Sum> aovs_;
};

}  // namespace meniscal
