#include "nlmech/bvp/optimal_control/direct_start.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Prescribed value at a step of the grid, with its multiplier.
struct Target {
  Index step;
  int component;
  double value;
  double multiplier;
};

/// Trajectory on the grid.
struct Trajectory {
  MatrixXd x, u;     // n by M + 1, q by M
  double merit = 0;  // cost with penalties and multipliers
};

class Descent {
 public:
  Descent(const ExtremalProblem& problem, const DirectOptions& options)
      : task_(problem.task()),
        model_(problem.model()),
        options_(options),
        n_(model_.states()),
        q_(model_.controls()),
        steps_(options.pieces),
        h_((task_.final_time - task_.begin_time) / options.pieces),
        rho_(options.first_weight),
        low_(options.low),
        high_(options.high) {
    const double limit = task_.constraints.control_limit;
    if (low_.size() == 0) low_ = VectorXd::Constant(q_, -limit);
    if (high_.size() == 0) high_ = VectorXd::Constant(q_, limit);
    for (int i = 0; i < n_; ++i) {
      const auto& value = task_.end[static_cast<std::size_t>(i)];
      if (value) targets_.push_back({steps_, i, *value, 0});
      if (!task_.begin[static_cast<std::size_t>(i)]) free_.push_back(i);
    }
    for (const Waypoint& w : task_.waypoints) {
      const auto step = static_cast<Index>(std::lround((w.t - task_.begin_time) / h_));
      targets_.push_back({std::clamp<Index>(step, 1, steps_ - 1), w.component, w.value, 0});
    }
    const auto count = static_cast<std::size_t>(steps_);
    gain_.resize(count);
    change_.resize(count);
    costates_.resize(n_, steps_ + 1);
  }

  DirectResult run(const ControlGuess& guess) {
    DirectResult result;
    now_.x = MatrixXd::Zero(n_, steps_ + 1);
    now_.u = MatrixXd::Zero(q_, steps_);
    now_.x.col(0) = guess.begin;
    for (int i = 0; i < n_; ++i) {
      const auto& value = task_.begin[static_cast<std::size_t>(i)];
      if (value) now_.x(i, 0) = *value;
    }
    VectorXd u(q_);
    for (Index k = 0; k < steps_; ++k) {
      guess.control(time(k) + h_ / 2, u);
      now_.u.col(k) = u.cwiseMax(low_).cwiseMin(high_);
    }
    if (!integrate(now_)) {
      result.status = Status::failure(Outcome::non_finite,
                                      "direct_start: the trajectory of the guessed control is not finite; "
                                      "start with a weaker control");
      return result;
    }
    for (int round = 0; round < options_.rounds; ++round) {
      descend();
      for (Target& target : targets_) {
        target.multiplier += rho_ * (now_.x(target.component, target.step) - target.value);
      }
      if (targets_.empty()) break;
      if (round + 1 < options_.rounds) rho_ *= options_.weight_growth;
    }
    finish(result);
    return result;
  }

 private:
  [[nodiscard]] double time(Index k) const { return task_.begin_time + static_cast<double>(k) * h_; }

  VectorXd slope(double t, const VectorXd& x, const VectorXd& u) const {
    VectorXd g(n_);
    model_.dynamics(t, x, u, task_.mu, g);
    return g;
  }

  VectorXd next(Index k, const VectorXd& x, const VectorXd& u) const {
    const double t = time(k);
    const VectorXd k1 = slope(t, x, u), k2 = slope(t + h_ / 2, x + h_ / 2 * k1, u);
    const VectorXd k3 = slope(t + h_ / 2, x + h_ / 2 * k2, u), k4 = slope(t + h_, x + h_ * k3, u);
    return x + h_ / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }

  /// Running cost with penalties; without penalties the derivatives are not computed.
  [[nodiscard]] double rate(Index k, const VectorXd& x, const VectorXd& u) const {
    if (task_.constraints.penalty_weight > 0) {
      return model_.expand(time(k), x, u, VectorXd::Zero(n_), task_.mu, task_.constraints).value;
    }
    VectorXd g(n_);
    return model_.dynamics(time(k), x, u, task_.mu, g);
  }

  /// Derivatives of next() with respect to x and u, by stages.
  void linearise(Index k, MatrixXd& a, MatrixXd& b) const {
    const double t = time(k);
    const VectorXd u = now_.u.col(k);
    LinearDynamics e;
    VectorXd x = now_.x.col(k);
    MatrixXd by_x = MatrixXd::Identity(n_, n_), by_u = MatrixXd::Zero(n_, q_);
    a = by_x;
    b = by_u;
    const double ahead[4] = {h_ / 2, h_ / 2, h_, 0}, weight[4] = {1, 2, 2, 1}, at[4] = {0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
      model_.linearise(t + at[stage] * h_, x, u, task_.mu, e);
      const MatrixXd kx = e.g_x * by_x, ku = e.g_x * by_u + e.g_u;
      a += h_ / 6 * weight[stage] * kx;
      b += h_ / 6 * weight[stage] * ku;
      by_x = MatrixXd::Identity(n_, n_) + ahead[stage] * kx;
      by_u = ahead[stage] * ku;
      x = now_.x.col(k) + ahead[stage] * e.g;
    }
  }

  /// End cost and penalties of the prescribed values.
  [[nodiscard]] double target_cost(const Trajectory& trajectory) const {
    double sum = model_.end_cost(trajectory.x.col(0), trajectory.x.col(steps_), task_.final_time).value;
    for (const Target& target : targets_) {
      const double c = trajectory.x(target.component, target.step) - target.value;
      sum += target.multiplier * c + rho_ / 2 * c * c;
    }
    return sum;
  }

  /// Integrates x from its first column with the control u; false if it is not finite.
  bool integrate(Trajectory& trajectory) const {
    double running = 0;
    for (Index k = 0; k < steps_; ++k) {
      const VectorXd x = trajectory.x.col(k), u = trajectory.u.col(k);
      running += h_ * rate(k, x, u);
      trajectory.x.col(k + 1) = next(k, x, u);
    }
    trajectory.merit = running + target_cost(trajectory);
    return std::isfinite(trajectory.merit) && trajectory.x.allFinite();
  }

  void add_targets(Index step, VectorXd& vx, MatrixXd& vxx) const {
    for (const Target& target : targets_) {
      if (target.step != step) continue;
      const double c = now_.x(target.component, step) - target.value;
      vx[target.component] += target.multiplier + rho_ * c;
      vxx(target.component, target.component) += rho_;
    }
  }

  /// Riccati recursion along now_; false if a matrix is not positive definite.
  bool sweep_back() {
    const EndCost phi = model_.end_cost(now_.x.col(0), now_.x.col(steps_), task_.final_time);
    VectorXd vx = phi.gradient.segment(n_, n_);
    MatrixXd vxx = phi.hessian.block(n_, n_, n_, n_), a, b;
    const VectorXd zero = VectorXd::Zero(n_);
    add_targets(steps_, vx, vxx);
    costates_.col(steps_) = vx;
    expected_ = 0;
    for (Index k = steps_ - 1; k >= 0; --k) {
      const auto l = model_.expand(time(k), now_.x.col(k), now_.u.col(k), zero, task_.mu, task_.constraints);
      linearise(k, a, b);
      const VectorXd qx = h_ * l.gradient.head(n_) + a.transpose() * vx;
      const VectorXd qu = h_ * l.gradient.tail(q_) + b.transpose() * vx;
      const MatrixXd qxx = h_ * l.hessian.topLeftCorner(n_, n_) + a.transpose() * vxx * a;
      const MatrixXd qux = h_ * l.hessian.bottomLeftCorner(q_, n_) + b.transpose() * vxx * a;
      const MatrixXd quu = h_ * l.hessian.bottomRightCorner(q_, q_) + b.transpose() * vxx * b;
      const auto index = static_cast<std::size_t>(k);
      const MatrixXd damped = quu + h_ * damping_ * MatrixXd::Identity(q_, q_);
      if (!minimise_in_bounds(damped, qu, qux, now_.u.col(k), change_[index], gain_[index])) return false;
      const VectorXd& d = change_[index];
      const MatrixXd& g = gain_[index];
      expected_ -= qu.dot(d) + d.dot(quu * d) / 2;
      vx = qx + g.transpose() * (quu * d + qu) + qux.transpose() * d;
      vxx = qxx + g.transpose() * quu * g + g.transpose() * qux + qux.transpose() * g;
      vxx = (vxx + vxx.transpose()).eval() / 2;
      if (k > 0) add_targets(k, vx, vxx);
      costates_.col(k) = vx;
    }
    return begin_change(phi, vx, vxx);
  }

  /// Change of the control at @p u and its gain that minimise a quadratic model between the bounds. A control
  /// at a bound does not change if the model decreases beyond the bound only (as in Y. Tassa, N. Mansard, E.
  /// Todorov, Control-limited differential dynamic programming, ICRA 2014). False if the matrix is not
  /// positive definite.
  bool minimise_in_bounds(const MatrixXd& quu, const VectorXd& qu, const MatrixXd& qux, const VectorXd& u,
                          VectorXd& change, MatrixXd& gain) const {
    std::vector<Index> free;
    for (Index i = 0; i < q_; ++i) {
      const bool held = (u[i] <= low_[i] && qu[i] > 0) || (u[i] >= high_[i] && qu[i] < 0);
      if (!held) free.push_back(i);
    }
    change = VectorXd::Zero(q_);
    gain = MatrixXd::Zero(q_, n_);
    while (!free.empty()) {
      const Eigen::LLT<MatrixXd> llt(quu(free, free));
      if (llt.info() != Eigen::Success) return false;
      // Controls that the step takes beyond a bound stop there; the others take the best of the remaining
      // step.
      VectorXd rest = qu;
      for (Index i = 0; i < q_; ++i) {
        if (std::ranges::find(free, i) == free.end()) rest += change[i] * quu.col(i);
      }
      const VectorXd step = -llt.solve(rest(free));
      std::vector<Index> within;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const Index i = free[k];
        change[i] = std::clamp(step[static_cast<Index>(k)], low_[i] - u[i], high_[i] - u[i]);
        if (change[i] == step[static_cast<Index>(k)]) within.push_back(i);
      }
      if (within.size() < free.size()) {
        free = within;
        continue;
      }
      const MatrixXd feedback = -llt.solve(qux(free, Eigen::all));
      for (std::size_t k = 0; k < free.size(); ++k) gain.row(free[k]) = feedback.row(static_cast<Index>(k));
      break;
    }
    return true;
  }

  /// Newton step of the free initial values.
  bool begin_change(const EndCost& phi, const VectorXd& vx, const MatrixXd& vxx) {
    const auto count = static_cast<Index>(free_.size());
    begin_change_ = VectorXd::Zero(n_);
    if (count == 0) return true;
    VectorXd g(count);
    MatrixXd m(count, count);
    for (Index i = 0; i < count; ++i) {
      const int row = free_[static_cast<std::size_t>(i)];
      g[i] = vx[row] + phi.gradient[row];
      for (Index j = 0; j < count; ++j) {
        const int column = free_[static_cast<std::size_t>(j)];
        m(i, j) = vxx(row, column) + phi.hessian(row, column);
      }
    }
    const MatrixXd damped = m + damping_ * MatrixXd::Identity(count, count);
    const Eigen::LLT<MatrixXd> llt(damped);
    if (llt.info() != Eigen::Success) return false;
    const VectorXd d = -llt.solve(g);
    expected_ -= g.dot(d) + d.dot(m * d) / 2;
    for (Index i = 0; i < count; ++i) begin_change_[free_[static_cast<std::size_t>(i)]] = d[i];
    return true;
  }

  /// Trajectory after a fraction of the step; false if it is not finite.
  bool attempt(double fraction, Trajectory& trial) const {
    trial.x = now_.x;
    trial.u = now_.u;
    trial.x.col(0) += fraction * begin_change_;
    double running = 0;
    for (Index k = 0; k < steps_; ++k) {
      const auto index = static_cast<std::size_t>(k);
      VectorXd u =
          now_.u.col(k) + fraction * change_[index] + gain_[index] * (trial.x.col(k) - now_.x.col(k));
      u = u.cwiseMax(low_).cwiseMin(high_);
      const VectorXd x = trial.x.col(k);
      if (!x.allFinite() || !u.allFinite()) return false;
      trial.u.col(k) = u;
      running += h_ * rate(k, x, u);
      trial.x.col(k + 1) = next(k, x, u);
    }
    trial.merit = running + target_cost(trial);
    return std::isfinite(trial.merit);
  }

  /// Descends at the present weight until the cost decreases by less than the tolerance.
  void descend() {
    damping_ = 1e-3;
    (void)integrate(now_);
    Trajectory trial;
    for (int k = 0; k < options_.iterations; ++k) {
      bool accepted = false;
      double gained = 0;
      while (!accepted && damping_ < 1e10) {
        const bool positive = sweep_back();
        for (double fraction = 1; positive && fraction > 0.05 && !accepted; fraction /= 3) {
          accepted = attempt(fraction, trial) && trial.merit < now_.merit - 1e-4 * fraction * expected_;
        }
        damping_ = accepted ? std::max(damping_ / 5, 1e-9) : damping_ * 10;
        if (positive && expected_ <= options_.tolerance * (1e-9 + std::abs(now_.merit))) return;
      }
      if (!accepted) return;
      gained = now_.merit - trial.merit;
      std::swap(now_, trial);
      if (gained <= options_.tolerance * std::abs(now_.merit)) return;
    }
  }

  /// Co-states along now_ from the multipliers of the prescribed values.
  [[nodiscard]] MatrixXd adjoint() const {
    MatrixXd all(n_, steps_ + 1), a, b;
    VectorXd lambda =
        model_.end_cost(now_.x.col(0), now_.x.col(steps_), task_.final_time).gradient.segment(n_, n_);
    for (Index k = steps_;; --k) {
      for (const Target& target : targets_) {
        if (target.step == k) lambda[target.component] += target.multiplier;
      }
      all.col(k) = lambda;
      if (k == 0) return all;
      const VectorXd x = now_.x.col(k - 1), u = now_.u.col(k - 1);
      const auto l = model_.expand(time(k - 1), x, u, VectorXd::Zero(n_), task_.mu, task_.constraints);
      linearise(k - 1, a, b);
      lambda = h_ * l.gradient.head(n_) + a.transpose() * lambda;
    }
  }

  void finish(DirectResult& result) {
    damping_ = 1e-9;
    (void)integrate(now_);
    (void)sweep_back();
    result.cost = model_.end_cost(now_.x.col(0), now_.x.col(steps_), task_.final_time).value;
    VectorXd g(n_);
    for (Index k = 0; k < steps_; ++k) {
      result.cost += h_ * model_.dynamics(time(k), now_.x.col(k), now_.u.col(k), task_.mu, g);
    }
    for (const Target& target : targets_) {
      result.miss = std::max(result.miss, std::abs(now_.x(target.component, target.step) - target.value));
    }
    MatrixXd z(2 * n_, steps_ + 1);
    z << now_.x, costates_;
    result.controls = now_.u;
    result.adjoint = adjoint();
    const double t0 = task_.begin_time, h = h_;
    result.start.states = [z, t0, h](double t, VectorXd& at) {
      const double s = std::clamp((t - t0) / h, 0.0, static_cast<double>(z.cols() - 1));
      const Index k = std::min<Index>(static_cast<Index>(s), z.cols() - 2);
      const double f = s - static_cast<double>(k);
      at = (1 - f) * z.col(k) + f * z.col(k + 1);
    };
  }

  const ControlTask& task_;
  const ControlModel& model_;
  const DirectOptions& options_;
  int n_, q_;
  Index steps_;
  double h_, rho_;
  std::vector<Target> targets_;
  std::vector<int> free_;
  Trajectory now_;
  std::vector<MatrixXd> gain_;
  std::vector<VectorXd> change_;
  VectorXd begin_change_, low_, high_;
  MatrixXd costates_;
  double damping_ = 0, expected_ = 0;
};

}  // namespace

DirectResult direct_start(const ExtremalProblem& problem, const ControlGuess& guess,
                          const DirectOptions& options) {
  if (options.pieces < 2 || options.pieces > 5000) {
    throw invalid_argument("direct_start: {} pieces; 2 to 5000 are allowed", options.pieces);
  }
  if (guess.begin.size() != problem.model().states() || !guess.control) {
    throw invalid_argument("direct_start: a guess of {} states", guess.begin.size());
  }
  DirectResult result = Descent(problem, options).run(guess);
  result.start.parameters = problem.own_parameters();
  return result;
}

}  // namespace nlmech::bvp
