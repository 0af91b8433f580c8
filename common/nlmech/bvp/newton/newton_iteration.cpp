#include "nlmech/bvp/newton/newton_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// 1 + max |x_i| over the mesh, and 1 + |p_i|.
struct Scales {
  explicit Scales(const Unknowns& y)
      : states(VectorXd::Ones(y.intervals.front().values.rows())),
        parameters(y.parameters.cwiseAbs().array() + 1) {
    for (const Interval& i : y.intervals) {
      states = states.cwiseMax((i.values.cwiseAbs().rowwise().maxCoeff().array() + 1).matrix());
    }
  }
  VectorXd states, parameters;
};

/// Root mean square of the scaled components of a - fraction b.
double length(const Unknowns& a, const Unknowns& b, double fraction, const Scales& scales) {
  double sum = 0, count = 0;
  const VectorXd weight = scales.states.cwiseInverse();
  for (std::size_t k = 0; k < a.intervals.size(); ++k) {
    const auto difference = a.intervals[k].values - fraction * b.intervals[k].values;
    sum += (weight.asDiagonal() * difference).squaredNorm();
    count += static_cast<double>(a.intervals[k].values.size());
  }
  if (a.parameters.size() > 0) {
    // As heavy as all the states together: one number may be as important as a trajectory.
    const VectorXd part = (a.parameters - fraction * b.parameters).cwiseQuotient(scales.parameters);
    sum += part.squaredNorm() / static_cast<double>(part.size()) * count;
    count += count;
  }
  return std::sqrt(sum / count);
}

void advance(const Unknowns& from, double fraction, const Unknowns& step, Unknowns& to) {
  for (std::size_t k = 0; k < from.intervals.size(); ++k) {
    to.intervals[k].values = from.intervals[k].values + fraction * step.intervals[k].values;
  }
  to.parameters = from.parameters + fraction * step.parameters;
}

Status singular(const NewtonSystem& system, Index conditions, int iteration) {
  if (system.independent_conditions() < conditions && system.contradiction() > 1e-6) {
    return failed_with(Outcome::infeasible,
                       "bvp: the {} conditions contradict each other: only {} are independent, and the "
                       "others cannot be met with them (Newton's iteration {}); take one of them back",
                       conditions, system.independent_conditions(), iteration);
  }
  if (system.independent_conditions() < conditions) {
    return failed_with(Outcome::singular_matrix,
                       "bvp: only {} of the {} conditions are independent of each other (Newton's iteration "
                       "{}): the solution is not determined; replace those that repeat others",
                       system.independent_conditions(), conditions, iteration);
  }
  return failed_with(
      Outcome::singular_matrix,
      "bvp: Newton's matrix is singular (pivots 1 to {:.2g}, iteration {}): with these equations the "
      "conditions leave a solution undetermined or admit none; change the conditions, or start elsewhere",
      system.pivot_ratio(), iteration);
}

Status diverged(int iteration, double damping, double update) {
  return failed_with(Outcome::newton_diverged,
                     "bvp: at iteration {} Newton's step is not admissible even shortened to {:.2g} of its "
                     "length {:.3g}; start elsewhere",
                     iteration, damping, update);
}

Status not_finite(int iteration) {
  return failed_with(
      Outcome::non_finite,
      "bvp: the equations or their derivatives are not finite at Newton's iteration {}; start elsewhere",
      iteration);
}

/// One run of the iteration on a mesh.
class Run {
 public:
  Run(NewtonSystem& system, Unknowns& y, const Options& options, Statistics& statistics)
      : system_(system),
        y_(y),
        options_(options),
        statistics_(statistics),
        step_(y),
        simplified_(y),
        trial_(y) {}

  Status run(Index conditions, double& pivot_ratio) {
    if (!system_.residual(y_)) return not_finite(0);
    for (int k = 1; k <= options_.newton_iterations; ++k) {
      if (!system_.factorise(y_)) return not_finite(k);
      ++statistics_.jacobians;
      ++statistics_.factorisations;
      ++statistics_.newton_iterations;
      pivot_ratio = system_.pivot_ratio();
      if (!(pivot_ratio > 1e-13)) return singular(system_, conditions, k);
      system_.solve(step_);
      const Scales scales(y_);
      const double update = length(step_, step_, 0, scales);
      if (!std::isfinite(update)) return singular(system_, conditions, k);
      if (update <= options_.newton_tolerance) return finish();
      predict(k, update, scales);
      Status status = shorten(k, update, scales);
      if (!status.ok() || done_) return status;
    }
    return failed_with(
        Outcome::not_converged,
        "bvp: Newton's updates are still {:.3g} after {} iterations; allow more, or start closer", before_,
        options_.newton_iterations);
  }

 private:
  /// The last step, at full length; F there, so that the slopes belong to the values.
  Status finish() {
    advance(y_, 1, step_, y_);
    done_ = true;
    return system_.residual(y_) ? Status() : not_finite(0);
  }

  /// Damping from the curvature that the last step showed.
  void predict(int k, double update, const Scales& scales) {
    if (k == 1) {
      damping_ = 1;
      return;
    }
    const double turn = length(simplified_, step_, 1, scales);
    const double allowed = turn > 0 ? before_ * simplified_length_ / (turn * update) * damping_ : 1;
    damping_ = std::clamp(allowed, options_.least_damping, 1.0);
  }

  /// Shortens the step until the next simplified one is shorter than this.
  Status shorten(int k, double update, const Scales& scales) {
    for (;;) {
      advance(y_, damping_, step_, trial_);
      double theta = 2, next = damping_ / 2;
      if (system_.residual(trial_)) {
        system_.solve(simplified_);
        simplified_length_ = length(simplified_, simplified_, 0, scales);
        theta = simplified_length_ / update;
        const double bend = length(simplified_, step_, 1 - damping_, scales);
        if (bend > 0) next = std::min(next, update * damping_ * damping_ / (2 * bend));
      }
      if (theta <= 1 - damping_ / 4) break;
      // At the level of rounding nothing falls any more.
      if (update <= 100 * options_.newton_tolerance && damping_ == 1 && theta < 2) break;
      ++statistics_.rejected;
      if (damping_ <= options_.least_damping) return diverged(k, damping_, update);
      damping_ = std::max(next, std::max(damping_ / 10, options_.least_damping));
    }
    std::swap(y_.intervals, trial_.intervals);
    std::swap(y_.parameters, trial_.parameters);
    before_ = update;
    if (damping_ == 1 && simplified_length_ <= options_.newton_tolerance) {
      advance(y_, 1, simplified_, y_);
      done_ = true;
      if (!system_.residual(y_)) return not_finite(k);
    }
    return {};
  }

  NewtonSystem& system_;
  Unknowns& y_;
  const Options& options_;
  Statistics& statistics_;
  Unknowns step_, simplified_, trial_;
  double damping_ = 1, before_ = 0, simplified_length_ = 0;
  bool done_ = false;
};

}  // namespace

Status iterate(NewtonSystem& system, Unknowns& y, const Options& options, Statistics& statistics,
               double& pivot_ratio) {
  const auto before = system.evaluations();
  Run run(system, y, options, statistics);
  const Index phases = y.intervals.back().phase + 1;
  const Index conditions = y.intervals.front().values.rows() * phases + y.parameters.size();
  Status status = run.run(conditions, pivot_ratio);
  statistics.right_hand_sides += system.evaluations() - before;
  return status;
}

}  // namespace nlmech::bvp
