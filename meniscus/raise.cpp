#include "meniscus/raise.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "meniscus/predicates.h"
#include "meniscus/share.h"

namespace meniscus {
namespace {

constexpr double kLeast = 0.1;  // of a triangle's area in projection: less counts as squeezed

void find_bases(Raised& raised, const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch,
                const Sheet& sheet) {
  std::vector<glm::dvec3> normal_at(liquid.points.size());  // of the free surface, that of the first untouched triangle
  for (const bool touched : {true, false}) {
    for (auto t = surface.rbegin(); t != surface.rend(); ++t) {
      if (patch.contains(*t) != touched) continue;
      for (int i = 2; i >= 0; --i) normal_at[liquid.triangles[*t].points[i]] = liquid.triangles[*t].normals[i];
    }
  }
  std::vector<bool> placed = raised.used;
  for (const glm::uvec3& t : sheet.within) placed[t.x] = placed[t.y] = placed[t.z] = true;
  for (std::size_t i = 0; i < sheet.vertices.size(); ++i) {
    if (!placed[i]) continue;
    const Sheet::Vertex& vertex = sheet.vertices[i];
    if (vertex.node) {
      raised.base[i] = {vertex.node->position, vertex.node->liquid_normal};
    } else if (vertex.original) {
      raised.base[i] = {liquid.points[*vertex.original], normal_at[*vertex.original]};
    } else {
      raised.base[i] = patch.clamped(vertex.x);
    }
  }
}

// Which vertices and which triangles of menisci have feet on each line.
struct Members {
  std::vector<std::vector<std::uint32_t>> vertices, triangles;
};

Members find_members(const Raised& raised, const Sheet& sheet, std::size_t lines) {
  Members of{std::vector<std::vector<std::uint32_t>>(lines), std::vector<std::vector<std::uint32_t>>(lines)};
  for (std::uint32_t i = 0; i < sheet.vertices.size(); ++i) {
    const Foot &foot = sheet.vertices[i].foot, &other = sheet.vertices[i].other;
    if (!raised.used[i] || !foot.exists()) continue;
    of.vertices[foot.line].push_back(i);
    if (other.exists() && other.line != foot.line) of.vertices[other.line].push_back(i);
  }
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    if (!sheet.raised[t]) continue;
    for (int k = 0; k < 3; ++k) {
      const Sheet::Vertex& vertex = sheet.vertices[sheet.triangles[t][k]];
      for (const Foot* foot : {&vertex.foot, &vertex.other}) {
        if (!foot->exists()) continue;
        auto& triangles = of.triangles[foot->line];
        if (triangles.empty() || triangles.back() != t) triangles.push_back(t);
      }
    }
  }
  return of;
}

void lift_vertices(Raised& raised, const Sheet& sheet, const std::vector<std::uint32_t>& vertices,
                   const std::vector<ContactLine>& lines, bool flatten) {
  for (const std::uint32_t i : vertices) {
    const Base& base = raised.base[i];
    const auto by = [&](const Foot& foot) {
      const ContactLine& line = lines[foot.line];
      return lift(foot, line.sweep, line.profile, base.position, base.normal);
    };
    const Sheet::Vertex& vertex = sheet.vertices[i];
    raised.at[i] = by(vertex.foot);
    if (vertex.other.exists()) {  // on a crease: the mean of where the two sides go
      const Lifted other = by(vertex.other);
      raised.at[i].position = 0.5 * (raised.at[i].position + other.position);
      raised.across[i] = other.normal;
    }
    if (flatten) raised.at[i].position = base.position;
  }
}

using Marks = std::vector<std::vector<bool>>;  // per line and node

// Square of the sine of a triangle's smallest angle.
double thinness(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  double edges[3] = {glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)};
  std::sort(edges, edges + 3);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  return glm::dot(n, n) / (edges[1] * edges[2]);
}

// Does this triangle of a line's meniscus run within the line's own solid, deeper than its chords must?
bool cuts(const glm::dvec3 at[3], const Body& body) {
  constexpr double kSag = 0.06;  // of a chord, over an arc of 27 degrees
  const double longest =
      std::max({glm::distance(at[0], at[1]), glm::distance(at[1], at[2]), glm::distance(at[2], at[0])});
  return depth_within(body, (at[0] + at[1] + at[2]) / 3.0) > kSag * longest;
}

// Marks the nodes that turn triangles over, squeeze them, draw them out or push them into the solid. Returns whether
// there are any. Looks at the given triangles.
bool find_folds(const Raised& raised, const Sheet& sheet, const std::vector<ContactLine>& lines,
                const std::vector<Body>& bodies, const std::vector<std::uint32_t>& triangles, Marks& marks) {
  constexpr double kThinnest = 0.0007;  // 1.5 degrees
  bool any = false;
  const auto slide = [](const Foot& foot) {
    return std::max({glm::length(foot.from->slide), glm::length(foot.to->slide), glm::length(foot.from->toward),
                     glm::length(foot.to->toward)});
  };
  for (const std::uint32_t t : triangles) {
    glm::dvec2 was[3], is[3];
    glm::dvec3 base[3], at[3];
    double most = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = sheet.triangles[t][k];
      base[k] = raised.base[v].position, at[k] = raised.at[v].position;
      was[k] = sheet.vertices[v].x, is[k] = planar(at[k]);
      for (const Foot* foot : {&sheet.vertices[v].foot, &sheet.vertices[v].other})
        if (foot->exists()) most = std::max(most, slide(*foot));
    }
    const bool squeezed = cross(is[1] - is[0], is[2] - is[0]) <= kLeast * cross(was[1] - was[0], was[2] - was[0]);
    const bool thin = thinness(at[0], at[1], at[2]) < kThinnest && thinness(base[0], base[1], base[2]) >= kThinnest;
    const bool within = !squeezed && !thin && cuts(at, bodies[lines[sheet.line_of(t)].solid]);
    if (!squeezed && !thin && !within) continue;
    for (int k = 0; k < 3; ++k) {  // what hardly slides is not to blame
      const Sheet::Vertex& vertex = sheet.vertices[sheet.triangles[t][k]];
      for (const Foot* foot : {&vertex.foot, &vertex.other}) {
        constexpr double kToBlame = 0.3;
        if (!foot->exists() || (squeezed && (most == 0 || slide(*foot) < kToBlame * most))) continue;
        marks[foot->line][foot->node] = any = true;
        const bool segment = foot->from != foot->to && foot->fan == 0;
        if (segment) marks[foot->line][(foot->node + 1) % lines[foot->line].nodes.size()] = true;
      }
    }
  }
  return any;
}

// Leaves less room at marked nodes, and beside them no more than lets the line rise gently.
void lower(ContactLine& line, const std::vector<bool>& marked, bool to_level) {
  constexpr double kFactor = 0.75, kWithin = 0.5;  // sweep lengths, over which the whole height may be gained
  const std::size_t n = line.nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (marked[i]) line.nodes[i].room *= to_level ? 0 : kFactor;
  }
  const auto limit = [&](std::size_t from, std::size_t to) {
    const double apart = glm::distance(line.nodes[from].position, line.nodes[to].position);
    line.nodes[to].room = std::min(line.nodes[to].room, line.nodes[from].room + apart / (kWithin * line.sweep));
  };
  for (int round = 0; round < 1 + line.closed; ++round) {
    for (std::size_t i = line.closed ? 0 : 1; i < n; ++i) limit((i + n - 1) % n, i);
    for (std::size_t i = line.closed ? n : n - 1; i-- > 0;) limit((i + 1) % n, i);
  }
}

}  // namespace

Raised raise(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch, const Sheet& sheet,
             std::vector<ContactLine>& lines, const std::vector<Body>& bodies, const Liquid& parameters,
             Warnings& warnings) {
  Raised raised{std::vector<bool>(sheet.vertices.size(), false), {}, {}, {}};
  raised.base.resize(sheet.vertices.size());
  raised.at.resize(sheet.vertices.size());
  raised.across.resize(sheet.vertices.size());
  for (const glm::uvec3& t : sheet.triangles) raised.used[t.x] = raised.used[t.y] = raised.used[t.z] = true;
  find_bases(raised, liquid, surface, patch, sheet);
  for (std::size_t i = 0; i < sheet.vertices.size(); ++i)
    raised.at[i] = {raised.base[i].position, raised.base[i].normal};
  const Members of = find_members(raised, sheet, lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    lift_vertices(raised, sheet, of.vertices[l], lines, parameters.flatten);

  Marks lowered;
  for (const ContactLine& line : lines) lowered.emplace_back(line.nodes.size(), false);
  std::vector<bool> changed(lines.size(), true);
  constexpr int kRounds = 30, kToLevel = 10;
  for (int round = 0; round < kRounds; ++round) {
    Marks marks;
    for (const ContactLine& line : lines) marks.emplace_back(line.nodes.size(), false);
    bool any = false;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (changed[l] && find_folds(raised, sheet, lines, bodies, of.triangles[l], marks)) any = true;
    }
    if (!any) break;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      changed[l] = std::find(marks[l].begin(), marks[l].end(), true) != marks[l].end();
      if (!changed[l]) continue;
      std::vector<double> before;
      for (const Node& node : lines[l].nodes) before.push_back(node.room);
      lower(lines[l], marks[l], round >= kToLevel);
      for (std::size_t i = 0; i < before.size(); ++i)
        if (lines[l].nodes[i].room < 0.95 * before[i]) lowered[l][i] = true;
      bond(lines[l], bodies[lines[l].solid], parameters);
    }
    share_slides(lines, changed);
    for (std::size_t l = 0; l < lines.size(); ++l)
      if (changed[l]) differentiate(lines[l]);
    for (std::size_t l = 0; l < lines.size(); ++l)
      if (changed[l]) lift_vertices(raised, sheet, of.vertices[l], lines, parameters.flatten);
  }
  for (std::size_t i = 0; i < sheet.vertices.size(); ++i) {  // where lines cross there is no node to be bonded
    const Sheet::Vertex& vertex = sheet.vertices[i];
    if (parameters.flatten || !raised.used[i] || !vertex.crossing || !vertex.foot.exists()) continue;
    raised.at[i].position = nearest_on_solid(bodies[lines[vertex.foot.line].solid], raised.at[i].position).position;
  }
  std::map<std::size_t, Share> shares;  // by solid
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto count = std::count(lowered[l].begin(), lowered[l].end(), true);
    shares[lines[l].solid].add(static_cast<std::size_t>(count), lowered[l].size());
  }
  for (const auto& [solid, share] : shares) {
    if (share.part == 0) continue;
    warnings.push_back({"solid '" + bodies[solid].name + "': its meniscus is lowered along " + share.percent() +
                            " of its contact line: at its full height it would fold, or cut into the solid",
                        {solid}});
  }
  return raised;
}

}  // namespace meniscus
