#include "chapters/rbf_ivp/examples/cases.hpp"

#include <Eigen/Eigenvalues>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

constexpr double beyond = 5;  // s; reference beyond the printed end, for other readings of the end time

/// Eq. 4.23: x = X cn(omega t | m), v = -X omega sn dn. dn is computed from sn, since Boost's dn is 0/0 where
/// x = 0.
Vector<Extended, 2> elliptic(const problems::Duffing& problem, Extended X, Extended period, double t) {
  const Extended omega = problem.argument_frequency(X), m = problem.elliptic_parameter(X);
  // Reduced to half a period from a maximum, where the functions lose no accuracy.
  const Extended u = omega * std::remainder(Extended(t), period);
  Extended cn = 0;
  const Extended sn = boost::math::jacobi_elliptic(std::sqrt(m), u, &cn, static_cast<Extended*>(nullptr));
  return {X * cn, -X * omega * sn * std::sqrt(1 - m * sn * sn)};
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
  Case c{comparison::example_of(problems::TextProblem("impact"), beyond), 499, 0};
  const ivp::State after = c.reference(impact_end()).cast<double>();
  const problems::Duffing free;
  c.amplitude = {free.amplitude(after), std::sqrt(2 * free.energy(after))};
  c.half_period = free.period(free.amplitude(after)) / 2;
  return c;
}

/// The impact problem without declared discontinuities.
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
  Case c{comparison::example_of(problems::TextProblem("three-dof"), beyond), 0, 0};
  c.name = "three-masses";
  c.inferred_end = c.t1;
  c.half_period = std::numbers::pi / chain_frequencies()[0];
  c.amplitude.setZero();
  constexpr int samples = 20'000;
  for (int i = 0; i <= samples; ++i)
    c.amplitude = c.amplitude.cwiseMax(c.reference(c.t1 * i / samples).cast<double>().cwiseAbs());
  return c;
}

}  // namespace

const Case& free_duffing_case() {
  static const Case c = make_free_duffing("duffing", {}, {1, 0}, 500);
  return c;
}

const Case& holdout_case() {
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
  // From the linear part (0 1; -M^-1 K, -M^-1 C) of the equations.
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
