// How finely menisci must be divided for what a picture shows of them.
#pragma once

#include <span>

#include "host/reference/tracer.h"
#include "host/render/settings.h"

namespace meniscal {

// Of one scene in one view. What is transparent is taken to be absent: sizes are wanted, and whether ways exist.
class Demand {
 public:
  // `settings`: the camera and the picture's whole size.
  Demand(const Scene& scene, const RenderSettings& settings);

  // `beside`: points in the liquid along the meniscus' contact line. Its tolerance differs from the usual one by a
  // factor within [0.25, 16]: so that its caustic is off by at most a quarter of the pixel where it falls, or by what
  // the lights' width hides, and it itself, where it is seen, by a tenth of a pixel. Where it may show the highlights
  // of a narrow light, whose brightness goes by how the normals change along a facet, it is no coarser than usual.
  // What no light reaches, or what shows nothing to the camera, is no target and 16 times coarser.
  meniscus::Need need(std::span<const glm::dvec3> beside, double capillary_length) const;

 private:
  std::vector<glm::dvec3> look() const;
  double footprint(const glm::dvec3& point) const;  // of a pixel, metres
  bool in_frame(const glm::dvec3& point) const;
  bool is_free(const glm::dvec3& from, const glm::dvec3& to) const;
  double coarsest(const glm::dvec3& point, double capillary_length) const;
  bool reaches_camera(const glm::dvec3& point) const;
  bool meets_light(const glm::dvec3& point, double choice) const;
  bool matters(std::span<const glm::dvec3> beside) const;

  const Scene& scene_;
  CameraAxes axes_;
  bool orthographic_;
  double per_pixel_;                 // metres, or per metre of distance
  double hidden_;                    // factor on the tolerance that the lights' width allows; 0: all are points
  bool mirrors_ = false;             // may show what is out of the frame
  World opaque_;                     // triangles alone
  std::vector<glm::dvec3> lamps_;    // a point of each emissive triangle
  std::vector<std::uint8_t> emits_;  // by material
  reference::Tracer tracer_;
  std::vector<glm::dvec3> view_;  // points that the camera sees, all over the picture
};

}  // namespace meniscal
