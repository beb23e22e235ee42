// The sheet raised to its menisci, and lowered again where it would fold.
#pragma once

#include "meniscus/lift.h"
#include "meniscus/meniscus.h"
#include "meniscus/remesh.h"
#include "meniscus/warning.h"

namespace meniscus {

// How much of something is concerned, for messages.
struct Share {
  std::size_t part = 0, whole = 0;
  void add(std::size_t p, std::size_t w) { part += p, whole += w; }
  std::string percent() const { return std::to_string((100 * part + whole - 1) / whole) + " %"; }
};

struct Raised {
  std::vector<bool> used;          // per vertex of the sheet: is it a corner of a triangle outside the solids?
  std::vector<Base> base;          // where it is on the level liquid, if it is a corner of any
  std::vector<Lifted> at;          // and where it is raised to, if used; else the same
  std::vector<glm::dvec3> across;  // the normal there from the side of the vertex's other foot, on a crease
};

// Raises the sheet's vertices. Where neighbouring contact lines slide towards each other, or a line round a bend, so
// that triangles would turn over or be squeezed, the lines are bonded anew at smaller heights there, with a warning:
// down to the level, at which the sheet is what the triangulation made.
Raised raise(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch, const Sheet& sheet,
             std::vector<ContactLine>& lines, const std::vector<Body>& bodies, const Liquid& parameters,
             Warnings& warnings);

}  // namespace meniscus
