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

// One matrix and as many steps as it is good for; ends at once where no part of a step is one ahead.
Film::Progress Film::go_on(LinearSystem& system, double most) {
  constexpr double kLeastPart = 0.1, kReuse = 0.1;
  constexpr double kPrecise = 1e-7;  // capillary lengths
  Progress result;
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
    result.last_step = step.lpNorm<Eigen::Infinity>();
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
        contraction = next.norm() / step.norm();
      }
      if (!(contraction < 1 - part / 4)) {
        restore(from);
        continue;
      }
      result.moved += part * result.last_step;
      result.railed = whole < 1;
      result.settled = part == 1 && result.last_step <= kPrecise * length_;
      good = !result.settled && part == 1 && same && contraction < kReuse && result.moved < most;
      step = next;
      break;
    }
  }
  return result;
}

Film::Outcome Film::solve() {
  constexpr int kRounds = 40, kMostSteps = 200;
  constexpr double kRail = 0.3, kLong = 0.5;  // capillary lengths
  constexpr double kFacets = 2e-3;            // what facets' edges may move it by, to and fro
  constexpr double kSettled = 1e-4;           // of a round
  Outcome outcome;
  LinearSystem system(blocks_);
  double before = 1;
  for (int round = 0; round < kRounds && !outcome.converged; ++round) {
    rebase(kRail * length_);
    Progress now;
    double moved = 0;
    while (!now.settled && !now.railed && moved < kLong) {
      if (outcome.steps++ == kMostSteps) return outcome;
      now = go_on(system, (kLong - moved) * length_);
      if (now.moved == 0) return outcome;
      moved += now.moved / length_, outcome.last_step = now.last_step;
    }
    outcome.converged = now.settled && (moved < kSettled || (moved < kFacets && moved > 0.5 * before));
    before = moved;
  }
  return outcome;
}

}  // namespace meniscus
