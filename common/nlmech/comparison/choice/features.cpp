#include "nlmech/comparison/choice/features.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {
namespace {

// Steps no shorter than the solution asks for; the second where coarse steps converge to wrong roots.
constexpr ivp::Settings coarse[] = {{.tolerance = 1e-3, .absolute_tolerance = 1e-6},
                                    {.tolerance = 1e-6, .absolute_tolerance = 1e-12}};

/// The greatest modulus of an eigenvalue.
double spectral_radius(const Eigen::MatrixXd& j) {
  constexpr int most_components = 32;  // eigenvalues take their cube
  if (!j.allFinite()) return 0;
  if (j.rows() <= most_components) return j.eigenvalues().cwiseAbs().maxCoeff();
  // The growth of powers, also of a complex pair.
  constexpr int powers = 32, counted = 16;
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(j.rows(), 1, 2);
  double growth = 0;
  for (int k = 0; k < powers; ++k) {
    v = (j * v.normalized()).eval();
    if (!(v.norm() > 0)) return 0;
    if (k >= powers - counted) growth += std::log(v.norm());
  }
  return std::exp(growth / counted);
}

/// The equations as recorded, those of one mode where they switch; nothing: they are refused.
std::optional<Tape> tape_of(const ivp::System& system, double t) {
  const auto modes = static_cast<std::size_t>(system.switches());
  try {
    return (modes > 0 ? system.in_mode(ivp::Mode(modes, 1)) : system).record(t);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// Coarse steps. @param stiffness becomes Features::stiffness
Status coarse_steps(const ChoiceRequest& q, const ivp::Settings& settings, double& stiffness) {
  const Eigen::Index n = q.x0.size();
  ivp::Jacobian j(n, n);
  std::vector<double> units;  // of time of the fastest motion, in a step
  int steps = 0;
  const ivp::Observer sample = [&](const ivp::Step& step) {
    constexpr int dense = 24;  // all of so many steps, then every second, third, ...
    ++steps;
    if (steps % (1 + steps / dense) != 0) return true;
    q.system.jacobian(step.t1, step.x1, j);
    units.push_back(spectral_radius(j) * std::abs(step.t1 - step.t0));
    return true;
  };
  const ivp::Limits limits{
      .steps = std::clamp<std::int64_t>(2000 / n, 60, 400), .seconds = 0.5, .largest_step = q.largest_step};
  const auto run = any_method("adaptive-collocation").with(settings);
  Status status = run(q.system, q.x0, q.t0, q.t1, sample, limits).status;
  // Where few steps are all, the first ones grow from a cautious start and say nothing of accuracy.
  const auto begin = units.begin() + (status.ok() ? 0 : static_cast<std::ptrdiff_t>(units.size() / 2));
  if (begin != units.end())
    stiffness = std::accumulate(begin, units.end(), 0.0) / static_cast<double>(units.end() - begin);
  return status;
}

/// Are the equations q'' = a(t, q)? As recorded, else by the Jacobian at @p x and beside it.
bool has_velocity_free_accelerations(const ivp::System& system, double t, const ivp::State& x) {
  if (!system.second_order()) return false;
  const int half = system.size() / 2;
  if (const std::optional<Tape> tape = tape_of(system, t)) return !tape->depends(half, half);
  ivp::Jacobian j(system.size(), system.size());
  for (const double shift : {0.0, 0.1}) {  // at rest or in a point of symmetry a product may vanish
    system.jacobian(t, (x.array() + shift).matrix(), j);
    if (!j.bottomRightCorner(half, half).isZero(0)) return false;
  }
  return true;
}

}  // namespace

bool depends_on_time(const ivp::System& system, double t, const ivp::State& x) {
  if (const std::optional<Tape> tape = tape_of(system, t)) return tape->depends_on_time();
  ivp::State dfdt(x.size());
  return !system.time_derivative(t, x, dfdt) || !dfdt.isZero(0);
}

ivp::Limits ChoiceRequest::limits(std::int64_t steps) const {
  return {.steps = std::max<std::int64_t>(50, steps / x0.size()), .seconds = 2, .largest_step = largest_step};
}

Probe probe_problem(const ChoiceRequest& q) {
  Probe probe;
  Features& f = probe.features;
  f.velocity_free = has_velocity_free_accelerations(q.system, q.t0, q.x0);
  f.switches = q.system.switches() > 0;
  const std::optional<Tape> tape = tape_of(q.system, q.t0);
  f.operations = tape ? std::max(1, tape->instructions()) : 0;
  for (const ivp::Settings& settings : coarse) {
    probe.status = coarse_steps(q, settings, f.stiffness);
    const Outcome outcome = probe.status.outcome();
    if (outcome == Outcome::step_limit || outcome == Outcome::time_limit) probe.status = {};
    if (probe.status.ok()) break;
  }
  return probe;
}

}  // namespace nlmech::comparison
