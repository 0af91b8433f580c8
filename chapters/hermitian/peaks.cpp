#include "chapters/hermitian/peaks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::hermitian {

Case duffing_case() {
  const problems::TextProblem problem("laier-duffing");
  return {.system = ivp::System(problem), .x0 = problem.initial_state(), .sign = 1};
}

Case van_der_pol_case() {
  const problems::TextProblem problem("laier-van-der-pol");
  return {.system = ivp::System(problem), .x0 = problem.initial_state(), .sign = -1};
}

Peak first_peak(const Case& what, const ivp::Hermitian& method, double end) {
  Peak peak;
  bool found = false;
  const auto look = [&](const ivp::Step& step) {
    if (!(what.sign * step.x0[1] > 0 && what.sign * step.x1[1] <= 0)) return true;
    double before = step.t0, after = step.t1;
    ivp::State x = step.x0;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = before + (after - before) / 2;
      step.dense.at(middle, x);
      (what.sign * x[1] > 0 ? before : after) = middle;
    }
    step.dense.at(after, x);
    peak.t = after;
    peak.x = x[0];
    peak.on_grid = what.sign * std::max(what.sign * step.x0[0], what.sign * step.x1[0]);
    found = true;
    return false;
  };
  const auto solution = ivp::integrate(what.system, what.x0, 0, end, method, look);
  if (found) return peak;
  peak.status =
      solution.status.ok()
          ? Status::failure(Outcome::outside_validity,
                            fmt::format("{}: the velocity does not change its sign before t = {:.6g}; "
                                        "start from another state or parameters",
                                        method.operators.name, end))
          : solution.status;
  return peak;
}

}  // namespace nlmech::chapters::hermitian
