#include "nlmech/bvp/continuation.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x(t_0) and the parameters: what determines a solution.
VectorXd key_of(const Solution& s) {
  VectorXd key(s.first().size() + s.parameters().size());
  key << s.first(), s.parameters();
  return key;
}

/// The problem with one condition more: direction^T (key - origin) = distance.
class Closed final : public Problem {
 public:
  Closed(const Problem& problem, VectorXd direction, VectorXd origin, double distance)
      : problem_(problem),
        direction_(std::move(direction)),
        origin_(std::move(origin)),
        distance_(distance) {}

  int states() const override { return problem_.states(); }
  int parameters() const override { return problem_.parameters(); }
  std::vector<double> points() const override { return problem_.points(); }
  int condition_count() const override { return problem_.condition_count() + 1; }
  void rhs(double t, const VectorXd& x, const VectorXd& p, VectorXd& f) const override {
    problem_.rhs(t, x, p, f);
  }
  void jacobian(double t, const VectorXd& x, const VectorXd& p, MatrixXd& by_state,
                MatrixXd& by_parameter) const override {
    problem_.jacobian(t, x, p, by_state, by_parameter);
  }
  void conditions(const MatrixXd& ends, const VectorXd& p, VectorXd& r) const override {
    const Index n = states(), count = r.size() - 1;
    VectorXd own(count);
    problem_.conditions(ends, p, own);
    r.head(count) = own;
    r[count] = direction_.head(n).dot(ends.col(0) - origin_.head(n)) +
               direction_.tail(p.size()).dot(p - origin_.tail(p.size())) - distance_;
  }
  void condition_jacobian(const MatrixXd& ends, const VectorXd& p, MatrixXd& by_ends,
                          MatrixXd& by_parameter) const override {
    const Index count = by_ends.rows() - 1;
    MatrixXd own_ends = MatrixXd::Zero(count, by_ends.cols()), own_p = MatrixXd::Zero(count, p.size());
    problem_.condition_jacobian(ends, p, own_ends, own_p);
    by_ends.topRows(count) = own_ends;
    by_parameter.topRows(count) = own_p;
    by_ends.row(count).setZero();
    by_ends.row(count).head(states()) = direction_.head(states()).transpose();
    by_parameter.row(count) = direction_.tail(p.size()).transpose();
  }

 private:
  const Problem& problem_;
  VectorXd direction_, origin_;
  double distance_;
};

/// The line through two solutions, a fraction beyond the second, on the mesh of that.
Start extrapolated(const Solution& before, const Solution& last, double fraction) {
  auto a = std::make_shared<const Solution>(before), b = std::make_shared<const Solution>(last);
  const auto states = [a, b, fraction](double t, VectorXd& x) {
    const VectorXd at = b->at(std::clamp(t, b->begin(), b->end()));
    x = at + fraction * (at - a->at(std::clamp(t, a->begin(), a->end())));
  };
  return {states, last.parameters() + fraction * (last.parameters() - before.parameters()), last.mesh()};
}

class Walk {
 public:
  Walk(const Problem& problem, const ContinuationOptions& options) : problem_(problem), options_(options) {}

  Branch run(const Start& start) {
    const double value = start.parameters[start.parameters.size() - 1];
    if (!begin(start, value)) return std::move(branch_);
    double step = length_of_last();
    while (static_cast<int>(branch_.points.size()) < options_.points) {
      if (!advance(step)) break;
      look_for_fold();
      if (is_over()) break;
    }
    return std::move(branch_);
  }

 private:
  /// A solve with the parameter held.
  Solution at_parameter(const Start& start, double value) {
    const Index size = problem_.states() + problem_.parameters();
    VectorXd origin = VectorXd::Zero(size);
    origin[size - 1] = value;
    Solution s = solve(Closed(problem_, VectorXd::Unit(size, size - 1), origin, 0), start, options_.solve);
    branch_.statistics += s.statistics;
    return s;
  }

  bool begin(const Start& start, double value) {
    Solution first = at_parameter(start, value);
    branch_.status = first.status;
    if (!first.status.ok()) return false;
    scale_ = key_of(first).cwiseAbs().array() + 1;
    Start next = start_from(first);
    branch_.points.push_back({value, 0, std::move(first)});
    double step = options_.first_step;
    for (int k = 0; k < 20; ++k, step /= 4) {
      next.parameters[next.parameters.size() - 1] = value + step;
      Solution second = at_parameter(next, value + step);
      if (!second.status.ok()) continue;
      const double length = distance(branch_.points[0].solution, second);
      if (length > options_.longest_step && k < 19) continue;
      branch_.points.push_back({value + step, length, std::move(second)});
      return true;
    }
    branch_.status = failed_with(Outcome::not_converged,
                                 "continuation: no second solution near the parameter {:.10g}; start "
                                 "elsewhere on the branch, or go the other way",
                                 value);
    return false;
  }

  [[nodiscard]] double distance(const Solution& a, const Solution& b) const {
    return (key_of(b) - key_of(a)).cwiseQuotient(scale_).norm();
  }
  [[nodiscard]] double length_of_last() const {
    const auto& p = branch_.points;
    return p.back().arclength - p[p.size() - 2].arclength;
  }
  /// Scaled direction from one point to the next.
  [[nodiscard]] VectorXd direction(const BranchPoint& from, const BranchPoint& to) const {
    return (key_of(to.solution) - key_of(from.solution)).cwiseQuotient(scale_).normalized();
  }

  /// The solution at a distance along the secant through two points, from the second.
  Solution along(const BranchPoint& from, const BranchPoint& to, double length) {
    const VectorXd along_secant = direction(from, to);
    const Closed closed(problem_, along_secant.cwiseQuotient(scale_), key_of(to.solution), length);
    const double secant = distance(from.solution, to.solution);
    Solution s = solve(closed, extrapolated(from.solution, to.solution, length / secant), options_.solve);
    branch_.statistics += s.statistics;
    return s;
  }

  bool advance(double& step) {
    const BranchPoint before = branch_.points[branch_.points.size() - 2], last = branch_.points.back();
    while (step >= options_.least_step) {
      Solution s = along(before, last, step);
      if (s.status.ok()) {
        BranchPoint next{s.parameters()[s.parameters().size() - 1], 0, std::move(s)};
        const double length = distance(last.solution, next.solution);
        // A sharp turn is a jump to another branch more often than a bend of this one.
        if (direction(before, last).dot(direction(last, next)) > 0.7 && length < 2 * step) {
          next.arclength = last.arclength + length;
          const bool easy = next.solution.statistics.newton_iterations <= 6;
          branch_.points.push_back(std::move(next));
          if (easy) step = std::min(1.5 * step, options_.longest_step);
          return true;
        }
      }
      step /= 2;
    }
    branch_.status =
        failed_with(Outcome::not_converged,
                    "continuation: the branch cannot be followed beyond the parameter {:.10g} with steps of "
                    "{:.2g}; allow more intervals or a smaller tolerance of the solves",
                    last.parameter, options_.least_step);
    return false;
  }

  /// A fold between the last three points: the parameter over arclength turns between a and c. Parabolas
  /// through three points narrow it down.
  void look_for_fold() {
    const auto& p = branch_.points;
    if (p.size() < 3) return;
    BranchPoint a = p[p.size() - 3], b = p[p.size() - 2], c = p.back();
    if ((b.parameter - a.parameter) * (c.parameter - b.parameter) >= 0) return;
    for (int k = 0; k < 12; ++k) {
      const double left = (b.parameter - a.parameter) / (b.arclength - a.arclength);
      const double right = (c.parameter - b.parameter) / (c.arclength - b.arclength);
      const double curvature = (right - left) / (c.arclength - a.arclength);
      const double vertex = (a.arclength + b.arclength - left / curvature) / 2;
      const double offset = vertex - b.arclength;
      if (!(vertex > a.arclength && vertex < c.arclength)) break;
      // The parabola's own error in the parameter: second order in what the vertex still moves.
      if (std::abs(offset) < 1e-4 * (c.arclength - a.arclength)) break;
      Solution s = along(a, b, offset);
      if (!s.status.ok()) break;
      BranchPoint x{s.parameters()[s.parameters().size() - 1], 0, std::move(s)};
      x.arclength = b.arclength + std::copysign(distance(b.solution, x.solution), offset);
      const double change = std::abs(x.parameter - b.parameter);
      // x becomes the middle one if it is further out, else an end; three points around the turn remain.
      const bool outer = (x.parameter - b.parameter) * curvature < 0;
      (offset < 0 ? (outer ? c : a) : (outer ? a : c)) = outer ? b : x;
      if (outer) b = std::move(x);
      if (change <= 1e-10 * (1 + std::abs(b.parameter))) break;
    }
    branch_.folds.push_back(std::move(b));
  }

  bool is_over() {
    const auto& p = branch_.points;
    const double now = p.back().parameter, before = p[p.size() - 2].parameter;
    if (options_.target && (now - *options_.target) * (before - *options_.target) <= 0) {
      Start start = start_from(p.back().solution);
      start.parameters[start.parameters.size() - 1] = *options_.target;
      Solution s = at_parameter(start, *options_.target);
      branch_.status = s.status;
      const double arclength = p[p.size() - 2].arclength + distance(p[p.size() - 2].solution, s);
      branch_.points.back() = {*options_.target, arclength, std::move(s)};
      return true;
    }
    return now < options_.low || now > options_.high ||
           static_cast<int>(branch_.folds.size()) >= options_.folds;
  }

  const Problem& problem_;
  const ContinuationOptions& options_;
  Branch branch_;
  VectorXd scale_;
};

}  // namespace

Branch continue_branch(const Problem& problem, const Start& start, const ContinuationOptions& options) {
  const int needed = problem.states() * problem.phases() + problem.parameters() - 1;
  if (problem.parameters() < 1 || problem.condition_count() != needed) {
    throw invalid_argument(
        "continue_branch: {} conditions and {} parameters; {} conditions and a free parameter are needed",
        problem.condition_count(), problem.parameters(), needed);
  }
  if (start.parameters.size() != problem.parameters() || options.first_step == 0 || options.points < 2 ||
      !(options.least_step > 0) || !(options.longest_step > options.least_step)) {
    throw invalid_argument(
        "continue_branch: start of {} parameters, first step {}, points {}, steps {} to {}",
        start.parameters.size(), options.first_step, options.points, options.least_step,
        options.longest_step);
  }
  return Walk(problem, options).run(start);
}

ExtremalProblem with_constraints(const ExtremalProblem& problem, const Constraints& constraints) {
  ControlTask task = problem.task();
  task.constraints = constraints;
  return {problem.shared_model(), std::move(task)};
}

Extremal tighten(const ExtremalProblem& problem, const Start& start, const ConstraintPath& path,
                 const Options& given) {
  Options options = given;
  // Along a bounded arc a penalty of weight w makes solutions grow like exp(sqrt(w) t): not to be integrated
  // through.
  if (path(1).penalty_weight > 0 && options.verification == Verification::whole)
    options.verification = Verification::pieces;
  Extremal last = solve_extremal(with_constraints(problem, path(0)), start, options);
  double s = 0, step = 0.1;
  while (last.solution.status.ok() && s < 1) {
    const double next = std::min(1.0, s + step);
    Extremal trial =
        solve_extremal(with_constraints(problem, path(next)), start_from(last.solution), options);
    if (trial.solution.status.ok()) {
      s = next;
      step *= 1.5;
      trial.solution.statistics += last.solution.statistics;
      last = std::move(trial);
      continue;
    }
    step /= 2;
    if (step >= 1e-3) continue;
    const Constraints c = path(s);
    last.solution.status =
        failed_with(Outcome::infeasible,
                    "tighten: {:.4g} of the way to the bounds (control limit {:.6g}, penalty weight {:.3g}) "
                    "no extremal follows ({}); the bounds admit none near this one, or none at all: loosen "
                    "them or start from another extremal",
                    s, c.control_limit, c.penalty_weight, trial.solution.status.sentence());
  }
  return last;
}

ConstraintPath control_bound_path(double peak, double limit, double smoothing) {
  if (!(peak > 0) || !(limit > 0) || !(smoothing > 0)) {
    throw invalid_argument("control_bound_path: peak {}, limit {}, smoothing {}", peak, limit, smoothing);
  }
  const double easy = std::max(1.1 * peak, limit), wide = std::max(0.03 * limit, smoothing);
  return [=](double s) {
    Constraints c;
    const double first = std::min(1.0, 2 * s), second = std::max(0.0, 2 * s - 1);
    c.control_limit = easy * std::pow(limit / easy, first);
    c.control_smoothing = wide * std::pow(smoothing / wide, second);
    return c;
  };
}

ConstraintPath state_bound_path(std::vector<StateBound> bounds, double weight) {
  if (!(weight >= 1)) throw invalid_argument("state_bound_path: weight {}", weight);
  return [bounds = std::move(bounds), weight](double s) {
    Constraints c;
    c.states = bounds;
    c.penalty_weight = std::pow(weight, s);
    c.penalty_smoothing = 0.1 * std::pow(10 / std::sqrt(weight), s);
    return c;
  };
}

}  // namespace nlmech::bvp
