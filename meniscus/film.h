// One connected part of the liquid's surface, moved to rest by Newton's method.
#pragma once

#include <Eigen/SparseCore>
#include <map>

#include "meniscus/rail.h"
#include "meniscus/raise.h"
#include "meniscus/tension.h"

namespace meniscus {

constexpr std::uint32_t kNoVertex = 0xffffffff;

class LinearSystem;

// What all films of a sheet share.
struct FilmContext {
  const Sheet& sheet;
  const Raised& raised;
  const std::vector<ContactLine>& lines;
  const std::vector<Body>& bodies;
  double capillary_length;                             // metres
  std::vector<std::vector<std::uint32_t>> contact_at;  // the sheet's vertex at each line's node
  std::vector<std::vector<double>> angles;             // the contact angle there
  std::vector<std::uint32_t> local;                    // scratch: per vertex of the sheet kNoVertex
};

// Does the vertex belong to a meniscus that is solved for? Where the lines of two solids cross it stays.
bool moves(const Sheet::Vertex& vertex, const std::vector<ContactLine>& lines);

// Unknowns: for each vertex how far it goes along its own normal, for each contact vertex how far it slides on its
// rail. What lies between a contact line and the end of its meniscus is carried along as the line slides, the less the
// farther away. Equations: the forces on each vertex cancel along its normal; on a contact vertex, along its rail, the
// solid's pull cos(contact angle) too. Heights count from the level liquid below, so that a wavy one keeps its waves.
class Film {
 public:
  // Of these triangles of the sheet, at the positions to which they are raised or level.
  enum class Start { raised, level };
  Film(FilmContext& context, const std::vector<std::uint32_t>& triangles, Start start);

  struct Outcome {
    bool converged = false;
    int steps = 0;
    double last_step = 0;  // metres: the last full Newton step
  };

  Outcome solve();
  // Asks for contact angles that are a part, from 0 to 1, of the way from those at which the level liquid is at rest to
  // the solids' own; how far they are off these at most, radians.
  void ask(double part);
  double off() const;
  // Has its contact line shrunk to next to nothing, at a solid's tip? Forces cancel there whatever the angle.
  bool vanished() const;

  struct Point {
    std::uint32_t vertex;  // of the sheet
    Lifted at;             // position and normal above a level liquid at height 0
  };
  struct Shape {
    std::vector<Point> points;  // of the vertices that move
    double sagitta = 0;         // how far the facets leave the surface, at most; metres
  };
  Shape shape() const;
  std::size_t unknowns() const { return unknowns_; }
  // Contact vertices pinned at an edge or an end of their solid, as vertices of the sheet.
  std::vector<std::uint32_t> pinned() const;

 private:
  struct Follow {
    std::uint32_t contact;
    glm::dvec3 weight;  // by component
  };
  struct Vertex {
    std::uint32_t in_sheet;
    glm::dvec3 x, way{0};
    // Horizontal unit normals of the liquid's own border on either side of a vertex there, in whose planes it stays.
    std::vector<glm::dvec3> fences{};
    std::uint32_t unknown = kNoVertex, contact = kNoVertex;
    std::vector<Follow> follows{};
  };
  struct ContactVertex {
    std::uint32_t vertex, unknown;
    const Node* node;
    std::size_t line;
    const Body* body;
    std::uint32_t before = kNoVertex, next = kNoVertex;  // contacts
    Rail rail{};
    double angle, wanted;  // contact angle: the one asked for, the solid's
    double curvature = 0;  // of the contact line, away from the solid; 1/m, positive round a post
    double slide = 0;
    int held = 0;  // at an end of its rail: -1 low, 1 high
    bool pinned() const { return held > 0 ? rail.ends_high : held < 0 && rail.ends_low; }
  };

  struct FirstFacet {
    double force = 0, by_weight = 0;  // on the contact vertex, along its rail; its change with the facet's weight
    glm::dvec3 by_normal{0};          // with the facet's normal
    double by_slide = 0;              // and as the rail turns
  };

  struct State {
    std::vector<glm::dvec3> x;
    std::vector<ContactVertex> contacts;
  };
  struct Equations {
    Eigen::VectorXd force;  // on each unknown
    std::vector<Eigen::Triplet<double>> entries;
  };

  struct Round {                      // with the same rails
    double moved = 0, last_step = 0;  // metres: in all; the last whole step
    int steps = 0;
    bool settled = false;  // was it as good as none?
    bool railed = false;   // did it end where the rails are no longer known?
    bool goes_on(double capillary_length) const { return !settled && !railed && moved < 0.5 * capillary_length; }
  };

  void link(const FilmContext& context);
  void fence(const FilmContext& context);
  static glm::dvec3 within(const std::vector<glm::dvec3>& fences, const glm::dvec3& way);
  std::vector<glm::dvec3> facet_normals() const;
  std::map<std::size_t, glm::dvec3> find_axes() const;
  double curvature_at(const ContactVertex& c) const;
  void rebase(double rail_length);
  FirstFacet first_facet(const ContactVertex& c, const FacetForces& f, const glm::dvec3 p[3], int i,
                         const glm::uvec3& t) const;
  Equations equations() const;
  void add_wetting(Equations& result) const;
  std::vector<bool> hold(Eigen::VectorXd& force);
  bool go_on(LinearSystem& system, Round& round);
  State save() const;
  void restore(const State& state);
  double railed(const Eigen::VectorXd& step) const;
  bool advance(const Eigen::VectorXd& step, const State& before);
  std::vector<glm::dvec3> normals() const;

  double length_;
  std::uint32_t unknowns_ = 0;
  std::vector<std::uint32_t> blocks_;  // of the unknowns: by run of a contact line's nodes
  std::vector<Vertex> vertices_;
  std::vector<ContactVertex> contacts_;
  std::vector<glm::uvec3> triangles_;
  std::vector<glm::dvec3> shares_;  // of the triangles' corners in their weight
};

}  // namespace meniscus
