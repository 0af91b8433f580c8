#include "nlmech/comparison/choice/growth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {
namespace {

constexpr double budget = 2e6;               // of a run, in units of Measured
constexpr Eigen::Index most_directions = 8;  // in which begins are moved

/// A state that is moved by so many times a tolerance: each component by itself, or, where these are many,
/// all of them with some signs or other.
ivp::State moved_state(ivp::State x, Eigen::Index direction, double by, double absolute) {
  const bool alone = x.size() <= most_directions;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // Rows of a Hadamard matrix: no two patterns of signs are alike.
    const bool negative = std::popcount(static_cast<unsigned>(i & (direction + i / 8))) % 2 == 1;
    if (!alone || i == direction) x[i] += (negative && !alone ? -by : by) * (absolute + std::abs(x[i]));
  }
  return x;
}

/// A tolerance of the runs, and by how much begins are moved: far above the errors of the runs, and small
/// against the solution.
struct Fineness {
  double tolerance, moved;
};

class Runs {
 public:
  Runs(const Question& q, const Expectation& e, const Fineness& fine)
      : q_(q),
        moved_(fine.moved),
        limits_(e.limits(budget, q.largest_step)),
        run_(any_integrator(
            any_method(e.method),
            {.tolerance = fine.tolerance, .absolute_tolerance = fine.tolerance * std::min(q.absolute, 1.0)})),
        size_(q.x0.cwiseAbs()) {}

  Growth growth() {
    const ivp::Solution straight = run_straight();
    Growth g{1, std::abs((straight.t - q_.t0) / (q_.t1 - q_.t0))};
    if (!(g.seen > 0)) return g;
    const double absolute = q_.absolute * std::min(1.0, size_.maxCoeff());
    for (const auto& [t, x] : begins_) {
      const Eigen::VectorXd error = error_from(t, x, straight, absolute);
      for (Eigen::Index i = 0; i < error.size(); ++i)
        g.factor = std::max(g.factor, error[i] / std::max(size_[i], absolute / 10));
    }
    constexpr double large = 0.1;  // of the size of the solution
    g.at_least = g.factor * moved_ > large;
    return g;
  }

 private:
  ivp::Solution run_straight() {
    const std::size_t most = q_.x0.size() > most_directions ? 3 : 6;
    const double part = (q_.t1 - q_.t0) / static_cast<double>(most);
    begins_ = {{q_.t0, q_.x0}};
    const ivp::Observer see = [this, part](const ivp::Step& step) {
      size_ = size_.cwiseMax(step.x1.cwiseAbs());
      const bool far = std::abs(step.t1 - q_.t0) >= std::abs(part) * static_cast<double>(begins_.size());
      if (far && step.t1 != q_.t1) begins_.emplace_back(step.t1, step.x1);
      return true;
    };
    return run_(q_.system, q_.x0, q_.t0, q_.t1, see, limits_);
  }
  /// The error at the end of what was seen, in units of the moves.
  [[nodiscard]] Eigen::VectorXd error_from(double t, const ivp::State& x, const ivp::Solution& straight,
                                           double absolute) const {
    const Eigen::Index n = x.size(), directions = std::min(n, most_directions);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < directions; ++k) {
      const ivp::State begin = moved_state(x, k, moved_, absolute);
      const ivp::Solution other = run_(q_.system, begin, t, straight.t, {}, limits_);
      if (other.status.ok()) sum += (other.x - straight.x).cwiseAbs() / moved_;
    }
    if (n <= most_directions) return sum;
    // Of random signs the mean is 0.8 of the root of the squares, the worst at most sqrt(n) times that root.
    return sum * std::sqrt(static_cast<double>(n)) / (0.8 * static_cast<double>(directions));
  }

  const Question& q_;
  double moved_;
  ivp::Limits limits_;
  ivp::NamedIntegrator run_;
  ivp::State size_;
  std::vector<std::pair<double, ivp::State>> begins_;
};

}  // namespace

Growth growth_along(const Question& q, const Expectation& e) {
  const Growth first = Runs(q, e, {1e-9, 1e-5}).growth();
  if (!first.at_least) return first;
  const Growth finer = Runs(q, e, {1e-13, 1e-10}).growth();
  return finer.seen > 0 ? finer : first;
}

}  // namespace nlmech::comparison
