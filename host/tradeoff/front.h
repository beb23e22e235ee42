// The Pareto front of cost and error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace meniscal {

struct Trade {
  double seconds, error;
};

// Indices of the trades that no other dominates: none is as cheap and as good, and cheaper or better. By growing
// seconds, so by falling error. Of equal trades the first is kept; what is not finite is left out.
std::vector<std::size_t> pareto_front(const std::vector<Trade>& trades);

// The least error that so many seconds buy: the last of the front that takes no more. Nothing where all take more.
std::optional<std::size_t> best_within(const std::vector<Trade>& trades, const std::vector<std::size_t>& front,
                                       double seconds);

}  // namespace meniscal
