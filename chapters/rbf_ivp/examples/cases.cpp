#include "chapters/rbf_ivp/examples/cases.hpp"

#include <Eigen/Eigenvalues>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

constexpr double beyond = 5;  // s: readings of the end time look a little past the printed one

/// Eq. 4.23: x = X cn(omega t | m), v = -X omega sn dn. dn comes from sn: Boost's own is a quotient of two
/// vanishing numbers where x does.
Vector<Extended, 2> elliptic(const problems::Duffing& problem, Extended X, Extended period, double t) {
  const Extended omega = problem.argument_frequency(X), m = problem.elliptic_parameter(X);
  // Within half a period of a maximum, where the functions lose nothing.
  const Extended u = omega * std::remainder(Extended(t), period);
  Extended cn = 0;
  const Extended sn = boost::math::jacobi_elliptic(std::sqrt(m), u, &cn, static_cast<Extended*>(nullptr));
  return {X * cn, -X * omega * sn * std::sqrt(1 - m * sn * sn)};
}

template <class Problem>
auto trajectory_of(const Problem& problem, double end) {
  constexpr int n = Problem::dimension;
  using Trajectory = problems::ReferenceTrajectory<Extended, Problem>;
  auto trajectory = std::make_shared<const Trajectory>(
      problem, Vector<Extended, n>(problem.initial_state().template cast<Extended>()), Extended(0),
      Extended(end));
  if (!trajectory->status().ok()) throw Failure(trajectory->status());
  return trajectory;
}

Case make_free_duffing(std::string name, const problems::Duffing& problem, const ivp::State& x0, double end) {
  const Vector<double, 2> start = x0;
  const Extended X = problem.amplitude(start);
  const Extended period = problem.period(X);
  const double greatest_speed = std::sqrt(2 * problem.invariants(0.0, start)[0]);
  return {{.name = std::move(name),
           .system = ivp::System(problem),
           .x0 = x0,
           .t0 = problems::Duffing::initial_time,
           .t1 = end,
           .amplitude = {static_cast<double>(X), greatest_speed},
           .reference = [=](double t) { return elliptic(problem, X, period, t); }},
          static_cast<double>(100 * period),
          static_cast<double>(period / 2)};
}

Case make_impact() {
  const problems::ImpactDuffing problem;
  const auto trajectory = trajectory_of(problem, problems::ImpactDuffing::final_time + beyond);
  const Vector<double, 2> after = (*trajectory)(problem.duration).cast<double>();
  const problems::Duffing free = problem.free();
  return {{.name = "impact",
           .system = ivp::System(problem),
           .x0 = problem.initial_state(),
           .t0 = problems::ImpactDuffing::initial_time,
           .t1 = problems::ImpactDuffing::final_time,
           .amplitude = {free.amplitude(after), std::sqrt(2 * free.invariants(0.0, after)[0])},
           .reference = [trajectory](double t) { return (*trajectory)(t); }},
          499,
          free.period(free.amplitude(after)) / 2};
}

/// The impact problem without its list of kinks.
struct QuietImpact {
  static constexpr int dimension = problems::ImpactDuffing::dimension;
  problems::ImpactDuffing full;
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    full.acceleration(t, q, v, a);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    full(t, x, dxdt);
  }
};

Case make_three_masses() {
  using Chain = problems::ThreeMassChain;
  const auto trajectory =
      trajectory_of(problems::BasicThreeMassChain<Extended>{}, Chain::final_time + beyond);
  ivp::State amplitude = ivp::State::Zero(6);
  constexpr int samples = 20'000;
  for (int i = 0; i <= samples; ++i) {
    const ivp::State x = (*trajectory)(Chain::final_time * i / samples).cast<double>();
    amplitude = amplitude.cwiseMax(x.cwiseAbs());
  }
  return {{.name = "three-masses",
           .system = ivp::System(Chain{}),
           .x0 = Chain::initial_state(),
           .t0 = Chain::initial_time,
           .t1 = Chain::final_time,
           .amplitude = amplitude,
           .reference = [trajectory](double t) { return (*trajectory)(t); }},
          Chain::final_time,
          std::numbers::pi / chain_frequencies()[0]};
}

}  // namespace

const Case& free_duffing_case() {
  static const Case c =
      make_free_duffing("duffing", {}, problems::Duffing::initial_state(), problems::Duffing::final_time);
  return c;
}

const Case& held_back_case() {
  static const Case c = make_free_duffing("held-back", problems::Duffing{.hardening = 10}, {2, 0}, 100);
  return c;
}

const Case& impact_case() {
  static const Case c = make_impact();
  return c;
}

const ivp::System& impact_in_two_intervals() {
  static const ivp::System system(QuietImpact{});
  return system;
}

const Case& three_mass_case() {
  static const Case c = make_three_masses();
  return c;
}

double duffing_period() {
  const problems::Duffing problem;
  return static_cast<double>(problem.period(Extended(problem.initial_state()[0])));
}

double impact_end() { return problems::ImpactDuffing{}.duration; }

Eigen::Vector3d chain_frequencies() {
  const problems::ThreeMassChain c;
  Eigen::Matrix3d K;
  K << c.k1 + c.k2, -c.k2, 0, -c.k2, c.k2 + c.k3, -c.k3, 0, -c.k3, c.k3 + c.k4;
  const Eigen::Matrix3d M = Eigen::Vector3d(c.m1, c.m2, c.m3).asDiagonal();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(K, M).eigenvalues().cwiseSqrt();
}

double root_mean_square(std::span<const double> errors) {
  if (errors.empty()) throw std::invalid_argument("root_mean_square: no value");
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace nlmech::chapters::rbf_ivp
