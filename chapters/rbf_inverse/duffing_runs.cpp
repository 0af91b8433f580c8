#include "chapters/rbf_inverse/duffing_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

const bvp::Extremal& best_of(const Extremals& all, DuffingCase which) {
  const bvp::Multistart& found = all.at(static_cast<std::size_t>(which));
  if (found.found.empty())
    throw Failure(fmt::format("case {}: none of {} starts led to an extremal", bvp::to_string(which),
                              found.spurious + found.failed));
  return found.found.front().extremal;
}

std::string time_label(double final_time) { return fmt::format("T = {:g}", final_time); }

namespace {

Extremals find_all(double final_time, bool quick) {
  const bvp::DuffingStarts fewer = {
      .constants = false, .unforced = 6, .pumps = 1, .direct = 3, .random = 1, .driven = 0};
  Extremals all;
  for (const DuffingCase which : bvp::duffing_cases())
    all.push_back(
        bvp::duffing_extremals(printed_settings(which, final_time), quick ? fewer : bvp::DuffingStarts{}));
  return all;
}

Globals solve_all(const Extremals& extremals, double final_time) {
  Globals all;
  for (const DuffingSubject& subject : duffing_subjects()) {
    const bvp::ExtremalProblem problem = duffing_problem(printed_settings(subject.which, final_time));
    const bvp::Start start = start_from(best_of(extremals, subject.which).solution);
    std::vector<bvp::GlobalResult>& row = all.emplace_back();
    for (const GlobalVariant& v : global_variants())
      row.push_back(solve_global(
          problem,
          {.relative_shape = v.relative_shape, .derivative = v.derivative, .rows = printed_rows(problem)},
          start));
  }
  return all;
}

}  // namespace

DuffingRuns add_duffing_runs(scene::Chapter& chapter) {
  DuffingRuns runs{};
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    const double t = final_times[i];
    const auto& extremals = chapter.add_run<Extremals>(
        fmt::format("extremals-T{:g}", t),
        fmt::format("T = {:g}, S = I (neither is stated); eight cases, the program's own starts", t), {},
        [t](Workshop& w) { return find_all(t, w.quick()); });
    runs.extremals[i] = &extremals;
    runs.globals[i] = &chapter.add_run<Globals>(
        fmt::format("one-interval-T{:g}", t),
        fmt::format("T = {:g}, 40 LGL nodes, Newton's iteration from the cheapest extremal; errors against "
                    "the trajectory flown from the own initial values at 1e-13",
                    t),
        {&extremals}, [&extremals, t](Workshop& w) { return solve_all(w.result(extremals), t); });
  }
  return runs;
}

}  // namespace nlmech::chapters
