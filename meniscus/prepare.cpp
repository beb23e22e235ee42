#include "meniscus/prepare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace meniscus {
namespace {

// A facet that is there twice would make every contour twice.
void drop_repeated(Topology& mesh) {
  std::set<std::array<std::uint32_t, 3>> known;
  std::erase_if(mesh.triangles, [&](const Topology::Triangle& t) {
    std::array<std::uint32_t, 3> v{t.points.x, t.points.y, t.points.z};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return !known.insert(v).second;
  });
}

// A vertex normal far from its facet's is no surface's: Blender's smooth cylinder tilts those of its side by 45 degrees
// towards the caps, and with them the dihedral angle. Such ones become the mean of the neighbouring facets that do not
// turn away by a crease.
void straighten_normals(Topology& mesh) {
  const double crease = std::cos(glm::radians(35.0));
  std::vector<std::vector<std::uint32_t>> around(mesh.points.size());
  std::vector<glm::dvec3> facet;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::dvec3 n = mesh.area_normal(t);
    const double length = glm::length(n);
    facet.push_back(length > 0 ? n / length : mesh.triangles[t].normals[0]);
    for (int k = 0; k < 3; ++k) around[mesh.triangles[t].points[k]].push_back(t);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      glm::dvec3& normal = mesh.triangles[t].normals[k];
      if (glm::dot(normal, facet[t]) >= crease) continue;
      glm::dvec3 sum(0);
      for (const std::uint32_t u : around[mesh.triangles[t].points[k]])
        if (glm::dot(facet[u], facet[t]) >= crease) sum += mesh.area_normal(u);
      if (glm::length(sum) > 0) normal = glm::normalize(sum);
    }
}

}  // namespace

Topology weld_liquid(const Liquid& liquid, std::vector<std::uint32_t>& surface, Warnings& warnings) {
  if (!(liquid.capillary_length > 0) || !std::isfinite(liquid.capillary_length)) {
    throw std::invalid_argument("liquid '" + liquid.name + "': the capillary length must be positive and finite");
  }
  if (!(liquid.tolerance > 0) || !std::isfinite(liquid.tolerance)) {
    throw std::invalid_argument("liquid '" + liquid.name + "': the tolerance must be positive and finite");
  }
  if (!(liquid.sweep_scale > 0) || !std::isfinite(liquid.sweep_scale) || !std::isfinite(liquid.height_scale)) {
    throw std::invalid_argument("liquid '" + liquid.name +
                                "': the scale of the sweep must be positive, both scales finite");
  }
  Topology mesh = weld(liquid.mesh, liquid.name);
  surface = free_surface(mesh);
  if (surface.empty()) {
    for (Topology::Triangle& t : mesh.triangles) {
      t.turn();
      for (glm::dvec3& n : t.normals) n = -n;
    }
    surface = free_surface(mesh);
    if (surface.empty()) {
      throw std::invalid_argument("liquid '" + liquid.name +
                                  "' has no surface that faces up: +Y is up, check its orientation");
    }
    warnings.push_back({"liquid '" + liquid.name + "' faces down: taken as turned over"});
  }
  if (liquid.mesh.normals.empty()) {  // smooth ones for the free surface, weighted by area
    std::vector<glm::dvec3> sum(mesh.points.size(), glm::dvec3(0));
    for (const std::uint32_t t : surface) {
      for (int i = 0; i < 3; ++i) sum[mesh.triangles[t].points[i]] += mesh.area_normal(t);
    }
    for (const std::uint32_t t : surface) {
      for (int i = 0; i < 3; ++i) mesh.triangles[t].normals[i] = glm::normalize(sum[mesh.triangles[t].points[i]]);
    }
  }
  return mesh;
}

std::vector<Body> weld_solids(const std::vector<Solid>& solids, Warnings& warnings) {
  std::vector<Body> bodies;
  for (const Solid& solid : solids) {
    if (!(solid.contact_angle >= 0 && solid.contact_angle <= 3.1415926536)) {
      throw std::invalid_argument("solid '" + solid.name + "': the contact angle must lie between 0 and 180 degrees");
    }
    Topology mesh = weld(solid.mesh, solid.name);
    drop_repeated(mesh);
    if (const std::size_t turned = orient_alike(mesh)) {
      warnings.push_back({"solid '" + solid.name + "': " + std::to_string(turned) +
                              " triangles face the other way than their neighbours: taken as turned over",
                          {bodies.size()}});
    }
    orient_outward(mesh);
    straighten_normals(mesh);
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) boxes.push_back(mesh.box(t));
    bodies.push_back({solid.name, std::move(mesh), Tree(std::move(boxes)), solid.contact_angle});
  }
  return bodies;
}

}  // namespace meniscus
