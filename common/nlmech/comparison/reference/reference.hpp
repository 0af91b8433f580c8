/// @file
/// References for the verification of runs: states of a solution from two independent computations, whose
/// difference is the uncertainty.
///
/// Two Taylor series of different order in extended precision are used if they reach the end within bounded
/// work. Otherwise, for stiff and for long problems, nlmech methods and peers run at tolerances far below the
/// requested ones until two of them agree.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/ivp/domain.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// States in extended precision, one column per time.
using StatesAt = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A relative and an absolute tolerance of a run, or the requested accuracy absolute + relative |x| of a
/// component x of a reference, with |x| at least a thousandth of the component's greatest value. A less
/// accurate reference is returned, too; see Reference::difference.
struct Tolerance {
  double relative = 1e-13;  ///< positive
  double absolute = 1e-13;  ///< positive

  /// Both tolerances divided by @p times.
  [[nodiscard]] Tolerance operator/(double times) const { return {relative / times, absolute / times}; }
};

/// Bounds on the work for a reference.
struct WorkLimit {
  /// Scale of the numbers of steps, so that a result does not depend on the speed of the machine: 1 is about
  /// a second.
  double work = 1;
  double seconds = std::numeric_limits<double>::infinity();  ///< further limit, of the wall time
  /// Greatest step size of each computation.
  double largest_step = std::numeric_limits<double>::infinity();
  std::vector<ivp::Event> changes = {};            ///< events that change the state of the verified run
  std::shared_ptr<const ivp::Domain> domain = {};  ///< domain of the equations; may be null
  std::function<bool()> continues = {};            ///< called after each step; false ends it; may be empty

  /// Observer that calls `continues`; empty without one.
  [[nodiscard]] ivp::Observer observer() const {
    if (!continues) return {};
    return [this](const ivp::Step& /*step*/) { return continues(); };
  }
};

/// Greatest step size of reference computations from @p t0 to @p t1: that of the verified run, but at most
/// 1/128 of the interval, so that no pulse of a few such lengths is stepped over after a long rest.
[[nodiscard]] inline double reference_step_limit(double t0, double t1, double largest_step) {
  return std::min(largest_step, std::abs(t1 - t0) / 128);
}

/// Step budget that ends slow computations early. A computation continues while, from a twentieth of its
/// steps on, it has covered at least 1/20 of the interval that uniform progress would have covered.
class StepBudget {
 public:
  /// @param most number of steps allowed from t0 to t1 @param continues see WorkLimit
  StepBudget(double t0, double t1, double most, std::function<bool()> continues)
      : t0_(t0), way_(t1 - t0), most_(most), continues_(std::move(continues)) {}
  /// Counts a step to @p t; false if the computation is too slow or must end.
  [[nodiscard]] bool suffices(double t) {
    if (continues_ && !continues_()) return false;
    ++steps_;
    return steps_ < most_ / 20 || 20 * std::abs(t - t0_) >= std::abs(way_) * steps_ / most_;
  }

 private:
  double t0_, way_, most_, steps_ = 0;
  std::function<bool()> continues_;
};

/// A state in extended precision.
using ExtendedState = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// Initial state and output times of a reference.
struct ReferenceRequest {
  ExtendedState x0;           ///< initial state
  double t0 = 0;              ///< initial time
  std::vector<double> times;  ///< output times, strictly monotonic from t0; the last is the end
};

/// A computation that can yield the states of a reference.
struct Candidate {
  std::string name;       ///< "adaptive-collocation"
  bool extended = false;  ///< works in extended precision; if it fails, no other such one is tried
  /// Computes the states at the output times within a wall time in seconds.
  std::function<Status(const ReferenceRequest&, double seconds, StatesAt&)> compute;
};

/// Reference states of a solution with their uncertainty.
struct Reference {
  Status status;               ///< success, or why there is no reference
  bool undetermined = false;   ///< failure: two computations in extended precision disagree, because rounding
                               ///< errors grow to the size of the solution
  bool ends = false;           ///< failure: the solution seems to end before t1; the step sizes of two
                               ///< computations, one of them in extended precision, shrink to zero
  Candidate first;             ///< of the two computations that agree best: the one that gives the states
  Candidate second;            ///< of the two computations that agree best: the other one
  StatesAt states;             ///< states of the first computation
  Eigen::MatrixXd difference;  ///< |difference| of both computations for each component and time
  Eigen::VectorXd size;        ///< greatest |x_i| at these times

  /// Uncertainty of the last state: the greatest difference of a component, relative to the component or, if
  /// that is below a thousandth of its size, to its size.
  [[nodiscard]] double uncertainty() const;
  /// "adaptive-collocation and cvode-bdf agree to 11.2 digits", or why there is no reference.
  [[nodiscard]] std::string text() const;
};

/// Runs the candidates in turn until two agree within @p needed. If none do, uses the two that agree best,
/// provided that they agree to two digits at all times.
/// @param seconds limit of the wall time of all candidates
[[nodiscard]] Reference agree(const std::vector<Candidate>& candidates, const ReferenceRequest& request,
                              const Tolerance& needed, double seconds);

/// Reference states of a problem at @p times, from the first two computations that agree: first those of
/// @p extended in extended precision, then independent methods, cheap ones first: Taylor series in double
/// precision, collocation, Rosenbrock, Runge-Kutta, differentiation formulas, Hermitian operators; peers only
/// if this build has them. Each method restarts at every output time, so that the states do not depend on
/// dense output. The relative tolerance is a tenth of @p needed, but at least 1e-13 (differentiation
/// formulas, Rosenbrock and Hermitian operators: 1e-12; series: 1e-16). The absolute one is first a millionth
/// of that, for components that decay, and after a failure a tenth of @p needed.
/// @param x0 state at t0, finite
/// @param times output times, strictly monotonic from t0; at least one
/// @param needed requested accuracy
/// @param effort limits of the work
[[nodiscard]] Reference reference_of(std::vector<Candidate> extended, const ivp::System& system,
                                     const ivp::State& x0, double t0, const std::vector<double>& times,
                                     const Tolerance& needed, const WorkLimit& effort);

/// States at all output times by a method that restarts at each of them.
/// @param observer receives the steps of all segments; may be empty
[[nodiscard]] Status states_by(const ivp::NamedIntegrator& run, const ivp::System& system,
                               const ReferenceRequest& request, const ivp::Observer& observer,
                               const ivp::Limits& limits, StatesAt& states);

/// Equidistant output times from @p t0 (excluded) to @p t1 (included); @p count, or fewer if rounding makes
/// some of them equal.
[[nodiscard]] std::vector<double> times_to_check(double t0, double t1, int count);

}  // namespace nlmech::comparison
