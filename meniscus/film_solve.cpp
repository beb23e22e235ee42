// Newton's method on a film's equations.
#include "meniscus/film.h"
#include "meniscus/linear_system.h"

namespace meniscus {

// A contact vertex at an end of its rail is held there as long as it is pushed outward: it has no equation then.
std::vector<bool> Film::hold(Eigen::VectorXd& force) {
  std::vector<bool> held(unknowns_, false);
  for (ContactVertex& c : contacts_) {
    if (c.held * force[c.unknown] > 0) c.held = 0;
    if (c.held != 0) held[c.unknown] = true, force[c.unknown] = 0;
  }
  return held;
}

// Steps with one matrix, as many as it is good for. Returns false if there is none: where no tenth of it would bring
// the film nearer to rest.
bool Film::go_on(LinearSystem& system, Round& round) {
  constexpr double kLeastPart = 0.1, kReuse = 0.3;
  constexpr double kPrecise = 1e-7, kShare = 1e-3;  // of a step: capillary lengths, part of what the round moved
  bool any = false;
  auto [force, entries] = equations();
  const std::vector<bool> held = hold(force);
  std::erase_if(entries, [&](const auto& e) { return held[e.row()] || held[e.col()]; });
  for (std::uint32_t u = 0; u < unknowns_; ++u)
    if (held[u]) entries.emplace_back(u, u, 1.0);
  LinearSystem::Matrix matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  system.set(std::move(matrix));
  Eigen::VectorXd step = system.solve(-force);
  for (bool good = step.allFinite(); good;) {
    round.last_step = step.lpNorm<Eigen::Infinity>();
    const State from = save();
    const double whole = railed(step);
    good = false;
    for (double part = whole; part > kLeastPart * whole; part *= 0.5) {
      bool same = false;
      double contraction = 1;
      Eigen::VectorXd next;
      if (advance(part * step, from)) {
        force = equations().force;
        same = hold(force) == held;
        next = system.solve(-force);
        contraction = step.norm() > 0 ? next.norm() / step.norm() : 0;
      }
      if (!(contraction < 1 - part / 4)) {
        restore(from);
        continue;
      }
      any = true, ++round.steps;
      round.moved += part * round.last_step;
      round.railed = whole < 1;
      round.settled = part == 1 && round.last_step <= std::max(kPrecise * length_, kShare * round.moved);
      good = round.goes_on(length_) && part == 1 && same && contraction < kReuse;
      step = next;
      break;
    }
  }
  return any;
}

Film::Outcome Film::solve() {
  constexpr int kRounds = 40, kMostSteps = 300;
  // Capillary lengths: of rails; that a last round may move it by; and facets' edges, to and fro.
  constexpr double kRail = 0.3, kSettled = 1e-4, kFacets = 2e-3;
  Outcome outcome;
  LinearSystem system(blocks_);
  double before = 1;
  for (int round = 0; round < kRounds && !outcome.converged; ++round) {
    rebase(kRail * length_);
    Round now;
    while (now.goes_on(length_)) {
      if (outcome.steps + now.steps >= kMostSteps || !go_on(system, now)) {
        outcome.steps += now.steps;
        return outcome;
      }
      outcome.last_step = now.last_step;
    }
    outcome.steps += now.steps;
    const double moved = now.moved / length_;
    outcome.converged = now.settled && (moved < kSettled || (moved < kFacets && moved > 0.5 * before));
    before = moved;
  }
  return outcome;
}

}  // namespace meniscus
