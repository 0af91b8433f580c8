#include "nlmech/comparison/choice/growth.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/reference/verification.hpp"

namespace nlmech::comparison {

Growth growth_along(const ChoiceRequest& q, const std::string& method) {
  constexpr Eigen::Index most_components = 64;  // each is perturbed by itself
  constexpr int intervals = 6;
  constexpr double most_seconds = 10;  // of all runs, where right-hand sides are expensive
  constexpr double tolerance = 1e-11;  // far below the perturbations of amplification()
  if (q.x0.size() > most_components) return {};
  const ivp::Limits limits = q.limits(40'000);
  const auto run = any_method(method).with(
      {.tolerance = tolerance, .absolute_tolerance = tolerance * std::min(q.absolute, 1.0)});
  Way way{q.x0.cast<long double>(), q.t0, {}};
  Reference along;
  along.size = q.x0.cwiseAbs();
  const auto add = [&](double t, const ivp::State& x) {
    way.times.push_back(t);
    along.states.conservativeResize(x.size(), along.states.cols() + 1);
    along.states.rightCols(1) = x.cast<long double>();
  };
  const ivp::Observer observe = [&](const ivp::Step& step) {
    along.size = along.size.cwiseMax(step.x1.cwiseAbs());
    const double part = (step.t1 - q.t0) / (q.t1 - q.t0) * intervals;
    if (part >= static_cast<double>(way.times.size() + 1) && step.t1 != q.t1) add(step.t1, step.x1);
    return true;
  };
  const ivp::Solution end = run(q.system, q.x0, q.t0, q.t1, observe, limits);
  if (way.times.empty() || end.t != way.times.back()) add(end.t, end.x);
  if (end.t == q.t0 || !end.x.allFinite()) return {};
  along.first.compute = [&](const Way& part, double seconds, StatesAt& states) {
    ivp::Limits these = limits;
    these.seconds = seconds;
    ivp::Solution s = run(q.system, part.x0.cast<double>(), part.t0, part.times.back(), {}, these);
    states = s.x.cast<long double>();
    if (s.status.outcome() != Outcome::outside_validity) return s.status;
    // Where the equations switch, a perturbed run may fail for itself; it shows no growth.
    states = along.states.col(std::ranges::find(way.times, part.times.back()) - way.times.begin());
    return Status();
  };
  const double absolute = q.absolute * std::min(1.0, along.size.maxCoeff());
  const Eigen::MatrixXd weight = (along.states.cast<double>().array().abs() + absolute).matrix();
  Eigen::MatrixXd moved;
  const Eigen::VectorXd first = (q.x0.array().abs() + absolute).matrix();
  if (!amplification(way, along, first, weight, most_seconds, moved).ok()) return {};
  const auto size = along.size.array().max(absolute / 10);
  return {std::max(1.0, (moved.rightCols(1).array() / size).maxCoeff()),
          std::abs((end.t - q.t0) / (q.t1 - q.t0))};
}

}  // namespace nlmech::comparison
