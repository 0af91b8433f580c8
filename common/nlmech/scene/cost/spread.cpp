#include "nlmech/scene/cost/spread.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace nlmech::scene {
namespace {

/// Neighbours that touch: they share their mean.
struct Pool {
  double sum;
  std::size_t count;
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

}  // namespace

std::vector<double> spread(const std::vector<double>& wanted, double gap, double low, double high) {
  if (wanted.empty()) return {};
  const std::size_t n = wanted.size();
  if (n > 1) gap = std::min(gap, (high - low) / static_cast<double>(n - 1));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return wanted[i]; });
  // Less the gaps below them, places must not fall: that is isotonic regression, by pooling what falls.
  std::vector<Pool> pools;
  for (std::size_t k = 0; k < n; ++k) {
    pools.push_back({wanted[order[k]] - gap * static_cast<double>(k), 1});
    while (pools.size() > 1 && pools.back().mean() < pools[pools.size() - 2].mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().sum + last.sum, pools.back().count + last.count};
    }
  }
  std::vector<double> places(n);
  const double highest = high - gap * static_cast<double>(n - 1);
  std::size_t k = 0;
  for (const Pool& pool : pools) {
    const double place = std::max(low, std::min(pool.mean(), highest));
    for (std::size_t i = 0; i < pool.count; ++i, ++k) places[order[k]] = place + gap * static_cast<double>(k);
  }
  return places;
}

}  // namespace nlmech::scene
