#include "nlmech/ivp/collocation/picard.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

PicardTables picard_tables(const Mcpi& method) {
  const int intervals = method.intervals == 0 ? method.order : method.intervals;
  if (method.order < 1 || intervals < method.order || intervals >= collocation::max_nodes)
    throw std::invalid_argument(
        fmt::format("mcpi: the order must be at least 1 and the intervals from the order to {}, "
                    "not {} and {}",
                    collocation::max_nodes - 1, method.order, intervals));
  if (!(method.tolerance > 0) || method.sweeps < 1)
    throw std::invalid_argument(fmt::format("mcpi: tolerance and sweeps must be positive, not {} and {}",
                                            method.tolerance, method.sweeps));
  const Eigen::VectorXd nodes = collocation::chebyshev_gauss_lobatto(intervals + 1);
  // On [-1, 1]; the unit interval is half as long. The first node's increment is zero.
  const Eigen::MatrixXd integral = collocation::chebyshev_picard_matrix(intervals + 1, method.order - 1) / 2;
  return {(nodes.array() + 1) / 2, integral.bottomRows(intervals), collocation::barycentric_weights(nodes)};
}

Status picard_failure(Outcome outcome, double t, double step, int sweeps) {
  if (outcome == Outcome::non_finite) return non_finite_state(Mcpi::name, t, step);
  return Status::failure(
      outcome, fmt::format("mcpi: Picard's iteration does not converge within {} sweeps in the step "
                           "of {:.6g} from t = {:.17g}; take a shorter step, or a tolerance instead",
                           sweeps, step, t));
}

namespace {

/// One step of Mcpi.
class PicardStepper : public Stepper {
 public:
  static constexpr bool has_nodes = true;  ///< nodes 2..M+1

  /// @param system outlives the stepper
  /// @param method options
  PicardStepper(const System& system, const Mcpi& method)
      : Stepper(system.size()),
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

  /// Name of the method.
  [[nodiscard]] static std::string_view name() { return Mcpi::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// Integrates from t to t + h, starting the iteration from the constant state.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    t0_ = t;
    h_ = h;
    x0_ = x0;
    const auto count = static_cast<Eigen::Index>(times_of_nodes_.size());
    for (Eigen::Index k = 0; k < count; ++k)
      times_of_nodes_[static_cast<std::size_t>(k)] = t + h * tables_.nodes[k];
    times_of_nodes_.back() = t + h;
    std::copy(times_of_nodes_.begin() + 1, times_of_nodes_.end(), this->times_.begin());
    for (double& time : times_of_nodes_) time = segment_(time);  // now the times at which f is evaluated
    this->states_.colwise() = x0;
    const Outcome outcome = iterate(statistics);
    x1 = this->states_.col(count - 2);
    return outcome == Outcome::success ? Status{} : picard_failure(outcome, t, h, method_.sweeps);
  }

  /// Dense output: the polynomial through the nodes.
  void at(double t, State& x) const override {
    Eigen::RowVectorXd row;
    collocation::polynomial_row(tables_.nodes, tables_.weights, (t - t0_) / h_, row);
    x = row[0] * x0_;
    for (Eigen::Index k = 1; k < row.size(); ++k) x += row[k] * this->states_.col(k - 1);
  }

 private:
  // Sweeps until the states converge, or until the updates stagnate at the level of rounding.
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
      if (change <= noise && change >= before) {  // contraction may be slow: only stagnation is rounding
        ++statistics.fallbacks;
        return Outcome::success;
      }
      before = change;
    }
    return Outcome::not_converged;
  }

  const System& system_;
  Mcpi method_;
  PicardTables tables_;
  SmoothSegment segment_;
  std::vector<double> times_of_nodes_;
  Nodes x_, g_;
  State x0_;
  double t0_ = 0, h_ = 1;
};

}  // namespace

Solution run(const InitialValueProblem& problem, const Mcpi& method) {
  require_step(Mcpi::name, method.step);
  PicardStepper stepper(problem.system, method);
  return integrate_fixed_steps(problem, method.step, stepper);
}

}  // namespace nlmech::ivp
