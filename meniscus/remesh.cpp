#include "meniscus/remesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "meniscus/inside.h"
#include "meniscus/predicates.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kNone = Triangulation::kNone;

// Triangulation and what is known of each of its vertices.
class Builder {
 public:
  Builder(const Topology& liquid, const Patch& patch, const std::vector<ContactLine>& lines, double sweep_length)
      : liquid_(liquid),
        patch_(patch),
        lines_(lines),
        field_(lines),
        mesh_(glm::dvec2(patch.box().low), glm::dvec2(patch.box().high)) {
    for (const ContactLine& line : lines) gradings_.emplace_back(line, sweep_length);
  }

  // Points first, constraints after them.
  void fill() {
    std::vector<std::vector<std::uint32_t>> nodes(lines_.size());
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      for (std::size_t i = 0; i < lines_[l].nodes.size(); ++i) {
        const Node& node = lines_[l].nodes[i];
        const std::uint32_t v = add(place(node, lines_[l].sweep));
        Sheet::Vertex& vertex = vertices_[v];
        vertex.node = &node;
        vertex.border = node.border;
        vertex.foot = {l, i, &node.contact, &node.contact, 0, 0, 0, node.contact.direction};
        nodes[l].push_back(v);
        if (node.border) on_border_[*node.border].push_back(v);
      }
    }
    for (const Patch::Side& side : patch_.border()) original(side.from);
    std::vector<std::vector<std::uint32_t>> border;
    for (const Patch::Side& side : patch_.border()) border.push_back(divide(side));
    for (const BandPoint& p : sweep(lines_, gradings_, field_, patch_, spacing_)) {
      Sheet::Vertex& vertex = vertices_[add(p.x, false)];
      if (!vertex.foot.exists()) vertex.foot = p.foot, vertex.other = p.other;
    }
    keep_inner_points();
    for (std::size_t i = 0; i < border.size(); ++i) {
      for (std::size_t k = 0; k + 1 < border[i].size(); ++k) mesh_.constrain(border[i][k], border[i][k + 1], {0, -1});
    }
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      for (std::size_t i = 0; i < lines_[l].segments(); ++i) {
        mesh_.constrain(nodes[l][i], nodes[l][(i + 1) % nodes[l].size()], {1, 0});
      }
    }
    while (vertices_.size() < mesh_.points().size()) {  // where contact lines cross each other
      const glm::dvec2 x = mesh_.points()[vertices_.size()];
      vertices_.push_back({x, field_.foot(x), {}, nullptr, {}, {}, true});
    }
  }

  const Triangulation& mesh() const { return mesh_; }
  const Field& field() const { return field_; }
  std::vector<Sheet::Vertex>& vertices() { return vertices_; }

 private:
  std::uint32_t add(const glm::dvec2& x, bool taken = true) {
    const std::uint32_t v = mesh_.insert(x);
    if (v >= vertices_.size()) vertices_.resize(v + 1);
    vertices_[v].x = x;
    if (taken) spacing_.take(x);
    return v;
  }

  // Where a contour ends beside a point of the liquid's border, that point: a sliver between them would have no shape.
  glm::dvec2 place(const Node& node, double sweep) const {
    constexpr double kBeside = 1e-6;  // sweep lengths
    const glm::dvec2 x = planar(node.position);
    if (!node.border) return x;
    for (const std::uint32_t end : {node.border->first, node.border->second}) {
      const glm::dvec2 p = planar(liquid_.points[end]);
      if (glm::distance(p, x) < kBeside * sweep) return p;
    }
    return x;
  }

  std::uint32_t original(std::uint32_t point) {
    const glm::dvec2 x = planar(liquid_.points[point]);
    const std::uint32_t v = add(x);
    vertices_[v].original = point;
    if (!vertices_[v].foot.exists()) vertices_[v].foot = field_.foot(x);
    return v;
  }

  double spacing_at(const glm::dvec2& x, double nearer_by) const {
    const Foot foot = field_.foot(x);
    if (!foot.exists()) return std::numeric_limits<double>::infinity();
    return gradings_[foot.line].spacing(std::max(foot.distance - nearer_by, 0.0));
  }

  // The vertices along one side of the patch. The liquid's own border is divided where contours end on it and where the
  // band is fine; sides towards untouched liquid stay whole.
  std::vector<std::uint32_t> divide(const Patch::Side& side) {
    std::vector<std::uint32_t> result{original(side.from)};
    const std::uint32_t last = original(side.to);
    if (side.own) {
      const glm::dvec2 origin = vertices_[result[0]].x, way = vertices_[last].x - origin;
      const Edge key = edge(side.from, side.to);
      auto& ends = on_border_[key];
      std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(vertices_[a].x - origin, way) < glm::dot(vertices_[b].x - origin, way);
      });
      ends.push_back(last);
      for (const std::uint32_t end : ends) {
        halve(result, end, key);
        if (result.back() != end) result.push_back(end);
      }
    } else {
      result.push_back(last);
    }
    return result;
  }

  // Appends the points between the last of `chain` and `end`.
  void halve(std::vector<std::uint32_t>& chain, std::uint32_t end, const Edge& key) {
    const glm::dvec2 a = vertices_[chain.back()].x, b = vertices_[end].x, middle = 0.5 * (a + b);
    const double length = glm::distance(a, b);
    if (!(length > 2.5 * spacing_at(middle, 0.5 * length))) return;
    const std::uint32_t v = add(middle);
    vertices_[v].border = key;
    vertices_[v].foot = field_.foot(middle);
    halve(chain, v, key);
    chain.push_back(v);
    halve(chain, end, key);
  }

  // Points of the liquid within the patch but beyond the menisci keep their shape, where they are not too near to new
  // ones.
  void keep_inner_points() {
    std::vector<std::uint32_t> inner;
    for (const std::uint32_t t : patch_.triangles()) {
      for (int i = 0; i < 3; ++i) inner.push_back(liquid_.triangles[t].points[i]);
    }
    std::sort(inner.begin(), inner.end());
    inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
    for (const std::uint32_t point : inner) {
      const glm::dvec2 x = planar(liquid_.points[point]);
      const Foot foot = field_.foot(x);
      if (!foot.exists() || foot.distance <= lines_[foot.line].sweep) continue;
      if (!spacing_.claim(x, 0.5 * gradings_[foot.line].spacing(foot.distance))) continue;
      const std::uint32_t v = add(x, false);
      vertices_[v].original = point;
      vertices_[v].foot = foot;
    }
  }

  const Topology& liquid_;
  const Patch& patch_;
  const std::vector<ContactLine>& lines_;
  Field field_;
  std::vector<Grading> gradings_;
  Spacing spacing_;
  Triangulation mesh_;
  std::vector<Sheet::Vertex> vertices_;
  std::map<Edge, std::vector<std::uint32_t>> on_border_;  // vertices where contours end
};

}  // namespace

Sheet remesh(const Topology& liquid, const Patch& patch, const std::vector<ContactLine>& lines,
             const std::vector<Body>& bodies, double sweep_length, double reach, Warnings& warnings) {
  Builder builder(liquid, patch, lines, sweep_length);
  builder.fill();
  const Triangulation& mesh = builder.mesh();
  const auto& triangles = mesh.triangles();
  const Winding winding = find_windings(mesh, patch, bodies, warnings);
  const auto kept = [&](std::uint32_t t) { return t != kNone && winding.patch[t] > 0 && winding.solid[t] <= 0; };

  Sheet sheet;
  sheet.overlaps = std::any_of(winding.patch.begin(), winding.patch.end(), [](int w) { return w < 0 || w > 1; });
  if (sheet.overlaps) return sheet;
  sheet.vertices = std::move(builder.vertices());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& v = triangles[t].v;
    if (!kept(t)) {
      if (winding.patch[t] > 0) sheet.within.emplace_back(v[0], v[1], v[2]);
      for (int i = 0; i < 3 && winding.patch[t] > 0; ++i) {  // goes on into the untouched liquid
        const auto &a = sheet.vertices[v[(i + 1) % 3]].original, &b = sheet.vertices[v[(i + 2) % 3]].original;
        if (a && b && winding.patch[triangles[t].n[i]] <= 0) sheet.drowned.push_back(edge(*a, *b));
      }
      continue;
    }
    sheet.triangles.emplace_back(v[0], v[1], v[2]);
    int within = 0, at_end = 0, beyond = 0;  // corners within menisci, at their ends, farther out
    for (const std::uint32_t k : v) {
      const Foot& foot = sheet.vertices[k].foot;
      const double end = foot.exists() ? lines[foot.line].sweep : 0;
      const double left = end - foot.distance;
      ++(left > 1e-9 * sweep_length ? within : left > -1e-9 * sweep_length && end > 0 ? at_end : beyond);
    }
    if ((within > 0 && beyond == 0) || (beyond > 0 && within == 0)) {
      sheet.raised.push_back(within > 0);
      continue;
    }
    const glm::dvec2 centre = (sheet.vertices[v[0]].x + sheet.vertices[v[1]].x + sheet.vertices[v[2]].x) / 3.0;
    const Foot foot = builder.field().foot(centre, reach);
    bool raised = foot.exists() && foot.distance < lines[foot.line].sweep;
    if (!foot.exists()) {  // between a chord and the facets
      for (const std::uint32_t k : v)
        raised = raised || (sheet.vertices[k].node && lines[sheet.vertices[k].foot.line].sweep > 0);
    }
    sheet.raised.push_back(raised);
  }
  return sheet;
}

}  // namespace meniscus
