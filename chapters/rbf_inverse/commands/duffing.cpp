#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "nlmech/bvp/optimal_control/duffing.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

struct DuffingOptions {
  bvp::DuffingSettings settings;
  std::string which;
  std::vector<double> target, weights;
  std::optional<double> bound;  ///< bound of |f|
};

void declare(scene::Options& options, DuffingOptions& typed) {
  std::vector<std::string> cases;
  for (const bvp::DuffingCase which : bvp::duffing_cases()) cases.emplace_back(to_string(which));
  typed.settings.beta = 0.9;
  options
      .add("--case", typed.which, "states prescribed at the ends; harmonic: amplitudes 1.5, 2, 3 at 3 rad/s")
      .one_of(cases)
      .required();
  options.add("--final-time", typed.settings.final_time, "T, seconds").range(1e-6, 1000).required();
  options.add("--beta", typed.settings.beta, "nonlinearity").range(0, 1e6);
  options.add("--target", typed.target, "x1,x2 at T (default 5,2)").range(-1e4, 1e4);
  options.add("--weights", typed.weights,
              "weights s11,s22, 0 or more, of the miss of states that are not prescribed (default 1,1)");
  options.add("--bound", typed.bound, "largest |f| (default: no bound)").positive();
}

Eigen::Vector2d pair(const char* option, const std::vector<double>& typed) {
  if (typed.size() != 2)
    throw InputError(
        fmt::format("{} {}: needs two finite numbers, separated by a comma", option, fmt::join(typed, ",")));
  return {typed[0], typed[1]};
}

bvp::DuffingSettings understand(const DuffingOptions& typed) {
  using enum bvp::DuffingCase;
  bvp::DuffingSettings s = typed.settings;
  for (const bvp::DuffingCase which : bvp::duffing_cases()) {
    if (to_string(which) == typed.which) s.which = which;
  }
  if (!typed.target.empty()) {
    s.target = pair("--target", typed.target);
    if (s.which == harmonic)
      throw InputError(
          fmt::format("--target {}: --case harmonic takes its target from Eq. 5.34; leave it out",
                      fmt::join(typed.target, ",")));
  }
  if (!typed.weights.empty()) {
    s.weights = pair("--weights", typed.weights);
    const auto refuse = [&](const std::string& why) {
      throw InputError(fmt::format("--weights {}: {}", fmt::join(typed.weights, ","), why));
    };
    if (s.which == fixed || s.which == harmonic || s.which == final_only)
      refuse(fmt::format(
          "--case {} prescribes both states at the end, so there is no miss to weight; leave it out",
          typed.which));
    if (s.weights.minCoeff() < 0) refuse("must not be negative");
  }
  return s;
}

/// Time limit of the solves; with the starts and the last solve at most two minutes.
constexpr double seconds_of_solves = 60;

/// Extremals from the automatic starts, at least one.
std::vector<bvp::Found> unbounded(const bvp::DuffingSettings& settings) {
  const bvp::Multistart all = bvp::duffing_extremals(settings, {}, {}, {.seconds = seconds_of_solves});
  if (all.found.empty())
    throw Failure(Status::failure(
        Outcome::not_converged,
        fmt::format("duffing: none of {} starts led to an extremal that an integrator confirms ({} spurious "
                    "roots); try another final time or a smaller beta",
                    all.good + all.spurious + all.failed, all.spurious)));
  return all.found;
}

/// Power of two as unit in which the bound is 8 to 16, because the smoothing of a bounded control is 1e-4 in
/// every unit.
double unit_of(double bound) { return std::ldexp(1.0, std::ilogb(bound) - 3); }

/// The same task with states and forces in this unit; scaling by powers of two is exact.
bvp::DuffingSettings in_units(bvp::DuffingSettings s, double unit) {
  s.begin /= unit;
  s.target /= unit;
  s.amplitudes /= unit;
  s.beta *= unit * unit;
  return s;
}

/// Extremal of least cost with the bound, from the three of least cost without it.
bvp::Extremal bounded(const bvp::DuffingSettings& settings, double bound) {
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  std::optional<bvp::Extremal> best;
  Status failure;
  for (const bvp::Found& found : unbounded(settings) | std::views::take(3)) {
    const bvp::Extremal& free = found.extremal;
    double peak = 0;
    constexpr int samples = 1000;
    for (int i = 0; i <= samples; ++i)
      peak = std::max(peak, std::abs(free.solution.at(settings.final_time * i / samples)[3]));
    // The bound is inactive, with a margin for the peak between samples.
    bvp::Extremal e = peak < 0.99 * bound
                          ? free
                          : tighten(problem, start_from(free.solution), bvp::control_bound_path(peak, bound));
    if (!e.solution.status.ok()) {
      if (failure.ok()) failure = e.solution.status;
    } else if (!best || e.cost < best->cost) {
      best = std::move(e);
    }
  }
  if (!best) throw Failure(failure);
  return *best;
}

std::string duffing(const DuffingOptions& typed) {
  const bvp::DuffingSettings settings = understand(typed);
  const double unit = typed.bound ? unit_of(*typed.bound) : 1;
  const bvp::Extremal e = typed.bound ? bounded(in_units(settings, unit), *typed.bound / unit)
                                      : unbounded(settings).front().extremal;
  const Eigen::VectorXd first = e.solution.first() * unit, last = e.solution.last() * unit;
  // Prescribed and zero values have the rounding error of the solve.
  const auto shown = [](double value) { return std::abs(value) < 1e-20 ? 0.0 : value; };
  return fmt::format(
      "cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss\n"
      "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
      shown(e.cost * unit * unit), shown(first[0]), shown(first[1]), shown(first[2]), shown(first[3]),
      shown(last[0]), shown(last[1]), e.miss * unit);
}

}  // namespace

void add_duffing_command(scene::Commands& all) {
  all.add("duffing",
          "Find the force of least cost that drives a Duffing oscillator to its final state; prints as CSV "
          "cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss; omega_n = 1, start 0,0 where prescribed",
          declare, duffing);
}

}  // namespace nlmech::chapters::rbf_inverse
