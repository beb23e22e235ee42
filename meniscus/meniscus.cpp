#include "meniscus/meniscus.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "meniscus/bond.h"
#include "meniscus/check.h"
#include "meniscus/curvature.h"
#include "meniscus/equilibrium.h"
#include "meniscus/neighbours.h"
#include "meniscus/predicates.h"
#include "meniscus/prepare.h"
#include "meniscus/profile.h"
#include "meniscus/share.h"
#include "meniscus/sizing.h"
#include "meniscus/snap.h"
#include "meniscus/stitch.h"

namespace meniscus {
namespace {

TriangleMesh liquid_as_it_is(const Topology& liquid) {
  TriangleMesh mesh;
  for (const Topology::Triangle& t : liquid.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 3; ++i) {
      mesh.positions.push_back(liquid.points[t.points[i]]);
      mesh.normals.push_back(t.normals[i]);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

Need need_of(const Contour& contour, const Liquid& liquid) {
  if (!liquid.need) return {};
  std::vector<glm::dvec3> beside;
  for (const ContourPoint& p : contour.points) beside.push_back(p.position + 0.01 * liquid.capillary_length * p.before);
  return liquid.need(beside);
}

Contact describe(const ContactLine& line, const Body& body) {
  Contact contact{body.name, line.closed, 0, body.contact_angle, 0, 0};
  contact.at_rest = line.at_rest, contact.need = line.need;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    contact.length += glm::distance(line.nodes[i].position, line.next(i).position);
  }
  if (line.sweep == 0) return contact;  // lowered to the level, its nodes may still say from where
  contact.rise_min = contact.rise_max = line.nodes.front().contact.rise;
  for (const Node& node : line.nodes) {
    contact.rise_min = std::min(contact.rise_min, node.contact.rise);
    contact.rise_max = std::max(contact.rise_max, node.contact.rise);
  }
  return contact;
}

// What is known of the whole surface, told of each contact.
void share_out(Surface& surface, const std::vector<std::size_t>& line, const std::vector<ContactLine>& lines,
               const Warnings& warnings) {
  for (std::size_t t = 0; t < line.size(); ++t)
    if (surface.meniscus[t]) {
      Contact& contact = surface.contacts[line[t]];
      ++contact.triangles;
      surface.meniscus[t] = contact.need.target;
    }
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (const Warning& w : warnings)
      if (std::find(w.solids.begin(), w.solids.end(), lines[l].solid) != w.solids.end())
        surface.contacts[l].warnings.push_back(w.text);
}

bool faces_up(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    const auto& p = mesh.positions;
    return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).y > 0;
  });
}

// Says what is not as it must be; a picture is still possible.
void check(const Liquid& liquid, const Stitched& result, const std::vector<ContactLine>& lines,
           const std::vector<Body>& bodies, Warnings& warnings) {
  const Seams seams = find_seams(result.mesh);
  std::size_t gaps = 0;
  for (const auto& [a, b] : seams.boundary) {
    if (result.may_end[a] && result.may_end[b]) continue;
    // A closed liquid's walls may end within the solid that holds it, where the free surface was taken away.
    const glm::dvec3 middle = 0.5 * (result.mesh.positions[a] + result.mesh.positions[b]);
    gaps += std::none_of(bodies.begin(), bodies.end(),
                         [&](const Body& body) { return winding_number(body.mesh, middle) > 0.5; });
  }
  const std::size_t rejected = seams.sound ? 0 : inspect(result.mesh).rejected;
  const std::size_t rejected_before = rejected > 0 ? inspect(liquid.mesh).rejected : 0;
  if (rejected > rejected_before) {
    warnings.push_back({"liquid '" + liquid.name + "': " + std::to_string(rejected - rejected_before) +
                        " triangles make its surface non-manifold"});
  }
  if (gaps > 0)
    warnings.push_back({"liquid '" + liquid.name + "': " + std::to_string(gaps) + " edges of its surface lie open"});
  std::map<std::size_t, std::size_t> folded;  // triangles, by solid
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
    if (!result.meniscus[t] || liquid.profile == Profile::solved) continue;  // which may overhang
    const glm::uvec3& v = result.mesh.triangles[t];
    const auto& p = result.mesh.positions;
    if (orient2d(planar(p[v.x]), planar(p[v.y]), planar(p[v.z])) <= 0) ++folded[lines[result.line[t]].solid];
  }
  for (const auto& [solid, count] : folded) {
    warnings.push_back({"solid '" + bodies[solid].name + "': " + std::to_string(count) +
                            " triangles of its meniscus overhang or fold over",
                        {solid}});
  }
}

// A contour of millions of menisci's widths takes all time and memory, and is one of units or of a slip in the liquid.
void refuse_endless(const Contour& contour, const std::string& name, double reach) {
  constexpr double kMost = 1e6;
  double length = 0;
  const std::vector<ContourPoint>& points = contour.points;
  for (std::size_t i = contour.closed ? 0 : 1; i < points.size(); ++i)
    length += glm::distance(points[(i + points.size() - 1) % points.size()].position, points[i].position);
  if (length <= kMost * reach) return;
  std::ostringstream message;
  message << "solid '" << name << "': its contour of " << length
          << " m is over a million times as long as its meniscus is "
          << "wide, " << reach
          << " m; check the scene's units (metres), the liquid's surface tension and its sweep scale";
  throw std::invalid_argument(message.str());
}

// A little of what matters to the meniscus, but less of what is modelled: at low gravity the capillary length knows no
// bounds.
double snap_tolerance(const Liquid& liquid, const Topology& level, const std::vector<std::uint32_t>& surface) {
  constexpr double kOfLength = 0.02, kOfSize = 0.005;  // capillary lengths, parts of the surface's smaller extent
  Box box;
  for (const std::uint32_t t : surface) box.add(level.box(t));
  return std::min(kOfLength * liquid.capillary_length,
                  kOfSize * std::min(box.high.x - box.low.x, box.high.z - box.low.z));
}

}  // namespace

Surface build(const Liquid& liquid, const std::vector<Solid>& solids) {
  Surface result;
  Warnings warnings;
  std::vector<std::uint32_t> surface;
  Topology level = weld_liquid(liquid, surface, warnings);
  const std::vector<Body> bodies = weld_solids(solids, warnings);
  snap_border(level, surface, liquid.name, bodies, snap_tolerance(liquid, level, surface), warnings);
  const bool solved = liquid.profile == Profile::solved;
  const double unit = sweep_length(liquid);
  double reach = raised_length(liquid);
  constexpr double kCurved = 1;  // capillary lengths: fits the equilibrium of an ellipse best

  std::vector<Box> boxes;
  for (const std::uint32_t t : surface) boxes.push_back(level.box(t));
  const Tree tree(std::move(boxes));
  std::vector<Contour> contours;
  std::vector<Need> needs;         // by contour
  std::vector<ContactLine> lines;  // evenly fine at first: these show where columns may stand farther apart
  for (std::size_t s = 0; s < bodies.size(); ++s) {
    for (Contour& contour : find_contours(level, surface, tree, bodies, s, warnings)) {
      refuse_endless(contour, bodies[s].name, raised_length(liquid));
      const Need need = need_of(contour, liquid);
      needs.push_back(need);
      lines.push_back(
          refine(contour, s, unit, {{}, find_fineness(contour, bodies[s].contact_angle, liquid, need.coarseness)}));
      contours.push_back(std::move(contour));
      if (!solved) continue;
      constexpr double kLeft = 5;  // capillary lengths beyond the contact line, however far it runs out
      measure_curvature(lines.back(), kCurved * liquid.capillary_length);
      reach = std::max(reach, run_out(lines.back(), bodies[s], liquid) + kLeft * liquid.capillary_length);
    }
  }
  for (ContactLine& line : lines) line.sweep = reach;
  constexpr double kMargin = 1.05;  // the band's border keeps clear of the patch's
  const Patch patch(level, surface, lines, kMargin * reach);
  const std::vector<Resolution> resolutions = find_resolutions(lines, bodies, patch, unit, reach, warnings);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    lines[l] = refine(contours[l], lines[l].solid, unit, resolutions[l]);
    lines[l].sweep = reach, lines[l].need = needs[l];
    measure_curvature(lines[l], kCurved * liquid.capillary_length);
  }
  find_free_lengths(lines, solved ? unit / 16 : reach, reach);
  if (solved)
    for (ContactLine& line : lines) refine_in_gaps(line, reach);
  Warnings as_raised;                   // of a start that is solved for
  std::map<std::size_t, Share> pinned;  // by solid
  for (ContactLine& line : lines) {
    const Body& body = bodies[line.solid];
    pinned[line.solid].add(bond(line, body, liquid), line.nodes.size());
  }
  if (solved) wake_neighbours(lines, reach);
  std::vector<bool> all(lines.size(), true);
  share_slides(lines, all);
  for (ContactLine& line : lines) differentiate(line);
  for (const auto& [solid, share] : pinned) {
    if (share.part == 0) continue;
    (solved ? as_raised : warnings)
        .push_back({"solid '" + bodies[solid].name + "': the contact line is pinned along " + share.percent() +
                        " of its length: the solid ends before the meniscus does, or slants too much for it",
                    {solid}});
  }
  Sheet sheet = lines.empty() ? Sheet{} : remesh(level, patch, lines, bodies, unit, reach, warnings);
  if (sheet.overlaps) {
    warnings.push_back({"liquid '" + liquid.name + "' lies over itself, seen from above, near solid '" +
                        bodies[lines.front().solid].name +
                        (lines.back().solid > lines.front().solid ? "' or another" : "'") +
                        ": it is left as it is, without menisci"});
    for (Warning& w : warnings) result.warnings.push_back(std::move(w.text));
    result.mesh = liquid_as_it_is(level);
    result.meniscus.assign(result.mesh.triangles.size(), 0);
    return result;
  }
  Raised raised = raise(level, surface, patch, sheet, lines, bodies, liquid, solved ? as_raised : warnings);
  if (solved) {
    wake_neighbours(lines, reach);  // what was lowered to the level
    result.solution = equilibrate(raised, sheet, lines, bodies, liquid, as_raised, warnings);
  }
  Stitched stitched = stitch(level, surface, patch, sheet, raised, bodies);
  if (!lines.empty()) check(liquid, stitched, lines, bodies, warnings);
  if (!faces_up(stitched.mesh))
    warnings.push_back(
        {"liquid '" + liquid.name +
         "' lies wholly within solids: nothing of its surface is left; a solid that holds a liquid needs an "
         "inner wall"});

  for (const ContactLine& line : lines) result.contacts.push_back(describe(line, bodies[line.solid]));
  result.mesh = std::move(stitched.mesh);
  result.within = std::move(stitched.within);
  result.meniscus = std::move(stitched.meniscus);
  share_out(result, stitched.line, lines, warnings);
  for (Warning& w : warnings) result.warnings.push_back(std::move(w.text));
  return result;
}

}  // namespace meniscus
