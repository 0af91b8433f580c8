#include "nlmech/bvp/multistart.hpp"

#include <algorithm>

#include "nlmech/support/stopwatch.hpp"

namespace nlmech::bvp {
namespace {

bool close(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance) {
  if (a.size() == 0) return true;
  return ((a - b).array().abs() / (1 + b.array().abs())).maxCoeff() <= tolerance;
}

bool same(const Extremal& a, const Extremal& b, double tolerance) {
  return close(a.solution.first(), b.solution.first(), tolerance) &&
         close(a.solution.parameters(), b.solution.parameters(), tolerance);
}

}  // namespace

Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts, const Options& options,
                      const MultistartOptions& many) {
  const Stopwatch watch;
  Multistart result;
  for (std::size_t k = 0; k < starts.size() && watch.seconds() <= many.seconds; ++k) {
    Extremal extremal = solve_extremal(problem, starts[k], options);
    result.statistics += extremal.solution.statistics;
    if (!extremal.solution.status.ok()) {
      ++(extremal.solution.status.outcome() == Outcome::spurious_root ? result.spurious : result.failed);
      continue;
    }
    ++result.good;
    const auto known = std::find_if(result.found.begin(), result.found.end(), [&](const Found& f) {
      return same(f.extremal, extremal, many.distinct);
    });
    if (known != result.found.end()) {
      ++known->hits;
      continue;
    }
    if (many.second_order_pieces > 0) {
      extremal.second_order = second_order(problem, extremal.solution, many.second_order_pieces);
    }
    result.found.push_back({std::move(extremal), 1});
  }
  std::sort(result.found.begin(), result.found.end(),
            [](const Found& a, const Found& b) { return a.extremal.cost < b.extremal.cost; });
  result.statistics.seconds = watch.seconds();
  return result;
}

}  // namespace nlmech::bvp
