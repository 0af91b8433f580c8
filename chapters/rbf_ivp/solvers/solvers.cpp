#include "chapters/rbf_ivp/solvers/solvers.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

constexpr double too_much = 1e10;  // times |F| at the start: will not come back
constexpr int sweeps = 1000;       // of Picard's iteration, at most
constexpr int updates = 100;       // of Newton's

/// Follows |F|, relative to the start.
class Watch {
 public:
  Watch(Cost& cost, const Effort& effort) : cost_(cost), effort_(effort) {}

  /// Is there reason to go on?
  bool operator()(double norm) {
    if (cost_.history.empty()) first_ = norm;
    cost_.reduction = first_ > 0 ? norm / first_ : 0;
    cost_.history.push_back(cost_.reduction);
    cost_.converged = cost_.reduction <= effort_.reduction;
    cost_.diverged = !(cost_.reduction <= too_much);
    return !cost_.converged && !cost_.diverged;
  }

 private:
  Cost& cost_;
  const Effort& effort_;
  double first_ = 1;
};

/// Picard's iteration by `sweep(x, next)`.
Cost sweep_until(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& sweep,
                 Eigen::VectorXd& x, const Effort& effort) {
  Cost cost;
  Watch watch(cost, effort);
  Eigen::VectorXd next(x.size());
  const Stopwatch clock;
  for (int k = 0; k < sweeps; ++k) {
    sweep(x, next);
    ++cost.functions;
    if (!watch((next - x).norm())) break;
    x.swap(next);
    ++cost.iterations;
  }
  cost.seconds = clock.seconds();
  return cost;
}

}  // namespace

std::string_view to_string(Solver solver) {
  switch (solver) {
    case Solver::newton: return "Newton";
    case Solver::damped_newton: return "damped Newton";
    case Solver::picard: return "Picard";
    case Solver::fixed_point_printed: return "fixed-point homotopy";
    case Solver::newton_flow_printed: return "Newton homotopy";
    case Solver::fixed_point_integrated: return "fixed-point homotopy integrated";
    case Solver::newton_flow_integrated: return "Newton homotopy integrated";
  }
  throw std::invalid_argument("to_string: no such solver");
}

bool is_flow(Solver solver) {
  return solver != Solver::newton && solver != Solver::damped_newton && solver != Solver::picard;
}

Cost& Cost::operator+=(const Cost& other) {
  converged = converged && other.converged;
  diverged = diverged || other.diverged;
  iterations += other.iterations;
  functions += other.functions;
  jacobians += other.jacobians;
  reduction = std::max(reduction, other.reduction);
  seconds += other.seconds;
  return *this;
}

Cost solve(Solver solver, algebraic::Equations& equations, Eigen::VectorXd& x, const Effort& effort) {
  Cost cost;
  Watch watch(cost, effort);
  // Newton's methods stop by their updates; here all stop by |F|.
  Eigen::VectorXd latest = x;
  const auto observer = [&](const algebraic::Iterate& i) {
    latest = i.x;
    return watch(i.norm);
  };
  const Stopwatch clock;
  algebraic::Report report;
  switch (solver) {
    case Solver::newton:
      report = find_root(algebraic::Newton{.tolerance = 0, .iterations = updates}, equations, x, observer);
      break;
    case Solver::damped_newton:
      report =
          find_root(algebraic::DampedNewton{.tolerance = 0, .iterations = updates}, equations, x, observer);
      break;
    default: {
      const bool fixed = solver == Solver::fixed_point_printed || solver == Solver::fixed_point_integrated;
      const auto function = fixed ? algebraic::ScalarHomotopy::Function::fixed_point
                                  : algebraic::ScalarHomotopy::Function::newton;
      const algebraic::ScalarHomotopy flow = {.function = function,
                                              .step = effort.step,
                                              .turn = effort.turn,
                                              .tolerance = 0,
                                              .steps = effort.steps};
      report = find_root(flow, equations, x, observer);
    }
  }
  cost.seconds = clock.seconds();
  x = latest;
  cost.iterations = report.statistics.steps;
  cost.functions = report.statistics.right_hand_sides;
  cost.jacobians = report.statistics.jacobians;
  using enum Outcome;
  const Outcome outcome = report.status.outcome();
  if (outcome == non_finite || outcome == newton_diverged || outcome == singular_matrix)
    cost.diverged = !cost.converged;
  return cost;
}

Cost solve(Solver solver, Interval& interval, Eigen::VectorXd& x, const Effort& effort) {
  const bool integrated = solver == Solver::picard || solver == Solver::fixed_point_integrated ||
                          solver == Solver::newton_flow_integrated;
  CollocationEquations& equations = integrated ? interval.integrated : interval.printed;
  x = equations.start();
  Cost cost =
      solver == Solver::picard
          ? sweep_until([&](const Eigen::VectorXd& at, Eigen::VectorXd& next) { equations.picard(at, next); },
                        x, effort)
          : solve(solver, equations, x, effort);
  const auto nodes = static_cast<std::int64_t>(equations.times().size());
  cost.functions *= nodes;
  cost.jacobians *= nodes;
  return cost;
}

std::pair<Cost, int> solve_row(Solver solver, const Case& c, const collocation::Basis& basis, double h,
                               int count, const Effort& effort) {
  Interval interval(c, basis);
  ivp::State state = c.x0;
  Eigen::VectorXd x;
  Cost sum;
  sum.converged = true;
  for (int k = 0; k < count; ++k) {
    interval.begin(c.t0 + k * h, h, state);
    sum += solve(solver, interval, x, effort);
    if (!sum.converged) return {std::move(sum), k};
    state = interval.printed.end(x);
  }
  return {std::move(sum), count};
}

double error_at_nodes(const Case& c, const CollocationEquations& equations, const Eigen::VectorXd& x) {
  double largest = 0;
  for (std::size_t k = 0; k < equations.times().size(); ++k) {
    const ivp::State state = x.segment(static_cast<Eigen::Index>(k) * c.x0.size(), c.x0.size());
    const ivp::State error = error_at(c, equations.times()[k], state);
    const double part = error.cwiseQuotient(c.amplitude).cwiseAbs().maxCoeff();
    if (!(part <= largest)) largest = part;  // keeps a NaN
  }
  return largest;
}

}  // namespace nlmech::chapters::rbf_ivp
