/// @file
/// Modified Chebyshev-Picard iteration, step by step.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// MCPI (Bai & Junkins 2011; Elgohary 2015, Fig. 4.1): the right-hand side at Chebyshev-Gauss-Lobatto nodes
/// of the step is expanded in Chebyshev polynomials up to the degree order - 1, integrated term by term, and
/// this is repeated until the states stand still. No Jacobian, no linear solve; the iteration contracts only
/// if the step is short (free Duffing oscillator of the dissertation: about half a period).
///
/// Tests hold it to 1e-12 on Duffing's oscillator at t = 5, with order 14 in steps of 0.5 and order 20 in
/// steps of 1.
struct Mcpi {
  static constexpr std::string_view name = "mcpi";  ///< on command lines and in tables
  double step = 0.1;                                ///< length of a step, positive
  int order = 8;                                    ///< degree N of the state in time, from 2 to 199
  int intervals = 0;                                ///< M, sample points less one; 0 for M = N
  double tolerance = 1e-13;  ///< done when a sweep changes no |x_i| by more than this times 1 + |x_i|
  int sweeps = 1000;         ///< at most so many sweeps a step
};

/// The matrices of Mcpi, on the unit interval.
struct PicardTables {
  Eigen::VectorXd nodes;     ///< M + 1 times from 0 to 1
  Eigen::MatrixXd integral;  ///< right-hand sides at the nodes to the states' increments at the nodes 2..M+1
  Eigen::VectorXd weights;   ///< barycentric weights for dense output
};

/// @throws std::invalid_argument for options out of range
[[nodiscard]] PicardTables picard_tables(const Mcpi& method);

/// Failure of a step whose iteration does not contract.
[[nodiscard]] Status picard_failure(Outcome outcome, double t, double step, int sweeps);

/// One step of Mcpi.
template <SystemLike S>
class PicardStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;   ///< components of the state
  static constexpr bool has_nodes = true;  ///< nodes 2..M+1

  /// @param system outlives the stepper
  /// @param method options
  PicardStepper(const S& system, const Mcpi& method)
      : Stepper<n>(system.size()),
        system_(system),
        method_(method),
        tables_(picard_tables(method)),
        times_of_nodes_(static_cast<std::size_t>(tables_.nodes.size())),
        x_(system.size(), tables_.nodes.size()),
        g_(system.size(), tables_.nodes.size()),
        x0_(system.size()) {
    this->times_.resize(times_of_nodes_.size() - 1);
    this->states_.resize(system.size(), tables_.nodes.size() - 1);
  }

  /// The method's.
  [[nodiscard]] static std::string_view name() { return Mcpi::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// From t to t + h, from the constant state.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    t0_ = t;
    h_ = h;
    x0_ = x0;
    const auto count = static_cast<Eigen::Index>(times_of_nodes_.size());
    for (Eigen::Index k = 0; k < count; ++k)
      times_of_nodes_[static_cast<std::size_t>(k)] = t + h * tables_.nodes[k];
    times_of_nodes_.back() = t + h;
    std::copy(times_of_nodes_.begin() + 1, times_of_nodes_.end(), this->times_.begin());
    for (double& time : times_of_nodes_) time = segment_(time);  // from here on: where f is asked for
    this->states_.colwise() = x0;
    const Outcome outcome = iterate(statistics);
    x1 = this->states_.col(count - 2);
    return outcome == Outcome::success ? Status{} : picard_failure(outcome, t, h, method_.sweeps);
  }

  /// The interpolating polynomial through the nodes.
  void at(double t, State<n>& x) const override {
    Eigen::RowVectorXd row;
    collocation::polynomial_row(tables_.nodes, tables_.weights, (t - t0_) / h_, row);
    x = row[0] * x0_;
    for (Eigen::Index k = 1; k < row.size(); ++k) x += row[k] * this->states_.col(k - 1);
  }

 private:
  // Sweeps until the states stand still, or shrink no more at the level of rounding.
  Outcome iterate(Statistics& statistics) {
    constexpr double noise = 1e-11;
    double before = HUGE_VAL;
    x_.col(0) = x0_;
    for (int sweep = 0; sweep < method_.sweeps; ++sweep) {
      x_.rightCols(this->states_.cols()) = this->states_;
      system_.rhs(times_of_nodes_, x_, g_);
      statistics.right_hand_sides += x_.cols();
      this->states_.noalias() = (h_ * g_) * tables_.integral.transpose();
      this->states_.colwise() += x0_;
      if (!this->states_.allFinite()) return sweep == 0 ? Outcome::non_finite : Outcome::not_converged;
      const double change = ((this->states_ - x_.rightCols(this->states_.cols())).array().abs() /
                             (1 + this->states_.array().abs()))
                                .maxCoeff();
      if (change <= method_.tolerance) return Outcome::success;
      if (change <= noise && change >= before) {  // contraction may be slow: only a standstill is noise
        ++statistics.fallbacks;
        return Outcome::success;
      }
      before = change;
    }
    return Outcome::not_converged;
  }

  const S& system_;
  Mcpi method_;
  PicardTables tables_;
  SmoothSegment segment_;
  std::vector<double> times_of_nodes_;
  Nodes<n> x_, g_;
  State<n> x0_;
  double t0_ = 0, h_ = 1;
};

/// Runs Mcpi.
template <SystemLike S>
struct Integrator<S, Mcpi> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const Mcpi& method) {
    require_step(Mcpi::name, method.step);
    PicardStepper<S> stepper(task.system, method);
    return walk(task, method.step, stepper);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Mcpi> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
