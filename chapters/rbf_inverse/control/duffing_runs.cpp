#include "chapters/rbf_inverse/control/duffing_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <ranges>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {

using bvp::DuffingCase;

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
  if (intervals.empty() || intervals.front().values.cols() != result.integrated.cols()) return {none, none};
  const Eigen::MatrixXd error = (intervals.front().values - result.integrated).cwiseAbs();
  return {error.topRows(2).maxCoeff(), error.bottomRows(2).maxCoeff()};
}

double largest_error(const bvp::GlobalResult& result) {
  const NodeErrors e = node_errors(result);
  return is_extremal(result) ? std::max(e.states, e.costates) : HUGE_VAL;
}

double FromGuesses::least_error() const {
  return largest_error(*std::ranges::min_element(results, {}, largest_error));
}

GuessCounts& GuessCounts::operator+=(const GuessCounts& others) {
  good += others.good;
  cheapest += others.cheapest;
  spurious += others.spurious;
  failed += others.failed;
  return *this;
}

const bvp::Extremal& cheapest_of(const bvp::Multistart& all) {
  if (all.found.empty())
    throw Failure(fmt::format("none of {} starts led to an extremal", all.spurious + all.failed));
  return all.found.front().extremal;
}

std::size_t FromGuesses::chosen() const {
  const auto found = std::ranges::find_if(results, is_extremal);
  if (found == results.end())
    throw Failure(
        fmt::format("the printed method finds an extremal from none of {} guesses", results.size()));
  return static_cast<std::size_t>(found - results.begin());
}

bvp::Start random_guess(int number, double final_time) {
  // The standard defines the numbers of the engine, but not those of std distributions.
  std::mt19937_64 engine(static_cast<std::uint64_t>(number) + 1);
  const auto draw = [&](double size) {
    return size * (2 * static_cast<double>(engine() >> 11) / 9007199254740992.0 - 1);
  };
  if (number % 2 == 1) {
    Eigen::VectorXd constant(4);
    for (double& value : constant) value = draw(5);
    return bvp::constant_start(constant);
  }
  constexpr int nodes = 40;
  const Eigen::VectorXd times = final_time * (collocation::legendre_gauss_lobatto(nodes).array() + 1) / 2;
  Eigen::MatrixXd values(4, nodes);
  for (double& value : values.reshaped()) value = draw(1);
  return {.states = [times, values](double t, Eigen::VectorXd& x) {
    // Linear interpolation between the nodes.
    Eigen::Index k = 0;
    while (k + 2 < times.size() && t > times[k + 1]) ++k;
    const double part = std::clamp((t - times[k]) / (times[k + 1] - times[k]), 0.0, 1.0);
    x = (1 - part) * values.col(k) + part * values.col(k + 1);
  }};
}

std::string guess_name(std::size_t guess) {
  return guess == 0 ? "zeros" : fmt::format("random guess {}", guess);
}

GuessCounts FromGuesses::counts() const {
  const double cheapest = known_extremal(subject->which, final_time).cost;
  GuessCounts counts;
  for (const bvp::GlobalResult& r : results) {
    if (!is_extremal(r))
      ++(r.extremal.solution.status.outcome() == Outcome::spurious_root ? counts.spurious : counts.failed);
    else if (++counts.good; r.extremal.cost <= 1.01 * cheapest)
      ++counts.cheapest;
  }
  return counts;
}

std::vector<const bvp::Extremal*> FromGuesses::distinct() const {
  std::vector<const bvp::Extremal*> some;
  for (const bvp::GlobalResult& r : results) {
    const bvp::Extremal& e = r.extremal;
    // Roots for the same extremal differ by numerical errors, below a hundredth in the cost.
    const auto same = [&](const bvp::Extremal* other) {
      return std::abs(other->cost - e.cost) <= 1e-2 * std::abs(e.cost);
    };
    if (is_extremal(r) && std::ranges::none_of(some, same)) some.push_back(&e);
  }
  std::ranges::sort(some, {}, &bvp::Extremal::cost);
  return some;
}

namespace {

bvp::Multistart find_all(DuffingCase which, double final_time, bool quick) {
  const bvp::DuffingStarts fewer = {
      .constants = false, .unforced = 6, .pumps = 1, .direct = 3, .random = 1, .driven = 0};
  return bvp::duffing_extremals(printed_settings(which, final_time), quick ? fewer : bvp::DuffingStarts{});
}

/// Number of guesses per case: zeros, then ten random guesses.
constexpr int guesses_a_case = 11;

/// Solves the full equations without elimination, because the scenes show their rounding.
FromGuesses solve_from_guesses(const DuffingSubject& subject, double final_time) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(subject.which, final_time));
  const bvp::GlobalMethod method{.rows = printed_rows(problem)};
  FromGuesses all{&subject, final_time, {}};
  for (int k = 0; k < guesses_a_case; ++k) {
    bvp::GlobalResult& r = all.results.emplace_back(solve_global(
        problem, method,
        k == 0 ? bvp::constant_start(Eigen::VectorXd::Zero(4)) : random_guess(k - 1, final_time)));
    if (is_extremal(r)) r.extremal.second_order = second_order(problem, r.extremal.solution);
  }
  return all;
}

std::vector<bvp::GlobalResult> solve_variants(const FromGuesses& printed) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(printed.subject->which));
  std::vector<bvp::GlobalResult> all = {printed.drawn()};
  for (const GlobalVariant& variant : global_variants() | std::views::drop(1)) {
    all.push_back(solve_global(problem,
                               {.relative_shape = variant.relative_shape,
                                .derivative = variant.derivative,
                                .rows = printed_rows(problem)},
                               start_from(all.front().extremal.solution)));
  }
  return all;
}

}  // namespace

scene::Result<bvp::Multistart> extremals(DuffingCase which, double final_time) {
  return {fmt::format("extremals-{}-T{:g}", to_string(which), final_time),
          fmt::format("T = {:g}, S = I (neither is stated); the program's own starts", final_time),
          [which, final_time](bool quick) { return find_all(which, final_time, quick); }};
}

scene::Result<FromGuesses> printed_results(const DuffingSubject& subject, double final_time) {
  return {fmt::format("printed-{}-T{:g}", to_string(subject.which), final_time),
          fmt::format("T = {:g}, S = I; 40 LGL nodes, Newton's iteration from zeros and ten random guesses "
                      "(independent at the nodes in +-1, or constant in +-5), 60 iterations at most; errors "
                      "against the trajectory integrated from the same initial values at 1e-13",
                      final_time),
          [&subject, final_time] { return solve_from_guesses(subject, final_time); }};
}

std::vector<scene::Result<FromGuesses>> all_printed_results() {
  std::vector<scene::Result<FromGuesses>> all;
  for (const double t : final_times)
    for (const DuffingSubject& subject : duffing_subjects()) all.push_back(printed_results(subject, t));
  return all;
}

scene::Result<std::vector<bvp::GlobalResult>> variants(const DuffingSubject& subject) {
  return {fmt::format("variants-{}", to_string(subject.which)),
          "T = 2: other derivative matrices on the same nodes, started from the root that is drawn",
          solve_variants, printed_results(subject)};
}

}  // namespace nlmech::chapters::rbf_inverse
