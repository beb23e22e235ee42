// How finely a meniscus is divided: so that its facets, and the normals interpolated on them, stay within a tolerance.
#pragma once

#include "meniscus/contour.h"
#include "meniscus/meniscus.h"
#include "meniscus/profile.h"

namespace meniscus {

struct Error {
  double height = 0;  // between facets and the surface, perpendicular to it; metres
  double normal = 0;  // radians
};

// What a closed line so long, or an open one, may be off by: the liquid's tolerance. Round solids thinner than
// 0.7 capillary lengths more, in inverse proportion, up to 12 times: theirs is so much less of the light, spread as
// wide.
Error tolerance_for(const Liquid& liquid, double length, bool closed);

// On half the square of half a turn, the part of a radius by which an arc leaves its chord: what comes of it grows with
// the radius of the contact line, metres.
struct Bound {
  double inverse = 0, per_metre = 0;
  double at(double radius) const { return 1 / (inverse + per_metre * radius); }
};

// Distances between the layers of a line's band and turns between its columns. A chord leaves a curve by
// spacing^2 curvature / 8.
struct Fineness {
  Profile profile = Profile::sine;
  double steepness = 0;          // rise over sweep length
  double layer = kWidestLayer;   // widest distance between layers, sweep lengths
  double first = 0, growth = 0;  // of the exact profile's layers: at the wall, and per distance
  double layer_normal = 1;       // error of normals between layers, radians
  double turn = kColumnTurn;     // largest between columns, radians
  Bound height{}, normal{};      // on the turn where the contact line is wide
  Error tolerance{};
  Error error{};  // what is left, at most

  static constexpr double kWidestLayer = 1.0 / 66, kFinestLayer = 1.0 / 360;  // of the usual meniscus
  static constexpr double kWidestSolved = 0.35 / kFar;                        // of the exact one
  static constexpr double kColumnTurn = 0.0491;                               // 128 columns round a circle

  bool within_tolerance() const { return error.height <= tolerance.height && error.normal <= tolerance.normal; }
  // By how much layers are wider than usual.
  double coarseness() const { return layer / (profile == Profile::solved ? kWidestSolved : kWidestLayer); }
  // Distance between layers at d = distance / sweep length from the wall, in sweep lengths.
  double spacing(double d) const;
  // How many layers there are up to that distance, about.
  double layers(double d) const;
  // Largest turn between columns where the contact line has this radius, metres; 0 in a fan.
  double turn_at(double radius) const;
  Fineness coarser(double factor) const;
};

// For a meniscus that rises so high, metres, on a line of about this radius.
Fineness find_fineness(const Error& tolerance, Profile profile, double sweep_length, double rise, double radius);

// For the meniscus that a contour will get. `coarseness`: factor on the liquid's tolerance.
Fineness find_fineness(const Contour& contour, double contact_angle, const Liquid& liquid, double coarseness = 1);

}  // namespace meniscus
