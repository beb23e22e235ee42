#include "host/tradeoff/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscal {

std::vector<std::size_t> pareto_front(const std::vector<Trade>& trades) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < trades.size(); ++i)
    if (std::isfinite(trades[i].seconds) && std::isfinite(trades[i].error)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Trade &a = trades[i], &b = trades[j];
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.error < b.error;
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order)
    if (trades[i].error < least) {
      least = trades[i].error;
      front.push_back(i);
    }
  return front;
}

std::optional<std::size_t> best_within(const std::vector<Trade>& trades, const std::vector<std::size_t>& front,
                                       double seconds) {
  std::optional<std::size_t> best;
  for (const std::size_t i : front)
    if (trades[i].seconds <= seconds) best = i;
  return best;
}

}  // namespace meniscal
