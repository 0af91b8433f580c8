#include "nlmech/bvp/optimal_control/extremal.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void check_constraints(const Constraints& c, int states) {
  const auto require = [](bool good, const char* name, double value) {
    if (!good) throw invalid_argument("optimal control: {} = {} is out of range", name, value);
  };
  require(c.control_limit > 0, "control_limit", c.control_limit);
  require(c.control_smoothing > 0, "control_smoothing", c.control_smoothing);
  require(c.penalty_weight >= 0, "penalty_weight", c.penalty_weight);
  require(c.penalty_smoothing > 0, "penalty_smoothing", c.penalty_smoothing);
  for (const StateBound& bound : c.states) {
    require(bound.component >= 0 && bound.component < states, "component of a state's bound",
            bound.component);
    require(bound.low < bound.high, "lower bound of a state", bound.low);
  }
}

}  // namespace

ExtremalProblem::ExtremalProblem(std::shared_ptr<const ControlModel> model, ControlTask task)
    : model_(std::move(model)), task_(std::move(task)) {
  if (!model_) throw std::invalid_argument("optimal control: no model");
  n_ = model_->states();
  const auto count = static_cast<std::size_t>(n_);
  if (task_.begin.size() != count || task_.end.size() != count) {
    throw invalid_argument("optimal control: {} and {} end values for {} states", task_.begin.size(),
                           task_.end.size(), n_);
  }
  if (!(task_.begin_time < task_.final_time) || !std::isfinite(task_.final_time - task_.begin_time)) {
    throw invalid_argument("optimal control: the final time {} is not after the start {}", task_.final_time,
                           task_.begin_time);
  }
  check_constraints(task_.constraints, n_);
  points_ = {task_.begin_time, task_.final_time};
  for (const Waypoint& w : task_.waypoints) {
    if (!(w.t > task_.begin_time && w.t < task_.final_time) || w.component < 0 || w.component >= n_) {
      throw invalid_argument("optimal control: waypoint of component {} at t = {}", w.component, w.t);
    }
    for (const Waypoint& other : task_.waypoints) {
      if (other.t == w.t && other.component == w.component && other.value != w.value) {
        throw invalid_argument("optimal control: component {} at t = {} is prescribed as {} and as {}",
                               w.component, w.t, w.value, other.value);
      }
    }
    points_.push_back(w.t);
  }
  std::sort(points_.begin(), points_.end());
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
}

double ExtremalProblem::final_time(const VectorXd& p) const {
  return task_.free_final_time ? p[0] : task_.final_time;
}

VectorXd ExtremalProblem::own_parameters() const {
  return VectorXd::Constant(parameters(), task_.final_time);
}

double ExtremalProblem::true_time(double t, const VectorXd& p) const {
  if (!task_.free_final_time) return t;
  const double t0 = task_.begin_time;
  return t0 + (t - t0) * (p[0] - t0) / (task_.final_time - t0);
}

std::optional<double> ExtremalProblem::waypoint(std::size_t point, int component) const {
  for (const Waypoint& w : task_.waypoints) {
    if (w.t == points_[point] && w.component == component) return w.value;
  }
  return {};
}

void ExtremalProblem::rhs(double t, const VectorXd& z, const VectorXd& p, VectorXd& dzdt) const {
  model_->extremal(true_time(t, p), z, task_.mu, task_.constraints, dzdt);
  if (task_.free_final_time) {
    dzdt *= (p[0] - task_.begin_time) / (task_.final_time - task_.begin_time);
  }
}

void ExtremalProblem::jacobian(double t, const VectorXd& z, const VectorXd& p, MatrixXd& by_state,
                               MatrixXd& by_parameter) const {
  if (!task_.free_final_time) {
    by_state.resize(2L * n_, 2L * n_);
    model_->extremal_jacobian(t, z, task_.mu, task_.constraints, by_state);
    return;
  }
  MatrixXd j(2 * n_, 2 * n_ + 1);
  model_->extremal_jacobian(true_time(t, p), z, task_.mu, task_.constraints, j);
  // dz/ds = c f(t_0 + c (s - t_0), z) with c = (t_F - t_0)/(length of s)
  const double length = task_.final_time - task_.begin_time, c = (p[0] - task_.begin_time) / length;
  VectorXd f(2 * n_);
  model_->extremal(true_time(t, p), z, task_.mu, task_.constraints, f);
  by_state = c * j.leftCols(2 * n_);
  by_parameter.col(0) = (f + c * (t - task_.begin_time) * j.col(2L * n_)) / length;
}

void ExtremalProblem::conditions(const MatrixXd& ends, const VectorXd& p, VectorXd& r) const {
  const Index last = ends.cols() - 1;
  const EndCost phi = model_->end_cost(ends.col(0).head(n_), ends.col(last).head(n_), final_time(p));
  for (int i = 0; i < n_; ++i) {
    const auto& from = task_.begin[static_cast<std::size_t>(i)];
    const auto& to = task_.end[static_cast<std::size_t>(i)];
    r[i] = from ? ends(i, 0) - *from : ends(n_ + i, 0) + phi.gradient[i];
    r[n_ + i] = to ? ends(i, last) - *to : ends(n_ + i, last) - phi.gradient[n_ + i];
  }
  Index row = 2L * n_;
  for (std::size_t point = 1; point + 1 < points_.size(); ++point) {
    const auto before = static_cast<Index>(2 * point - 1), after = before + 1;
    for (int i = 0; i < n_; ++i, row += 2) {
      const auto value = waypoint(point, i);
      r[row] = value ? ends(i, before) - *value : ends(i, after) - ends(i, before);
      r[row + 1] = value ? ends(i, after) - *value : ends(n_ + i, after) - ends(n_ + i, before);
    }
  }
  if (task_.free_final_time) {
    VectorXd gradient;
    r[row] = phi.gradient[2L * n_] +
             model_->hamiltonian(final_time(p), ends.col(last), task_.mu, task_.constraints, gradient);
  }
}

void ExtremalProblem::condition_jacobian(const MatrixXd& ends, const VectorXd& p, MatrixXd& by_ends,
                                         MatrixXd& by_parameter) const {
  const Index last = ends.cols() - 1, end_column = 2L * n_ * last;
  const EndCost phi = model_->end_cost(ends.col(0).head(n_), ends.col(last).head(n_), final_time(p));
  by_ends.setZero();
  by_parameter.setZero();
  const auto second_derivatives = [&](Index row, int k, double sign) {
    by_ends.block(row, 0, 1, n_) += sign * phi.hessian.block(k, 0, 1, n_);
    by_ends.block(row, end_column, 1, n_) += sign * phi.hessian.block(k, n_, 1, n_);
    if (task_.free_final_time) by_parameter(row, 0) += sign * phi.hessian(k, 2L * n_);
  };
  for (int i = 0; i < n_; ++i) {
    if (task_.begin[static_cast<std::size_t>(i)]) {
      by_ends(i, i) = 1;
    } else {
      by_ends(i, n_ + i) = 1;
      second_derivatives(i, i, 1);
    }
    if (task_.end[static_cast<std::size_t>(i)]) {
      by_ends(n_ + i, end_column + i) = 1;
    } else {
      by_ends(n_ + i, end_column + n_ + i) = 1;
      second_derivatives(n_ + i, n_ + i, -1);
    }
  }
  Index row = 2L * n_;
  for (std::size_t point = 1; point + 1 < points_.size(); ++point) {
    const Index before = 2L * n_ * static_cast<Index>(2 * point - 1), after = before + 2L * n_;
    for (int i = 0; i < n_; ++i, row += 2) {
      if (waypoint(point, i)) {
        by_ends(row, before + i) = by_ends(row + 1, after + i) = 1;
      } else {
        by_ends(row, after + i) = by_ends(row + 1, after + n_ + i) = 1;
        by_ends(row, before + i) = by_ends(row + 1, before + n_ + i) = -1;
      }
    }
  }
  if (!task_.free_final_time) return;
  VectorXd gradient;
  (void)model_->hamiltonian(final_time(p), ends.col(last), task_.mu, task_.constraints, gradient);
  by_ends.block(row, end_column, 1, 2 * n_) = gradient.head(2 * n_).transpose();
  by_parameter(row, 0) += gradient[2L * n_];
  second_derivatives(row, 2 * n_, 1);
}

VectorXd control_at(const ExtremalProblem& problem, const Solution& solution, double t) {
  const VectorXd& p = solution.parameters();
  VectorXd u(problem.model().controls());
  problem.model().control(problem.true_time(t, p), solution.at(t), problem.task().mu,
                          problem.task().constraints, u);
  return u;
}

double hamiltonian_at(const ExtremalProblem& problem, const Solution& solution, double t) {
  const VectorXd& p = solution.parameters();
  VectorXd gradient;
  return problem.model().hamiltonian(problem.true_time(t, p), solution.at(t), problem.task().mu,
                                     problem.task().constraints, gradient);
}

double cost_of(const ExtremalProblem& problem, const Solution& solution) {
  const ControlModel& model = problem.model();
  const VectorXd& p = solution.parameters();
  const int n = model.states();
  const double tF = problem.final_time(p), t0 = problem.task().begin_time;
  const double stretch = (tF - t0) / (solution.end() - solution.begin());
  VectorXd u(model.controls()), g(n);
  const auto running = [&](double t, const VectorXd& z) {
    const double time = problem.true_time(t, p);
    model.control(time, z, problem.task().mu, problem.task().constraints, u);
    return model.dynamics(time, z.head(n), u, problem.task().mu, g);
  };
  return model.end_cost(solution.first().head(n), solution.last().head(n), tF).value +
         stretch * solution.integral(running);
}

double end_miss(const ExtremalProblem& problem, const Solution& solution) {
  if (solution.integrated_end.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  double miss = 0;
  for (std::size_t i = 0; i < problem.task().end.size(); ++i) {
    const auto& value = problem.task().end[i];
    if (value) miss = std::max(miss, std::abs(solution.integrated_end[static_cast<Index>(i)] - *value));
  }
  return miss;
}

Extremal solve_extremal(const ExtremalProblem& problem, const Start& start, const Options& options) {
  Extremal extremal;
  extremal.solution = solve(problem, start, options);
  extremal.miss = end_miss(problem, extremal.solution);
  const Solution& s = extremal.solution;
  if (s.unknowns.intervals.empty() || !s.last().allFinite()) return extremal;
  extremal.final_time = problem.final_time(s.parameters());
  extremal.cost = cost_of(problem, s);
  return extremal;
}

ExtremalProblem with_constraints(const ExtremalProblem& problem, const Constraints& constraints) {
  ControlTask task = problem.task();
  task.constraints = constraints;
  return {problem.shared_model(), std::move(task)};
}

Extremal tighten(const ExtremalProblem& problem, const Start& start, const ConstraintPath& path,
                 const Options& given) {
  Options options = given;
  // Along a bounded arc a penalty of weight w makes solutions grow like exp(sqrt(w) t), too fast for one
  // integration over all intervals.
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
                    "tighten: no extremal is found at {:.4g} of the path to the bounds (control limit "
                    "{:.6g}, penalty weight {:.3g}; {}); the bounds admit none near the last one, or none at "
                    "all; loosen them or start from another extremal",
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

namespace {

bool close(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == 0 || ((a - b).array().abs() / (1 + b.array().abs())).maxCoeff() <= 1e-5;
}

}  // namespace

Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts, const Options& options,
                      const MultistartOptions& many) {
  const Stopwatch watch;
  Multistart result;
  for (std::size_t k = 0; k < starts.size() && watch.seconds() <= many.seconds; ++k) {
    Extremal extremal = solve_extremal(problem, starts[k], options);
    result.statistics += extremal.solution.statistics;
    if (!extremal.solution.status.ok()) {
      ++(extremal.solution.status.outcome() == Outcome::spurious_root ? result.spurious : result.failed);
      continue;
    }
    ++result.good;
    const auto known = std::find_if(result.found.begin(), result.found.end(), [&](const Found& f) {
      const Solution &a = f.extremal.solution, &b = extremal.solution;
      return close(a.first(), b.first()) && close(a.parameters(), b.parameters());
    });
    if (known != result.found.end()) {
      ++known->hits;
      continue;
    }
    if (many.second_order_pieces > 0) {
      extremal.second_order = second_order(problem, extremal.solution, many.second_order_pieces);
    }
    result.found.push_back({std::move(extremal), 1});
  }
  std::sort(result.found.begin(), result.found.end(),
            [](const Found& a, const Found& b) { return a.extremal.cost < b.extremal.cost; });
  result.statistics.seconds = watch.seconds();
  return result;
}

}  // namespace nlmech::bvp
