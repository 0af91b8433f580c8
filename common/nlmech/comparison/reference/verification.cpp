#include "nlmech/comparison/reference/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nlmech::comparison {
namespace {

using Verdict = Verification::Verdict;

/// A run beside its reference.
struct Beside {
  Eigen::MatrixXd error;   ///< |difference|; zero where the run has no state
  Eigen::MatrixXd doubt;   ///< of the reference; zero likewise
  Eigen::MatrixXd weight;  ///< one tolerance
  Eigen::MatrixXd moved;   ///< what the problem makes of one tolerance
  const Verified& run;     ///< what is verified

  /// How far off a component may be.
  [[nodiscard]] Eigen::MatrixXd allowed() const {
    return (most_tolerances * weight).cwiseMax(most_amplified * moved);
  }

  /// Where the error is greatest, compared with @p unit.
  [[nodiscard]] Verification worst(const Eigen::MatrixXd& unit) const {
    Eigen::Index row = 0, column = 0;
    (void)(error.array() / unit.array()).maxCoeff(&row, &column);
    Verification v;
    v.t = run.times[static_cast<std::size_t>(column)];
    v.component = static_cast<int>(row);
    v.error = error(row, column);
    v.doubt = doubt(row, column);
    v.tolerances = v.error / weight(row, column);
    v.growth = moved(row, column) / weight(row, column);
    v.allowed = std::max(most_tolerances, most_amplified * v.growth);
    return v;
  }
  /// Are the run and the reference good enough?
  [[nodiscard]] bool within(const Eigen::MatrixXd& bound) const {
    return (error.array() <= bound.array()).all() && (doubt.array() <= bound.array()).all();
  }
};

Beside beside(const Verified& run, const Reference& reference, Eigen::MatrixXd weight) {
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(run.states.rows(), run.states.cols()), doubt = error;
  for (Eigen::Index k = 0; k < error.cols(); ++k) {
    if (std::isnan(run.states(0, k))) continue;
    error.col(k) =
        (run.states.col(k).cast<long double>() - reference.states.col(k)).cwiseAbs().cast<double>();
    doubt.col(k) = reference.doubt.col(k);
  }
  Eigen::MatrixXd moved = weight;
  return {std::move(error), std::move(doubt), std::move(weight), std::move(moved), run};
}

Verification unknown(std::string reason) {
  Verification v;
  v.reason = std::move(reason);
  return v;
}

/// The verdict once the condition is known.
Verification with_condition(const Beside& all, const Reference& reference, const Eigen::VectorXd& size) {
  const Eigen::MatrixXd bound = all.allowed();
  Verification v = all.worst(bound);
  const double extent = size[v.component] > 0 ? size[v.component] : 1;
  const double allowed = v.allowed * v.error / std::max(v.tolerances, 1e-300);
  const double sure = v.error - v.doubt;  // the reference may be off by its doubt, and the run by less then
  const bool is_amplified =
      v.allowed > most_tolerances;  // else the tolerance is coarse, and no more to blame
  if (v.error >= 0.1 * extent && allowed >= 0.1 * extent && is_amplified) {
    v.verdict = Verdict::undetermined;
  } else if (sure > allowed) {
    v.verdict = Verdict::wrong;
  } else if (all.within(bound)) {
    v.verdict = Verdict::right;
  } else {
    return unknown(
        fmt::format("{}, which is less than the tolerance asks for; the run lies within {:.2g} of them",
                    reference.text(), v.error));
  }
  return v;
}

}  // namespace

Verification verify(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
                    const Reference& reference, const Effort& effort) {
  if (reference.undetermined) {
    Verification v;
    v.verdict = Verdict::undetermined;
    v.t = run.times.back();
    v.growth = 1 / run.tolerance.relative;
    return v;
  }
  if (!reference.status.ok()) {
    Verification v = unknown(reference.text());
    if (reference.ends) v.verdict = Verdict::ended;
    return v;
  }
  const Eigen::VectorXd size = reference.size.cwiseMax(x0.cwiseAbs());
  Beside all = beside(run, reference, weights(system, run.times, reference.states, size, run.tolerance));
  if (all.within(most_tolerances * all.weight)) {
    Verification v = all.worst(all.weight);
    v.verdict = Verdict::right;
    return v;
  }
  const Way way{x0.template cast<long double>(), t0, run.times};
  const Eigen::MatrixXd first = weights(system, {t0}, way.x0, size, run.tolerance);
  const Status status = amplification(way, reference, first.col(0), all.weight, effort.seconds, all.moved);
  if (status.ok()) return with_condition(all, reference, size);
  // Without the condition: no digit right is wrong, whatever the problem makes of errors.
  Verification v = all.worst(size.replicate(1, all.error.cols()).cwiseMax(all.weight));
  const bool no_digit = v.error - v.doubt >= 0.1 * size[v.component] && v.tolerances > most_tolerances;
  if (!no_digit) return unknown("the problem's condition could not be computed: " + status.sentence());
  v.verdict = Verdict::wrong;
  return v;
}

bool agrees(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
            const ivp::NamedIntegrator& other, ivp::Limits limits) {
  std::vector<double> times;
  Eigen::MatrixXd states(x0.size(), run.states.cols());
  StatesAt found(x0.size(), run.states.cols());
  ivp::Solution there{t0, x0, {}, {}};
  for (Eigen::Index k = 0; k < run.states.cols(); ++k) {
    if (std::isnan(run.states(0, k))) continue;
    const auto count = static_cast<Eigen::Index>(times.size());
    times.push_back(run.times[static_cast<std::size_t>(k)]);
    there = other(system, ivp::State(there.x), there.t, times.back(), {}, limits);
    if (!there.status.ok()) return false;
    limits.steps -= there.statistics.steps + there.statistics.rejected;
    limits.seconds -= there.statistics.seconds;
    states.col(count) = run.states.col(k);
    found.col(count) = there.x.template cast<long double>();
  }
  const auto count = static_cast<Eigen::Index>(times.size());
  states.conservativeResize(Eigen::NoChange, count);
  found.conservativeResize(Eigen::NoChange, count);
  const Eigen::MatrixXd theirs = found.template cast<double>();
  const Eigen::VectorXd size = theirs.cwiseAbs().rowwise().maxCoeff().cwiseMax(x0.cwiseAbs());
  const Eigen::MatrixXd weight = weights(system, times, found, size, run.tolerance);
  return ((states - theirs).array().abs() <= most_tolerances * weight.array()).all();
}

}  // namespace nlmech::comparison
