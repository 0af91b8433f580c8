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
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
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
  const Extended X = problem.amplitude(x0);
  const Extended period = problem.period(X);
  const double greatest_speed = std::sqrt(2 * problem.energy(x0));
  return {{.name = std::move(name),
           .system = ivp::System(problem.text()),
           .x0 = x0,
           .t0 = 0,
           .t1 = end,
           .amplitude = {static_cast<double>(X), greatest_speed},
           .reference = [=](double t) { return elliptic(problem, X, period, t); }},
          static_cast<double>(100 * period),
          static_cast<double>(period / 2)};
}

Case make_impact() {
  const problems::TextProblem problem("impact");
  const auto trajectory = trajectory_of(problem, problem.final_time + beyond);
  const ivp::State after = (*trajectory)(impact_end()).cast<double>();
  const problems::Duffing free;
  return {{.name = "impact",
           .system = ivp::System(problem),
           .x0 = problem.initial_state(),
           .t0 = problem.initial_time,
           .t1 = problem.final_time,
           .amplitude = {free.amplitude(after), std::sqrt(2 * free.energy(after))},
           .reference = [trajectory](double t) { return (*trajectory)(t); }},
          499,
          free.period(free.amplitude(after)) / 2};
}

/// The impact problem without its list of kinks.
struct QuietImpact {
  static constexpr int dimension = Eigen::Dynamic;
  problems::TextProblem full{"impact"};
  [[nodiscard]] int size() const { return full.size(); }
  template <class T, int m>
  void acceleration(const T& t, const Vector<T, m>& q, const Vector<T, m>& v, Vector<T, m>& a) const {
    full.acceleration(t, q, v, a);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, Eigen::Dynamic>& x, Vector<T, Eigen::Dynamic>& dxdt) const {
    full(t, x, dxdt);
  }
};

Case make_three_masses() {
  const problems::TextProblem chain("three-dof");
  const double end = chain.final_time;
  const auto trajectory = trajectory_of(chain, end + beyond);
  ivp::State amplitude = ivp::State::Zero(6);
  constexpr int samples = 20'000;
  for (int i = 0; i <= samples; ++i) {
    const ivp::State x = (*trajectory)(end * i / samples).cast<double>();
    amplitude = amplitude.cwiseMax(x.cwiseAbs());
  }
  return {{.name = "three-masses",
           .system = ivp::System(chain),
           .x0 = chain.initial_state(),
           .t0 = chain.initial_time,
           .t1 = end,
           .amplitude = amplitude,
           .reference = [trajectory](double t) { return (*trajectory)(t); }},
          end,
          std::numbers::pi / chain_frequencies()[0]};
}

}  // namespace

const Case& free_duffing_case() {
  static const Case c = make_free_duffing("duffing", {}, {1, 0}, 500);
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

double duffing_period() { return static_cast<double>(problems::Duffing{}.period(Extended(1))); }

double impact_end() { return problems::TextProblem("impact").parameter("duration"); }

Eigen::Vector3d chain_frequencies() {
  // Of the equations' linear part (0 1; -M^-1 K, -M^-1 C).
  const problems::TextProblem chain("three-dof");
  const Eigen::MatrixXd& linear = chain.linear_terms().a;
  const Eigen::Matrix3d M =
      Eigen::Vector3d(chain.parameter("m1"), chain.parameter("m2"), chain.parameter("m3")).asDiagonal();
  const Eigen::Matrix3d K = -M * linear.bottomLeftCorner<3, 3>();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(K, M).eigenvalues().cwiseSqrt();
}

double root_mean_square(std::span<const double> errors) {
  if (errors.empty()) throw std::invalid_argument("root_mean_square: no value");
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace nlmech::chapters::rbf_ivp
