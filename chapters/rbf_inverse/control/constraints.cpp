#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse::constraints {
namespace {

using bvp::DuffingCase;

/// Time history of the force.
struct History {
  std::vector<double> t, f;

  [[nodiscard]] double peak() const {
    double peak = 0;
    for (const double value : f) peak = std::max(peak, std::abs(value));
    return peak;
  }
};
History sampled(const std::function<double(double)>& force) {
  constexpr int samples = 400;
  History h;
  for (int i = 0; i <= samples; ++i) {
    h.t.push_back(inferred * i / samples);
    h.f.push_back(force(h.t.back()));
  }
  return h;
}

/// Extremal for a bound on the force.
struct Bounded {
  std::optional<double> limit;
  bvp::Extremal extremal;
  History control = {};  ///< empty if there is no extremal

  [[nodiscard]] const Status& status() const { return extremal.solution.status; }
  /// Initial value of component i; empty if there is no extremal.
  [[nodiscard]] std::optional<double> first(Eigen::Index i) const {
    return status().ok() ? std::optional(extremal.solution.first()[i]) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> found(double value) const {
    return status().ok() ? std::optional(value) : std::nullopt;
  }
};

/// Extremals without a bound and with three bounds.
std::vector<Bounded> bounded(const bvp::Multistart& found) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed));
  const bvp::Extremal& free = cheapest_of(found);
  std::vector<Bounded> all = {{{}, free, sampled([&](double t) { return -free.solution.at(t)[3]; })}};
  for (const double limit : {15.0, 13.5, 8.0}) {
    const bvp::ConstraintPath path = bvp::control_bound_path(all.front().control.peak(), limit);
    Bounded& b = all.emplace_back(Bounded{limit, tighten(problem, start_from(free.solution), path)});
    if (!b.status().ok()) continue;
    const bvp::ExtremalProblem clipped = with_constraints(problem, path(1));
    b.control = sampled([&](double t) { return control_at(clipped, b.extremal.solution, t)[0]; });
  }
  return all;
}

void put_bounded(const std::vector<Bounded>& all, scene::Show& show) {
  scene::Panel& panel = show.plot("Optimal force: the lower its bound, the longer it stays at the bound",
                                  "time (s)", "force {/:Italic f} (1/s^{2})");
  panel.key("top left").y_range(-20, 28);
  show.figure().size(760, 480).columns({"panel", "curve", "x", "y"});
  for (const Bounded& b : all) {
    if (b.status().ok())
      panel.curve(b.limit ? fmt::format("at most {:g}", *b.limit) : "no bound", b.control.t, b.control.f,
                  scene::lines(b.limit ? 0 : 8));
  }
  show.table(all,
             {{"bound of |f|", &Bounded::limit},
              {"status", [](const Bounded& b) { return to_string(b.status().outcome()); }},
              {"cost", [](const Bounded& b) { return b.found(b.extremal.cost); }, 10},
              {"lambda1(0)", [](const Bounded& b) { return b.first(2); }, 8},
              {"lambda2(0)", [](const Bounded& b) { return b.first(3); }, 8},
              {"miss of the integrated end", [](const Bounded& b) { return b.found(b.extremal.miss); }, 2}});
  const Bounded& at_15 = all[1];
  show.near("peak of the unbounded force", {all[0].control.peak(), "1/s^2"}, 16.409, 1e-3,
            "regression value");
  show.near("cost at 15", at_15.extremal.cost, 122.3004593, 1e-6,
            "regression value, its smoothing 1e-4 as well; steps of 0.01");
  show.near("lambda1(0) at 15", at_15.first(2).value_or(NAN), -21.30021353, 1e-5, "the same");
  show.near("lambda2(0) at 15", at_15.first(3).value_or(NAN), 0.9462278952, 1e-5, "the same");
  show.at_most("largest force at 15", {at_15.control.peak(), "1/s^2"}, 15, "the clip itself");
  show.equals("is a bound of 8 refused?", all[3].status().outcome() == Outcome::infeasible, 1,
              "less energy than the target's comes in: see the text");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result bounds(
      "bounded-force",
      "fixed case, T = 2; the limit is brought down to its value with a wide smoothing, then that to 1e-4",
      bounded, extremals(DuffingCase::fixed));
  return {{.name = "bounded-control",
           .title = "The fixed case under a bound on the force, by continuation",
           .content = scene::Content(put_bounded, bounds)}};
}

}  // namespace nlmech::chapters::rbf_inverse::constraints
