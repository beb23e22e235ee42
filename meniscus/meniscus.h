// Liquid-solid interfaces: finds where solids pierce a liquid and raises the menisci there.
// Source: Bourque, Dufort, Laprade, Poulin, "Simulating Caustics due to Liquid-Solid Interface Menisci", section 3.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/mesh.h"

namespace meniscus {

// Where the contact line stands: how the printed alpha of the paper's equation (2) is read, or by physics; see `rise`
// in profile.h.
enum class HeightRule {
  wetting,    // alpha = pi - phi0, phi0 = dihedral angle - contact angle: right sign for every solid
  equation2,  // alpha = contact angle, as printed: always rises
  exact,      // Young-Laplace at a flat or cylindrical wall as curved as the contour is there
};

// How the meniscus falls off with the distance from the contact line (paper, figure 12); see `falloff` in profile.h.
enum class Profile {
  sine,         // equation (2)
  exponential,  // as from a flat wall, for small slopes
  circular,     // a quarter of a circle, stretched to height and sweep length: vertical at the wall
  bessel,       // as round a post one capillary length in radius, for small slopes
  solved,       // the liquid at rest: Young-Laplace's equation for all menisci together; see equilibrium.h
};

// What a picture needs of one meniscus.
struct Need {
  double coarseness = 1;  // factor on the liquid's tolerance
  bool target = true;     // photons start on it
};

struct Liquid {
  std::string name;
  TriangleMesh mesh;        // an open sheet or a closed volume; its free surface is what faces up (+Y)
  double capillary_length;  // sqrt(surface tension / (density * gravity)), metres
  HeightRule height_rule = HeightRule::wetting;  // the exact profile has its own heights
  Profile profile = Profile::sine;
  double height_scale = 1;  // artist's factor on the height
  double sweep_scale = 1;   // artist's factor on the sweep length, 2 capillary lengths
  double tolerance = 1;     // factor on how far facets may leave the surface: see below
  // Of a contour, by points in the liquid a hundredth of a capillary length beside it; not given: all of it.
  std::function<Need(std::span<const glm::dvec3> beside)> need{};
  bool flatten = false;  // menisci stay on the level liquid and have the raised surface's normals alone
};

// How far the facets of a meniscus, and the normals interpolated on them, may leave the surface at a tolerance of 1.
constexpr double kHeightTolerance = 3.5e-4;  // capillary lengths: 1 um on water
constexpr double kNormalTolerance = 0.036;   // degrees

struct Solid {
  std::string name;
  TriangleMesh mesh;
  double contact_angle;  // radians, through the liquid, for the liquid it is built with
};

// One liquid-solid contour and the meniscus raised on it.
struct Contact {
  std::string solid;
  bool closed;                // false where the contour ends at the liquid's border
  double length;              // of the contour, metres
  double contact_angle;       // radians
  double rise_min, rise_max;  // signed height of the contact line above the level liquid, metres
  std::size_t triangles = 0;  // of its meniscus
  bool at_rest = false;       // is the meniscus Young-Laplace's?
  Need need{};
  std::vector<std::string> warnings = {};  // the surface's that concern the solid
};

// How the exact profile was found.
struct Solution {
  // Menisci that touch each other make one part; it failed if it does not rest at its contact angles.
  std::size_t parts = 0, failed = 0;
  std::size_t unknowns = 0, steps = 0;  // of all parts; Newton steps
  double last_step = 0;                 // the largest of the parts' last full steps, metres
  double height_error = 0;              // how far facets leave the surface, at most; metres

  void add(const Solution& other) {
    parts += other.parts, failed += other.failed, unknowns += other.unknowns, steps += other.steps;
    last_step = std::max(last_step, other.last_step), height_error = std::max(height_error, other.height_error);
  }
};

// The liquid with its menisci: one oriented surface, watertight but for the borders the liquid came with.
struct Surface {
  TriangleMesh mesh;                   // always with normals: analytic on the menisci, the liquid's own elsewhere
  std::vector<std::uint8_t> meniscus;  // per triangle: 1 on a meniscus that photons are to start on
  TriangleMesh within;                 // the free surface where it goes on inside solids, up to the contact lines
  std::vector<Contact> contacts;
  Solution solution;                  // all 0 unless the profile is exact
  std::vector<std::string> warnings;  // each names solid or liquid and says what was done
};

// Cuts the liquid where the solids pierce it, drops what lies inside them, raises a meniscus round every contour and
// stitches it to what remains of the liquid. Untouched triangles of the liquid stay bit for bit as they are.
// Deterministic. Throws std::invalid_argument, naming the object, where the input is not a usable mesh, or where the
// capillary length is out of all proportion to it.
Surface build(const Liquid& liquid, const std::vector<Solid>& solids);

}  // namespace meniscus
