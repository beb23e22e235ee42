#include "meniscus/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <unordered_map>

#include "meniscus/corner.h"

namespace meniscus {
namespace {

// The triangles with moving vertices in parts that share none, each in ascending order.
std::vector<std::vector<std::uint32_t>> find_parts(const Sheet& sheet, const std::vector<ContactLine>& lines) {
  std::vector<std::uint32_t> parent(sheet.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto is_mover = [&](std::uint32_t v) { return moves(sheet.vertices[v], lines); };
  const auto mover = [&](const glm::uvec3& t) {
    for (int k = 0; k < 3; ++k)
      if (is_mover(t[k])) return t[k];
    return kNoVertex;
  };
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const std::uint32_t first = mover(sheet.triangles[t]);
    for (int k = 0; k < 3 && first != kNoVertex; ++k) {
      const std::uint32_t v = sheet.triangles[t][k];
      if (is_mover(v)) parent[root(v)] = root(first);
    }
  }
  std::map<std::uint32_t, std::size_t> part_of;
  std::vector<std::vector<std::uint32_t>> parts;
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    const std::uint32_t first = mover(sheet.triangles[t]);
    if (first == kNoVertex) continue;
    const auto [known, fresh] = part_of.try_emplace(root(first), parts.size());
    if (fresh) parts.emplace_back();
    parts[known->second].push_back(t);
  }
  return parts;
}

// Of a part at rest, the triangles whose slope counts stay targets of photons.
void keep_steep(const std::vector<std::uint32_t>& part, const std::vector<Film::Point>& points, Sheet& sheet) {
  constexpr double kSteep = 2, kLevel = 0.01, kShare = 0.1;  // degrees; of the steepest
  std::unordered_map<std::uint32_t, double> slopes;
  double steepest = 0;
  for (const Film::Point& p : points) {
    const glm::dvec3& n = p.at.normal;
    steepest = std::max(steepest, slopes[p.vertex] = std::atan2(std::hypot(n.x, n.z), n.y));
  }
  const double least = std::clamp(kShare * steepest, glm::radians(kLevel), glm::radians(kSteep));
  for (const std::uint32_t t : part) {
    bool steep = false;
    for (int k = 0; k < 3; ++k) {
      const auto slope = slopes.find(sheet.triangles[t][k]);
      steep = steep || (slope != slopes.end() && slope->second > least);
    }
    sheet.raised[t] = steep;
  }
}

// From above a level liquid at height 0 to above this one: sheared, as the heights are.
glm::dvec3 above(const Base& base, const glm::dvec3& normal) {
  return glm::normalize(normal + normal.y / base.normal.y * glm::dvec3(base.normal.x, 0, base.normal.z));
}

Film::Outcome solve(Film& film) {
  Film::Outcome outcome = film.solve();
  outcome.converged = outcome.converged && !film.vanished();
  return outcome;
}

// Brings the contact angles from those at which the level liquid is at rest to the solids' own, in steps so small that
// Newton's method can follow. Leaves the film as far on the way as it came, if that is most of it.
Film::Outcome ease(Film& film) {
  constexpr double kFirst = 0.25, kLeast = 0.02, kEnough = 0.5;  // parts of the way
  constexpr int kMostSteps = 200;
  Film::Outcome last;
  double done = 0;
  for (double step = kFirst; done < 1 && step > kLeast && last.steps < kMostSteps;) {
    const double part = std::min(done + step, 1.0);
    Film next = film;
    next.ask(part);
    const Film::Outcome outcome = solve(next);
    last.steps += outcome.steps;
    if (outcome.converged) {
      film = std::move(next), done = part, last.last_step = outcome.last_step;
      step *= 1.5;
    } else {
      step = 0.5 * (part - done);
    }
  }
  last.converged = done >= kEnough;
  return last;
}

// What is raised is near where it rests, but not where menisci meet, which may rise far above each alone; from the
// level the way is long where the solid is met at a grazing angle.
Film::Outcome find_rest(Film& film, FilmContext& context, const std::vector<std::uint32_t>& part) {
  int steps = 0;
  Film::Outcome outcome = solve(film);
  if (!outcome.converged) {
    steps += outcome.steps;
    film = Film(context, part, Film::Start::raised);
    outcome = solve(film);
  }
  constexpr int kToAndFro = 100;  // steps: a film that creeps between a flat-shaded solid's facets does so at any angle
  if (!outcome.converged && steps + outcome.steps < kToAndFro) {
    steps += outcome.steps;
    film = Film(context, part, Film::Start::level);
    outcome = ease(film);
  }
  outcome.steps += steps;
  return outcome;
}

}  // namespace

Solution equilibrate(Raised& raised, Sheet& sheet, std::vector<ContactLine>& lines, const std::vector<Body>& bodies,
                     const Liquid& liquid, const Warnings& as_raised, Warnings& warnings) {
  FilmContext context{sheet, raised, lines, bodies, liquid.capillary_length, {}, {}, {}};
  context.local.assign(sheet.vertices.size(), kNoVertex);
  for (const ContactLine& line : lines) {
    const Body& body = bodies[line.solid];
    context.contact_at.emplace_back(line.nodes.size(), kNoVertex);
    context.angles.push_back(finite_angles(line, body.contact_angle, liquid.capillary_length, body.name, warnings));
  }
  for (std::uint32_t v = 0; v < sheet.vertices.size(); ++v) {
    const Sheet::Vertex& vertex = sheet.vertices[v];
    if (vertex.node) context.contact_at[vertex.foot.line][vertex.foot.node] = v;
  }
  std::set<std::size_t> crossed;  // solids
  for (const Sheet::Vertex& v : sheet.vertices)
    if (v.crossing && v.foot.exists() && lines[v.foot.line].sweep > 0) crossed.insert(lines[v.foot.line].solid);
  for (const std::size_t solid : crossed) {
    warnings.push_back({"solid '" + bodies[solid].name +
                            "': where its contact line crosses another solid's the liquid stays level; as one solid "
                            "they would get the meniscus that they have together",
                        {solid}});
  }
  Solution solution;
  std::set<std::size_t> failed;         // solids
  std::map<std::size_t, Share> pinned;  // by solid
  std::map<std::size_t, double> off;    // radians, by solid
  for (const std::vector<std::uint32_t>& part : find_parts(sheet, lines)) {
    Film film(context, part, Film::Start::level);
    const Film::Outcome outcome = find_rest(film, context, part);
    ++solution.parts;
    solution.unknowns += film.unknowns(), solution.steps += static_cast<std::size_t>(outcome.steps);
    if (!outcome.converged || film.off() > 0) {
      ++solution.failed;
      for (const std::uint32_t t : part) {
        const std::size_t solid = lines[sheet.line_of(t)].solid;
        if (outcome.converged)
          off[solid] = std::max(off[solid], film.off());
        else
          failed.insert(solid);
      }
    }
    if (!outcome.converged) continue;
    solution.last_step = std::max(solution.last_step, outcome.last_step);
    const Film::Shape shape = film.shape();
    solution.height_error = std::max(solution.height_error, shape.sagitta);
    for (const Film::Point& p : shape.points) {
      const Sheet::Vertex& vertex = sheet.vertices[p.vertex];
      const Base& base = raised.base[p.vertex];
      Lifted& at = raised.at[p.vertex];
      at.normal = raised.across[p.vertex] = above(base, p.at.normal);
      if (!liquid.flatten) at.position = p.at.position + glm::dvec3(0, base.position.y, 0);
      if (!vertex.node) continue;
      ContactLine& line = lines[vertex.foot.line];
      line.nodes[vertex.foot.node].contact.rise = p.at.position.y;
      line.at_rest = true;
      pinned[line.solid].add(0, 1);
    }
    keep_steep(part, shape.points, sheet);
    for (const std::uint32_t v : film.pinned()) pinned[lines[sheet.vertices[v].foot.line].solid].add(1, 0);
  }
  for (const auto& [solid, share] : pinned) {
    if (share.part == 0) continue;
    warnings.push_back({"solid '" + bodies[solid].name + "': the contact line is pinned along " + share.percent() +
                            " of its length, at an edge or an end of the solid",
                        {solid}});
  }
  for (const std::size_t solid : failed) {
    warnings.push_back({"solid '" + bodies[solid].name +
                            "': the shape of its meniscus at rest was not found; it has the paper's profile, as high "
                            "as at a straight or round wall",
                        {solid}});
  }
  for (const auto& [solid, by] : off) {
    std::ostringstream message;
    message << "solid '" << bodies[solid].name << "': its meniscus at rest was found only for contact angles up to "
            << std::setprecision(2) << glm::degrees(by) << " degrees off; it reaches less far from the level";
    warnings.push_back({message.str(), {solid}});
  }
  for (const Warning& w : as_raised) {
    if (std::any_of(w.solids.begin(), w.solids.end(), [&](std::size_t s) { return failed.contains(s); }))
      warnings.push_back(w);
  }
  return solution;
}

}  // namespace meniscus
