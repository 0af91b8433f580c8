/// Hermitian operators with adaptive steps: every success against matrix exponentials in extended precision
/// and elliptic functions.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Core>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised::ivp_hermitian_test {
namespace {

using Real = long double;
using Square = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::int64_t most_steps = 120'000;  // integrations with more steps are refused, which is cheap
constexpr std::array<std::int64_t, 12> counts = {16,  32,  33,  64,   68,     128,
                                                 137, 256, 528, 1024, 35'376, 262'144};

/// exp(m) by the series of m/2^k, squared k times.
Square exponential(Square m) {
  const Real norm = m.cwiseAbs().rowwise().sum().maxCoeff();
  const int k = norm > 0.5L ? static_cast<int>(std::ceil(std::log2(norm))) + 1 : 0;
  m /= std::ldexp(1.0L, k);
  Square sum = Square::Identity(m.rows(), m.rows()), term = sum;
  for (int i = 1; i < 24; ++i) {
    term = (term * m / static_cast<Real>(i)).eval();
    sum += term;
  }
  for (int i = 0; i < k; ++i) sum = (sum * sum).eval();
  return sum;
}

/// Condition number of the first @p n components for dy/ds = m y from s = 0 to 1: the effect at the end of an
/// error of one tolerance at any s. The error is relative to the state at s, because a motion with beats may
/// end near rest.
/// @param of (growth, size): the effect by component, for the growth from s to the end and the size of y(s)
template <class Of>
ivp::State condition_of(const Square& m, const Column& y, Eigen::Index n, const Of& of) {
  constexpr std::size_t parts = 64;
  std::vector<Square> flow = {Square::Identity(m.rows(), m.rows()), exponential(m / Real(parts))};
  while (flow.size() <= parts) flow.emplace_back(flow[1] * flow.back());
  ivp::State most = ivp::State::Zero(n);
  for (std::size_t k = 0; k <= parts; ++k) {
    const Real growth = flow[parts - k].topLeftCorner(n, n).cwiseAbs().maxCoeff();
    const Real size = flow[k].cwiseAbs().maxCoeff() * y.cwiseAbs().maxCoeff();
    most = most.cwiseMax(of(static_cast<double>(growth), static_cast<double>(size))).eval();
  }
  return most;
}

/// A method, its tolerance, and the corresponding command.
struct Asked {
  std::string method;
  ivp::Settings settings;
  [[nodiscard]] std::string words() const {
    return fmt::format("{} --tolerance {:.17g}", method, *settings.tolerance);
  }
};

Asked ask(Draw& draw) {
  return {draw.one_of({"laier", "argyris", "hoff", "bazzi"}), {.tolerance = draw.log_uniform(1e-10, 1e-2)}};
}

/// A load frequency that equal steps sample at one phase, or any frequency.
double load_frequency(Draw& draw, double interval) {
  if (draw.chance(0.5)) {
    constexpr double turn = 6.283185307179586;
    return turn * static_cast<double>(draw.one_of(counts) * draw.whole(1, 4)) / interval;
  }
  return draw.log_uniform(1e-2, 1e6) / interval;
}

/// Compares the end state with the exact one, in tolerances: the errors of all steps add up, multiplied by @p
/// condition.
Case compare_with_exact(const Asked& asked, const ivp::Solution& s, const Column& exact, double sure,
                        const ivp::State& condition, const std::string& what) {
  if (!s.status.ok()) return Case::refused(s.status.text());
  const double tolerance = *asked.settings.tolerance;
  if (!(sure <= tolerance / 10)) return Case::undecided();
  double worst = 0;
  for (int i = 0; i < s.x.size(); ++i) {
    const double error = static_cast<double>(std::abs(s.x[i] - exact[i]));
    const double steps = 3 * static_cast<double>(s.statistics.steps);
    worst = std::max(worst, error / (tolerance * steps * condition[i]));
  }
  return Case::judged(
      worst, 1, what + fmt::format("; x1 = {:.9g}, right {:.9g}", s.x[0], static_cast<double>(exact[0])));
}

// x'' + 2 zeta w x' + w^2 x = F cos(W t), in the scaled state (x, v/w, cos, sin).
Case oscillator(Draw& draw) {
  const double interval = draw.log_uniform(1e-3, 1e4);
  const double natural =
      draw.chance(0.8) ? draw.log_uniform(1e-1, 1e5) / interval : draw.log_uniform(1, 1e10);
  const double ratio = draw.chance(0.5) ? 0 : draw.log_uniform(1e-6, 10);
  const double force = draw.chance(0.5) ? 0 : draw.signed_log(1e-3, 1e6);
  const double frequency = draw.chance(0.05) ? natural : load_frequency(draw, interval);
  const problems::TextProblem p(
      "linear",
      {{"natural_frequency", natural}, {"damping_ratio", ratio}, {"force", force}, {"frequency", frequency}});
  const ivp::State x0{draw.chance(0.3) ? 0 : draw.signed_log(1e-3, 1e3),
                      draw.chance(0.6) ? 0 : draw.signed_log(1e-3, 1e3)};
  const Asked asked = ask(draw);
  const double backwards = draw.chance(0.2) ? -1 : 1, end = backwards * interval;
  const auto s = ivp::named_integrator(asked.method, asked.settings)(ivp::System(p), x0, 0, end, {},
                                                                     {.steps = most_steps, .seconds = 20});
  const Real w = natural, W = frequency, z = ratio;
  Square m = Square::Zero(4, 4);
  m(0, 1) = w;
  m(1, 0) = -w;
  m(1, 1) = -2 * z * w;
  m(1, 2) = force / w;
  m(2, 3) = -W;
  m(3, 2) = W;
  const Square flow = exponential(m * static_cast<Real>(end));
  Column y(4);
  y << x0[0], x0[1] / w, 1, 0;
  Column exact = (flow * y).head(2);
  exact[1] *= w;
  // Rounding error of the flow and of w in the problem, proportional to the angle.
  const double radians = interval * std::max({natural, frequency, 1.0 / interval}) * (1 + ratio);
  const double size = static_cast<double>(flow.cwiseAbs().maxCoeff() * y.cwiseAbs().maxCoeff()), v = natural;
  const double sure =
      4 * eps * radians * size * std::max(1.0, v / (1 + static_cast<double>(std::abs(exact[1]))));
  const double share = std::min(interval, 1 / v);
  const auto condition =
      condition_of(m * static_cast<Real>(end), y, 2, [&](double growth, double there) -> ivp::State {
        const double X = 1 + there, V = 1 + v * there;
        return {growth * (X + V * share), growth * (V + v * X)};
      });
  return compare_with_exact(
      asked, s, exact, sure, condition,
      fmt::format("linear --set natural_frequency={:.17g} --set damping_ratio={:.17g} --set force={:.17g} "
                  "--set frequency={:.17g} --initial {:.17g},{:.17g} --until {:.17g} --method {}",
                  natural, ratio, force, frequency, x0[0], x0[1], end, asked.words()));
}

// x'' + w^2 x + eta x^3 = 0 from X at rest: X cn.
Case duffing(Draw& draw) {
  const double interval = draw.log_uniform(1e-2, 1e4), amplitude = draw.signed_log(1e-3, 1e2);
  problems::Duffing p{.natural_frequency = draw.log_uniform(0.1, 1e5) / interval};
  p.hardening = draw.log_uniform(1e-4, 1e4) * std::pow(p.natural_frequency / amplitude, 2);
  const Asked asked = ask(draw);
  const auto s = ivp::named_integrator(asked.method, asked.settings)(
      ivp::System(p.text()), {amplitude, 0}, 0, interval, {}, {.steps = most_steps, .seconds = 20});
  if (!s.status.ok()) return Case::refused(s.status.text());
  const Real X = std::abs(amplitude), w2 = Real(p.natural_frequency) * p.natural_frequency,
             add = p.hardening * X * X;
  const Real omega = std::sqrt(w2 + add), k = std::sqrt(add / (2 * (w2 + add)));
  Real cn = 0, dn = 0;
  const Real sn = boost::math::jacobi_elliptic(k, Real(omega * interval), &cn, &dn);
  Column exact(2);
  exact << amplitude * cn, -amplitude * omega * sn * dn;
  const double angle = static_cast<double>(omega) * interval, size = std::abs(amplitude),
               rate = static_cast<double>(omega);
  const double sure =
      8 * eps * (1 + angle) * size * std::max(1.0, rate / (1 + static_cast<double>(std::abs(exact[1]))));
  // An error of the amplitude changes the frequency, so its effect grows with the angle.
  const double grown = 1 + angle, x = 1 + size, v = 1 + rate * size;
  const ivp::State condition{grown * (x + v / rate), grown * (v + rate * x)};
  return compare_with_exact(
      asked, s, exact, sure, condition,
      fmt::format("duffing --set natural_frequency={:.17g} --set hardening={:.17g} --initial {:.17g},0 "
                  "--until {:.17g} --method {}",
                  p.natural_frequency, p.hardening, amplitude, interval, asked.words()));
}

// The chain without its cubic spring, with a load on the second mass.
Case chain(Draw& draw) {
  const double interval = draw.log_uniform(1e-2, 1e3);
  const double k1 = draw.log_uniform(0.1, 1e8), k4 = draw.chance(0.5) ? 0 : draw.log_uniform(0.1, 1e4),
               c1 = draw.chance(0.5) ? 0 : draw.log_uniform(1e-3, 1e3), force = draw.log_uniform(1e-3, 1e3),
               frequency = load_frequency(draw, interval);
  program::Settings set = {{"l1", 0},  {"k1", k1},       {"k4", k4},
                           {"c1", c1}, {"force", force}, {"frequency", frequency}};
  const ivp::System system(problems::TextProblem("three-dof", set));
  set["force"] = 0;
  const ivp::System free(problems::TextProblem("three-dof", set));
  ivp::State x0 = ivp::State::Zero(6);
  if (draw.chance(0.3)) x0[draw.whole(0, 5)] = draw.signed_log(1e-3, 10);
  const Asked asked = ask(draw);
  const auto s = ivp::named_integrator(asked.method, asked.settings)(
      system, x0, 0, interval, {}, {.steps = most_steps / 4, .seconds = 20});
  if (!s.status.ok()) return Case::refused(s.status.text());
  Square m = Square::Zero(8, 8);
  for (int i = 0; i < 6; ++i) {
    ivp::State f;
    free.rhs(0, ivp::State::Unit(6, i), f);  // small integers and parameters: exact up to rounding
    m.col(i).head(6) = f.cast<Real>();
  }
  m(4, 6) = force;  // divided by m2 = 1
  m(6, 7) = -frequency;
  m(7, 6) = frequency;
  Column y = Column::Zero(8);
  y.head(6) = x0.cast<Real>();
  y[6] = 1;
  const Real scale = std::sqrt(std::max(Real(1), Real(k1)));  // velocities are scaled by the fastest motion
  for (int i = 3; i < 6; ++i) {
    m.row(i) /= scale;
    m.col(i) *= scale;
    y[i] /= scale;
  }
  const Square flow = exponential(m * Real(interval));
  Column exact = (flow * y).head(6);
  const double size = static_cast<double>(flow.cwiseAbs().maxCoeff() * y.cwiseAbs().maxCoeff());
  exact.tail(3) *= scale;
  const double fast = static_cast<double>(scale), radians = interval * (fast + frequency + c1 + 1);
  const double sure = 8 * eps * radians * size * fast;
  const auto condition =
      condition_of(m * Real(interval), y, 6, [&](double growth, double there) -> ivp::State {
        ivp::State c(6);
        c.head<3>().setConstant(growth * (1 + there + (1 + fast * there) * interval));
        c.tail<3>().setConstant(growth * (1 + fast * there + fast * (1 + there)));
        return c;
      });
  return compare_with_exact(
      asked, s, exact, sure, condition,
      fmt::format("three-dof --set l1=0 --set k1={:.17g} --set k4={:.17g} --set c1={:.17g} --set "
                  "force={:.17g} --set frequency={:.17g} --until {:.17g} --method {}, x0 ({})",
                  k1, k4, c1, force, frequency, interval, asked.words(),
                  fmt::join(std::vector<double>(x0.begin(), x0.end()), ",")));
}

TEST(RandomisedHermitian, LinearOscillators) {
  randomised_test({.quick = 24, .full = 3000, .least_right = 0.1}, oscillator);
}
TEST(RandomisedHermitian, FreeDuffingOscillators) {
  randomised_test({.quick = 20, .full = 2000, .least_right = 0.1}, duffing);
}
TEST(RandomisedHermitian, LoadsThatNobodyAnnounces) {
  randomised_test({.quick = 28, .full = 1500, .least_right = 0.05}, chain);
}

}  // namespace
}  // namespace nlmech::randomised::ivp_hermitian_test
