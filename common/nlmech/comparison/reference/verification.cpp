#include "nlmech/comparison/reference/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

constexpr int rounding = 16;  // units of eps: the square root of a few hundred steps

/// Weights of the components at several times: absolute + relative |x|, plus the rounding of x and of the
/// time.
/// @param size greatest |x_i| of the solution
Eigen::MatrixXd weights(const ivp::System& system, const std::vector<double>& times, const StatesAt& states,
                        const Eigen::VectorXd& size, const Tolerance& tolerance) {
  Eigen::MatrixXd all(states.rows(), states.cols());
  ivp::State f(states.rows());
  for (Eigen::Index k = 0; k < states.cols(); ++k) {
    const double t = times[static_cast<std::size_t>(k)];
    const ivp::State x = states.col(k).cast<double>();
    system.rhs(t, x, f);
    all.col(k) = tolerance.absolute + tolerance.relative * x.array().abs() + rounding * eps * size.array() +
                 2 * eps * (t * f.array()).abs();
  }
  return all;
}

/// d x(t1) / d x(t0) along the reference by central differences with the step @p by. One-sided differences
/// are too inaccurate, because the errors of these matrices multiply in their products.
Status derivative(const Candidate& run, const ExtendedState& x, double t0, double t1,
                  const Eigen::VectorXd& by, const std::function<double()>& seconds, Eigen::MatrixXd& d) {
  d.resize(x.size(), x.size());
  StatesAt ends[2];
  ReferenceRequest request{x, t0, {t1}};
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    long double begins[2];
    for (const int side : {0, 1}) {
      // Rounded to double, for methods in double precision.
      begins[side] = static_cast<double>(side == 0 ? x[j] - by[j] : x[j] + by[j]);
      request.x0[j] = begins[side];
      if (Status s = run.compute(request, seconds(), ends[side]); !s.ok()) return s;
    }
    request.x0[j] = x[j];
    d.col(j) = ((ends[1].col(0) - ends[0].col(0)) / (begins[1] - begins[0])).cast<double>();
  }
  return {};
}

using Verdict = Verification::Verdict;

/// Errors of a run against its reference.
struct Comparison {
  /// @param one weights, see weights() @param relative_to scales of digits, see scales()
  Comparison(const Verified& r, const Reference& reference, Eigen::MatrixXd one, Eigen::MatrixXd relative_to)
      : run(r),
        scale(std::move(relative_to)),
        error(Eigen::MatrixXd::Zero(r.states.rows(), r.states.cols())),
        uncertainty(error),
        weight(std::move(one)),
        moved(weight) {
    for (Eigen::Index k = 0; k < error.cols(); ++k) {
      if (std::isnan(run.states(0, k))) continue;
      error.col(k) =
          (run.states.col(k).cast<long double>() - reference.states.col(k)).cwiseAbs().cast<double>();
      uncertainty.col(k) = reference.difference.col(k);
    }
  }

  const Verified& run;
  Eigen::MatrixXd scale;        ///< scale of the digits
  Eigen::MatrixXd error;        ///< |difference|; zero where the run has no state
  Eigen::MatrixXd uncertainty;  ///< uncertainty of the reference; zero where the run has no state
  Eigen::MatrixXd weight;       ///< one tolerance
  Eigen::MatrixXd moved;        ///< effect of one earlier error of one tolerance, see amplification()

  /// Verification at the greatest ratio of error to @p unit.
  [[nodiscard]] Verification worst(Verdict verdict, const Eigen::MatrixXd& unit) const {
    Eigen::Index row = 0, column = 0;
    (void)(error.array() / unit.array()).maxCoeff(&row, &column);
    return at(verdict, row, column);
  }
  /// The place at which the uncertainty is the greatest share of @p bound.
  [[nodiscard]] Verification least_known(const Eigen::MatrixXd& bound) const {
    Eigen::Index row = 0, column = 0;
    (void)(uncertainty.array() / bound.array()).maxCoeff(&row, &column);
    return at(Verdict::unknown, row, column);
  }
  /// Verification at the fewest digits, of the places where the error may exceed most_tolerances.
  [[nodiscard]] Verification fewest_digits() const {
    const Eigen::ArrayXXd most = (error + uncertainty).array();
    const auto counts = (most > most_tolerances * weight.array()).cast<double>();
    Eigen::Index row = 0, column = 0;
    (void)(counts * most / scale.array()).maxCoeff(&row, &column);
    return at(Verdict::inexact, row, column);
  }
  /// Are error and uncertainty within @p bound?
  [[nodiscard]] bool within(const Eigen::MatrixXd& bound) const {
    return (error.array() <= bound.array()).all() && (uncertainty.array() <= bound.array()).all();
  }
  /// Does the error exceed most_tolerances by more than the uncertainty?
  [[nodiscard]] bool certainly_beyond() const {
    return ((error - uncertainty).array() > most_tolerances * weight.array()).any();
  }

 private:
  [[nodiscard]] Verification at(Verdict verdict, Eigen::Index row, Eigen::Index column) const {
    const double one = weight(row, column), growth = moved(row, column) / one;
    return {.verdict = verdict,
            .t = run.times[static_cast<std::size_t>(column)],
            .component = static_cast<int>(row),
            .error = error(row, column),
            .uncertainty = uncertainty(row, column),
            .tolerances = error(row, column) / one,
            .allowed = std::max(most_tolerances, most_amplified * growth),
            .growth = growth,
            .digits = -std::log10((error(row, column) + uncertainty(row, column)) / scale(row, column))};
  }
};

/// Scales of the digits: see Verification::digits.
Eigen::MatrixXd scales(const StatesAt& states, const Eigen::VectorXd& size, const Tolerance& tolerance) {
  Eigen::MatrixXd all(states.rows(), states.cols());
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    for (Eigen::Index k = 0; k < all.cols(); ++k) {
      const auto x = static_cast<double>(std::abs(states(i, k)));
      all(i, k) = size[i] <= tolerance.absolute ? tolerance.absolute / tolerance.relative
                  : x >= 1e-3 * size[i]         ? x
                                                : size[i];
    }
  }
  return all;
}

/// Verdict on a run with fewer than required_digits(), or with a reference that may be too inaccurate.
Verification with_condition(const Comparison& all, const Reference& reference, const Eigen::VectorXd& size,
                            double required) {
  const Eigen::MatrixXd bound = (most_tolerances * all.weight).cwiseMax(most_amplified * all.moved);
  Verification v = all.worst(Verdict::wrong, bound);
  const double extent = size[v.component] > 0 ? size[v.component] : 1;
  const double allowed = v.allowed * v.error / std::max(v.tolerances, 1e-300);
  const double least_error = v.error - v.uncertainty;     // lower bound of the error
  const bool is_amplified = v.allowed > most_tolerances;  // otherwise only the tolerance is coarse
  if (v.error >= 0.1 * extent && allowed >= 0.1 * extent && is_amplified) {
    v.verdict = Verdict::undetermined;
    return v;
  }
  if (least_error > allowed) return v;
  if (all.within(bound)) {
    Verification found = all.fewest_digits();
    if (found.digits < required) found.verdict = Verdict::undetermined;
    return found;
  }
  const Verification least = all.least_known(bound);
  return {.reason = fmt::format(
              "{} and {}, the two references that agree best, differ by {:.2g} at t = {:.9g}, too much to "
              "decide whether the run meets its tolerance; the run differs from them by at most {:.2g}",
              reference.first.name, reference.second.name, least.uncertainty, least.t, v.error)};
}

/// Digits to one decimal.
double rounded_down(double digits) { return std::floor(10 * std::max(digits, 0.0)) / 10; }

/// "take --tolerance 1e-12 or another method", with a tolerance that should suffice if there is one.
std::string advice(const Verification& found, double tolerance) {
  const double excess = std::max(1.0, found.tolerances / found.allowed);
  const double smaller = std::pow(10, std::floor(std::log10(tolerance / excess / 3)));
  return smaller >= 1e-13 ? fmt::format("take --tolerance {:.0e} or another method", smaller)
                          : "take another method";
}

}  // namespace

Tolerance tolerance_of(const ivp::Settings& settings) {
  const double relative = settings.tolerance.value_or(ivp::default_tolerance);
  return {relative, settings.absolute_tolerance.value_or(relative)};
}

double required_digits(double tolerance) { return std::max(3.0, -std::log10(tolerance) / 2); }

Status amplification(const ReferenceRequest& request, const Reference& reference,
                     const Eigen::VectorXd& first_weight, const Eigen::MatrixXd& weight, double seconds,
                     Eigen::MatrixXd& moved) {
  const Stopwatch watch;
  const std::function<double()> left = [&] { return seconds - watch.seconds(); };
  // Relative perturbation: far above the errors of the reference, small against the solution.
  const double share = reference.first.extended ? 1e-7 : 1e-6;
  const Eigen::VectorXd size = reference.size.cwiseMax(request.x0.cwiseAbs().cast<double>());
  std::vector<Eigen::MatrixXd> made;  // effects of the errors of each earlier time
  moved = weight;
  Eigen::VectorXd w = first_weight;
  ExtendedState x = request.x0;
  double t = request.t0;
  Eigen::MatrixXd d;
  for (std::size_t k = 0; k < request.times.size(); ++k) {
    Eigen::VectorXd by = share * x.cwiseAbs().cast<double>().cwiseMax(1e-3 * size);
    for (Eigen::Index i = 0; i < by.size(); ++i) {
      if (!(by[i] > 0)) by[i] = share;  // the component is always zero
    }
    if (Status s = derivative(reference.first, x, t, request.times[k], by, left, d); !s.ok()) return s;
    for (Eigen::MatrixXd& error : made) error = (d * error).eval();
    made.emplace_back(d * w.asDiagonal());
    const auto column = static_cast<Eigen::Index>(k);
    for (const Eigen::MatrixXd& error : made)
      moved.col(column) = moved.col(column).cwiseMax(error.cwiseAbs().rowwise().sum());
    t = request.times[k];
    x = reference.states.col(column);
    w = weight.col(column);
  }
  return {};
}

Verification verify(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
                    const Reference& reference, const WorkLimit& effort) {
  if (reference.undetermined)
    return {.verdict = Verdict::undetermined, .t = run.times.back(), .growth = 1 / run.tolerance.relative};
  if (!reference.status.ok())
    return {.verdict = reference.ends ? Verdict::ended : Verdict::unknown, .reason = reference.text()};
  const Eigen::VectorXd size = reference.size.cwiseMax(x0.cwiseAbs());
  Comparison all(run, reference, weights(system, run.times, reference.states, size, run.tolerance),
                 scales(reference.states, size, run.tolerance));
  if (all.within(most_tolerances * all.weight)) return all.worst(Verdict::right, all.weight);
  const ReferenceRequest request{x0.cast<long double>(), t0, run.times};
  const Eigen::MatrixXd first = weights(system, {t0}, request.x0, size, run.tolerance);
  const Status status =
      amplification(request, reference, first.col(0), all.weight, effort.seconds, all.moved);
  if (!status.ok()) all.moved.setZero();
  if (all.certainly_beyond()) {
    Verification v = all.fewest_digits();
    if (v.digits >= required_digits(run.tolerance.relative)) return v;
    if (!status.ok()) return all.worst(Verdict::wrong, all.weight);
  }
  if (status.ok()) return with_condition(all, reference, size, required_digits(run.tolerance.relative));
  return {.reason = "the problem's condition could not be computed: " + status.sentence()};
}

bool agrees(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
            const ivp::NamedIntegrator& other, const ivp::Limits& limits, const ivp::Observer& observer) {
  ReferenceRequest request{x0.cast<long double>(), t0, {}};
  Eigen::MatrixXd states(x0.size(), 0);
  for (Eigen::Index k = 0; k < run.states.cols(); ++k) {
    if (std::isnan(run.states(0, k))) continue;
    request.times.push_back(run.times[static_cast<std::size_t>(k)]);
    states.conservativeResize(Eigen::NoChange, states.cols() + 1);
    states.rightCols(1) = run.states.col(k);
  }
  StatesAt found;
  if (!states_by(other, system, request, observer, limits, found).ok()) return false;
  const Eigen::MatrixXd other_states = found.cast<double>();
  const Eigen::VectorXd size = other_states.cwiseAbs().rowwise().maxCoeff().cwiseMax(x0.cwiseAbs());
  const Eigen::MatrixXd weight = weights(system, request.times, found, size, run.tolerance);
  return ((states - other_states).array().abs() <= most_tolerances * weight.array()).all();
}

std::string remark(const Verification& found, const Reference& reference, const ivp::MethodInfo& method,
                   const ivp::Settings& settings, const std::vector<std::string>& names, double t1) {
  if (found.verdict == Verdict::unknown) return "not verified: " + found.reason;
  const double tolerance = tolerance_of(settings).relative;
  if (found.verdict == Verdict::ended)
    throw Failure(failed_with(Outcome::step_underflow,
                              "{}: the solution seems to end before the final time, and this run at the "
                              "tolerance {:.6g} to have stepped across that point: {}; take an earlier end "
                              "or a smaller tolerance (--no-verify prints the unverified run)",
                              method.name, tolerance, found.reason));
  const std::string& name = names.at(static_cast<std::size_t>(found.component));
  const std::string place = fmt::format("{} at t = {:.9g}", name, found.t);
  if (found.verdict == Verdict::undetermined)
    throw Failure(failed_with(
        Outcome::outside_validity,
        "{}: {} of {} certain, where {:.1f} are required: up to there the problem multiplies an error of the "
        "tolerance {:.6g} by {:.2g}; take a smaller tolerance or an earlier end (--no-verify prints the "
        "unverified run)",
        method.name,
        found.digits >= 0.1 ? fmt::format("{:.1f} digits", rounded_down(found.digits)) : "no digit",
        place + (found.digits >= 0.1 ? " are" : " is"), required_digits(tolerance), tolerance, found.growth));
  if (found.verdict == Verdict::wrong)
    throw Failure(failed_with(Outcome::not_converged,
                              "{}: verified by integration, {} is off by {:.2g}: {:.3g} times the tolerance "
                              "{:.6g}, where the number of steps and the problem's condition explain {:.3g}; "
                              "fewer than {:.1f} digits are correct; "
                              "the tolerance {}: {} (--no-verify prints the unverified run; reference: {})",
                              method.name, place, found.error, found.tolerances, tolerance, found.allowed,
                              required_digits(tolerance), tolerance_meaning, advice(found, tolerance),
                              reference.text()));
  if (found.verdict == Verdict::right) return "";
  const std::string growth =
      found.growth > 0 ? fmt::format("; the problem multiplies errors by up to {:.3g}", found.growth) : "";
  return fmt::format("verified: {:.1f} digits at {}; {} is off by {:.2g} there, {:.3g} tolerances{}",
                     rounded_down(found.digits),
                     found.t == t1 ? "the end" : fmt::format("t = {:.9g}", found.t), name, found.error,
                     found.tolerances, growth);
}

}  // namespace nlmech::comparison
