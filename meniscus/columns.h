// A contour refined to the nodes from which the meniscus is swept: one column of the band starts at each (paper,
// section 3.1).
#pragma once

#include <optional>
#include <vector>

#include "meniscus/contour.h"
#include "meniscus/meniscus.h"
#include "meniscus/tolerance.h"

namespace meniscus {

// What the band knows at one side of a node. At a joint the two sides differ.
struct Side {
  glm::dvec3 solid_normal;  // unit
  glm::dvec2 direction;     // contour normal N_c in the plane: unit, away from the solid
  double curvature = 0;     // of the contour's normals along it, 1/m; positive round a post
  double rise = 0;          // of the contact line, along the liquid's normal; metres
  glm::dvec2 slide{0};      // of the contact line, in the plane, so that it lies on the solid; metres
  double reach = 0;         // distance over which the slide passes over into `toward`, metres
  glm::dvec2 toward{0};     // what is left of the slide there and beyond; metres
  double rise_slope = 0;    // their derivatives along the contour
  glm::dvec2 slide_slope{0};
  double reach_slope = 0;
  glm::dvec2 toward_slope{0};
};

struct Node {
  glm::dvec3 position;
  glm::dvec3 liquid_normal;
  Side before, after;  // on the way that ends and the way that starts here
  Side contact;        // of the contact vertex itself: between the two
  bool joint = false;
  double free = 1e300;         // distance at which another foot becomes nearer, metres
  double room = 1;             // part of its height for which the band has room
  std::optional<Edge> border;  // as in ContourPoint
  double curvature = 0;        // of the contour within about a capillary length, 1/m; see curvature.h
};

struct ContactLine {
  std::size_t solid;
  bool closed;
  double sweep = 0;  // how far the meniscus reaches, metres; 0 where none is raised
  std::vector<Node> nodes;
  Profile profile = Profile::sine;
  Fineness fineness{};
  bool at_rest = false;  // solved for
  Need need{};

  std::size_t segments() const { return closed ? nodes.size() : nodes.size() - 1; }
  const Node& next(std::size_t i) const { return nodes[(i + 1) % nodes.size()]; }
};

// Calls visit(node, way) for the nodes that come after `start`, or before it, with their distance from it along the
// line in metres, until it returns false or the line ends; on a closed one `start` comes last.
template <class Visit>
void walk(const ContactLine& line, std::size_t start, bool forward, Visit visit) {
  const std::size_t n = line.nodes.size();
  double way = 0;
  for (std::size_t at = start, k = 1; k <= n; ++k) {
    if (!line.closed && (forward ? at + 1 == n : at == 0)) return;
    const std::size_t next = forward ? (at + 1) % n : (at + n - 1) % n;
    way += glm::distance(line.nodes[at].position, line.nodes[next].position);
    if (!visit(at = next, way)) return;
  }
}

constexpr double kFineColumn = 0.05;  // distance between columns where something changes along them, in sweep lengths
constexpr double kAspect = 19;        // and elsewhere, in distances between layers

struct Size {
  double along;  // the line, from its first node; metres
  double size;   // wanted distance between nodes there; metres
};

// How finely a contour is divided; see sizing.h.
struct Resolution {
  std::vector<Size> sizes;  // from the line's first node on; empty: kFineColumn throughout, times the coarseness
  Fineness fineness{};
};

// Merges points closer than a small part of the sweep length, averages normals that differ by less than three degrees,
// keeps joints and corners, and puts new points on the segments between them: as many as the turn of the normals and
// the resolution ask for. Nodes lie on the solid's facets; only chords between them may leave the facets.
ContactLine refine(const Contour& contour, std::size_t solid, double sweep_length, const Resolution& resolution = {});

// Curvature and slopes from the directions, rises and slides of neighbouring nodes. To be called when those are known.
void differentiate(ContactLine& line);

}  // namespace meniscus
