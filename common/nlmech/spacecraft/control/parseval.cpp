#include "nlmech/spacecraft/control/parseval.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

using Three = std::array<double, 3>;  // error, torque, deflection

void require_gain(const char* name, double value) {
  if (!(value > 0)) throw invalid_argument("costs: {} = {:g}; it must be positive", name, value);
}

/// |e|^2, |u|^2, |y|^2 at s = j omega for a unit step, where B and g_3 are real. Multiplied by D_0
/// throughout, so that a hub-locked resonance does no harm.
Three densities(const ClosedLoop& loop, double omega, double x) {
  const Gains& g = loop.gains();
  const Motion<double> motion = loop.plant().appendage().motion_at_frequency(omega);
  const double square = omega * omega, d0 = motion.determinant;
  const double inertia = loop.plant().effective_inertia(motion, loop.kappa());
  const double open = loop.plant().effective_inertia(motion);
  const double shape = loop.plant().appendage().deflection(motion, x);
  const double real = g.k1 * d0 - square * inertia, imaginary = g.k3 * omega * d0;
  const double p = real * real + imaginary * imaginary;
  const double error = square * inertia * inertia + g.k3 * g.k3 * d0 * d0;
  const double torque = g.k1 * omega * open, deflection = g.k1 * omega * shape;
  return {error / p, torque * torque / p, deflection * deflection / p};
}

/// The length on which the densities change at omega = @p at: how far the nearest pole is from there.
double scale_at(const std::vector<Complex>& poles, double at) {
  double least = std::numeric_limits<double>::infinity();
  for (const Complex p : poles) least = std::min(least, std::abs(p - Complex(0, at)));
  return std::max(least, 1e-13 * at);
}

/// The integral over [a, b] in the variable v of omega = centre + width sinh v.
void add_stretched(const ClosedLoop& loop, double x, double centre, double width, double a, double b,
                   Three& sum) {
  const double first = std::asinh((a - centre) / width), last = std::asinh((b - centre) / width);
  const int count = std::max(1, static_cast<int>(std::ceil((last - first) / 0.5)));
  const double half = (last - first) / count / 2;
  for (int i = 0; i < count; ++i) {
    const double middle = first + (2 * i + 1) * half;
    for (const GaussPoint& g : gauss_rule) {
      const double v = middle + g.place * half;
      const Three d = densities(loop, centre + width * std::sinh(v), x);
      const double weight = g.weight * half * width * std::cosh(v);
      for (std::size_t j = 0; j < 3; ++j) sum[j] += weight * d[j];
    }
  }
}

/// The limit of S(h) = S + c1 h + c2 h^2 + c3 h^3 for h to 0, from four values.
double limit(const std::array<double, 4>& h, std::array<double, 4> s) {
  for (std::size_t level = 1; level < 4; ++level) {
    for (std::size_t i = 3; i >= level; --i)
      s[i] = (h[i - level] * s[i] - h[i] * s[i - 1]) / (h[i - level] - h[i]);
  }
  return s[3];
}

}  // namespace

StepCosts step_costs(const Parameters& parameters, const Gains& gains, double x) {
  const ClosedLoop loop(parameters, gains);
  require_gain("k1", gains.k1);
  require_gain("k3", gains.k3);
  const Statics s = statics(parameters, x);
  const double hub = parameters.hub_inertia, inertia = parameters.appendage_inertia(), kappa = loop.kappa();
  const double half = gains.k1 * gains.k1 / (2 * gains.k3);
  StepCosts c{};
  c.error = gains.k3 / (2 * gains.k1) + (hub + kappa * inertia) / (2 * gains.k3);
  c.rate = gains.k1 / (2 * gains.k3);
  c.acceleration = hub > 0 ? half / hub : std::numeric_limits<double>::infinity();
  c.torque = half * (hub + 4 * inertia / kappa);
  c.deflection = 2 * half * s.square / kappa;
  c.deflection_dot = half * s.green / kappa;
  return c;
}

QuadratureCosts costs_by_quadrature(const Parameters& parameters, const Gains& gains, double x, int modes) {
  const ClosedLoop loop(parameters, gains);
  require_gain("k1", gains.k1);
  require_gain("k3", gains.k3);
  loop.plant().appendage().require_place(x);
  if (modes < 16 || modes > 2000)
    throw invalid_argument("costs by quadrature: modes = {}; 16 to 2000 are possible", modes);
  QuadratureCosts costs;
  LoopPoles poles = loop.poles(modes + 8);
  const Frequencies cuts = hub_zeros(loop.plant(), modes);
  costs.status = poles.status.ok() ? cuts.status : poles.status;
  if (!costs.status.ok()) return costs;
  std::sort(poles.s.begin(), poles.s.end(), [](Complex p, Complex q) { return p.imag() < q.imag(); });
  // The densities have no singularities but poles. Each piece between neighbouring marks, which are the
  // poles' frequencies and the cuts, is halved, and each half is stretched about its mark: there every pole
  // is at least as far from a point as the stretch assumes.
  Three sum{};
  std::array<std::array<double, 4>, 3> sums{};
  std::array<double, 4> step{};
  std::size_t stage = 0, next = 0;
  double a = 0;
  const auto integrate_to = [&](double b) {
    if (!(b > a)) return;
    const double middle = (a + b) / 2;
    add_stretched(loop, x, a, scale_at(poles.s, a), a, middle, sum);
    add_stretched(loop, x, b, scale_at(poles.s, b), middle, b, sum);
    a = b;
  };
  for (int n = 1; n <= modes; ++n) {
    const double end = cuts.omega[static_cast<std::size_t>(n) - 1];
    for (; next < poles.s.size() && poles.s[next].imag() <= end; ++next) integrate_to(poles.s[next].imag());
    integrate_to(end);
    if (n == modes / 8 || n == modes / 4 || n == modes / 2 || n == modes) {
      step[stage] = 1 / std::sqrt(end);
      for (std::size_t j = 0; j < 3; ++j) sums[j][stage] = sum[j];
      ++stage;
    }
  }
  costs.error = limit(step, sums[0]) / std::numbers::pi;
  costs.torque = limit(step, sums[1]) / std::numbers::pi;
  costs.deflection = limit(step, sums[2]) / std::numbers::pi;
  costs.change = (sums[1][3] - sums[1][2]) / sums[1][3];
  return costs;
}

}  // namespace nlmech::spacecraft
