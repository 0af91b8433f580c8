#include "chapters/rbf_inverse/duffing_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "chapters/rbf_inverse/random_guess.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {

using bvp::DuffingCase;
using scene::Workshop;

const std::vector<DuffingSubject>& duffing_subjects() {
  static const std::vector<DuffingSubject> all = {
      {DuffingCase::free, "Free final state", "final state free", 1},
      {DuffingCase::fixed, "Fixed final state", "final state given", 4},
      {DuffingCase::x1x1, "Prescribed initial and final position", "positions given at both ends", 7},
      {DuffingCase::x1x2, "Prescribed initial position and final velocity",
       "initial position and final velocity given", 10},
      {DuffingCase::x2x1, "Prescribed initial velocity and final position",
       "initial velocity and final position given", 13},
      {DuffingCase::harmonic, "Harmonic steady state", "harmonic motion prescribed", 16}};
  return all;
}

bvp::DuffingSettings printed_settings(DuffingCase which, double final_time) {
  return {.which = which, .final_time = final_time, .beta = bvp::printed_beta(which)};
}

const std::vector<GlobalVariant>& global_variants() {
  static const std::vector<GlobalVariant> all = {
      {"Gaussian, c T = 9.75 (printed)", bvp::DerivativeMatrix::gaussian, 9.75},
      {"Gaussian, c T = 7.5", bvp::DerivativeMatrix::gaussian, 7.5},
      {"stable Gaussian, c T = 9.75", bvp::DerivativeMatrix::stable_gaussian, 9.75},
      {"polynomial", bvp::DerivativeMatrix::polynomial, 9.75}};
  return all;
}

bvp::GlobalMethod printed_method(const bvp::ExtremalProblem& problem, bvp::DerivativeMatrix derivative) {
  return {.derivative = derivative, .rows = printed_rows(problem), .condensed = {{0, 1}, {3, 2}}};
}

NodeErrors node_errors(const bvp::GlobalResult& result) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto& intervals = result.extremal.solution.unknowns.intervals;
  if (intervals.empty() || intervals.front().values.cols() != result.flown.cols()) return {none, none};
  const Eigen::MatrixXd error = (intervals.front().values - result.flown).cwiseAbs();
  return {error.topRows(2).maxCoeff(), error.bottomRows(2).maxCoeff()};
}

const bvp::Multistart& extremals_of(const DuffingRuns& runs, Workshop& workshop, DuffingCase which,
                                    std::size_t time) {
  return workshop.result(run_of(runs.extremals, which, time));
}

const bvp::Extremal& best_of(const DuffingRuns& runs, Workshop& workshop, DuffingCase which,
                             std::size_t time) {
  const bvp::Multistart& found = extremals_of(runs, workshop, which, time);
  if (found.found.empty())
    throw Failure(fmt::format("case {}: none of {} starts led to an extremal", bvp::to_string(which),
                              found.spurious + found.failed));
  return found.found.front().extremal;
}

std::size_t drawn_of(const FromGuesses& all) {
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].extremal.solution.status.ok()) return k;
  throw Failure(fmt::format("the printed method finds an extremal from none of {} guesses", all.size()));
}

std::string guess_name(std::size_t guess) {
  return guess == 0 ? "zeros" : fmt::format("random guess {}", guess);
}

GuessCounts count_of(const FromGuesses& all, double cheapest) {
  GuessCounts counts;
  for (const bvp::GlobalResult& r : all) {
    const bvp::Extremal& e = r.extremal;
    if (e.solution.status.ok()) {
      ++counts.good;
      if (e.cost <= 1.01 * cheapest) ++counts.cheapest;
    }
    if (e.solution.status.outcome() == Outcome::spurious_root) ++counts.spurious;
  }
  return counts;
}

std::vector<const bvp::Extremal*> distinct_of(const FromGuesses& all) {
  std::vector<const bvp::Extremal*> some;
  for (const bvp::GlobalResult& r : all) {
    const bvp::Extremal& e = r.extremal;
    // Roots of one extremal differ by their errors, below a hundredth in the cost.
    const auto same = [&](const bvp::Extremal* other) {
      return std::abs(other->cost - e.cost) <= 1e-2 * std::abs(e.cost);
    };
    if (e.solution.status.ok() && std::none_of(some.begin(), some.end(), same)) some.push_back(&e);
  }
  std::sort(some.begin(), some.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
  return some;
}

std::string time_label(double final_time) { return fmt::format("T = {:g}", final_time); }

namespace {

bvp::Multistart find_all(DuffingCase which, double final_time, bool quick) {
  const bvp::DuffingStarts fewer = {
      .constants = false, .unforced = 6, .pumps = 1, .direct = 3, .random = 1, .driven = 0};
  return bvp::duffing_extremals(printed_settings(which, final_time), quick ? fewer : bvp::DuffingStarts{});
}

/// The equations as they stand, none eliminated: rounding belongs to what is shown.
FromGuesses solve_from_guesses(DuffingCase which, double final_time) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(which, final_time));
  const bvp::GlobalMethod method{.rows = printed_rows(problem)};
  FromGuesses all;
  for (int k = 0; k < guesses_a_case; ++k) {
    bvp::GlobalResult& r = all.emplace_back(solve_global(
        problem, method,
        k == 0 ? bvp::constant_start(Eigen::VectorXd::Zero(4)) : random_guess(k - 1, final_time)));
    if (r.extremal.solution.status.ok()) r.extremal.second_order = second_order(problem, r.extremal.solution);
  }
  return all;
}

FromGuesses solve_variants(DuffingCase which, double final_time, const bvp::GlobalResult& drawn) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(which, final_time));
  FromGuesses all = {drawn};
  for (std::size_t v = 1; v < global_variants().size(); ++v) {
    const GlobalVariant& variant = global_variants()[v];
    all.push_back(solve_global(problem,
                               {.relative_shape = variant.relative_shape,
                                .derivative = variant.derivative,
                                .rows = printed_rows(problem)},
                               start_from(drawn.extremal.solution)));
  }
  return all;
}

}  // namespace

DuffingRuns add_duffing_runs(scene::Chapter& chapter) {
  DuffingRuns runs{};
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    const double t = final_times[i];
    for (const DuffingCase which : bvp::duffing_cases()) {
      const auto c = static_cast<std::size_t>(which);
      runs.extremals[i][c] = &chapter.add_run<bvp::Multistart>(
          fmt::format("extremals-{}-T{:g}", to_string(which), t),
          fmt::format("T = {:g}, S = I (neither is stated); the program's own starts", t), {},
          [which, t](Workshop& w) { return find_all(which, t, w.quick()); });
    }
    for (const DuffingSubject& subject : duffing_subjects()) {
      runs.printed[i][static_cast<std::size_t>(subject.which)] = &chapter.add_run<FromGuesses>(
          fmt::format("printed-{}-T{:g}", to_string(subject.which), t),
          fmt::format("T = {:g}, S = I; 40 LGL nodes, Newton's iteration from zeros and ten random guesses "
                      "(independent at the nodes in +-1, or constant in +-5), 60 iterations at most; errors "
                      "against the trajectory flown from the own initial values at 1e-13",
                      t),
          {}, [which = subject.which, t](Workshop&) { return solve_from_guesses(which, t); });
    }
  }
  for (const DuffingSubject& subject : duffing_subjects()) {
    const auto& printed = run_of(runs.printed, subject.which);
    runs.variants[static_cast<std::size_t>(subject.which)] = &chapter.add_run<FromGuesses>(
        fmt::format("variants-{}", to_string(subject.which)),
        "T = 2: other derivative matrices on the same nodes, begun at the root that is drawn", {&printed},
        [&printed, which = subject.which](Workshop& w) {
          const FromGuesses& all = w.result(printed);
          return solve_variants(which, final_times[inferred], all[drawn_of(all)]);
        });
  }
  return runs;
}

}  // namespace nlmech::chapters
