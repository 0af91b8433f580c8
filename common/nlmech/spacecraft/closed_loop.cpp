#include "nlmech/spacecraft/closed_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::spacecraft {
namespace {

void require(bool right, const char* name, const char* range, double value) {
  if (!right) throw std::invalid_argument(fmt::format("{} = {:g}: it must be {}", name, value, range));
}

void require_finite(const Gains& g) {
  require(std::isfinite(g.k1), "k1", "finite", g.k1);
  require(std::isfinite(g.k2), "k2", "finite", g.k2);
  require(std::isfinite(g.k3), "k3", "finite", g.k3);
}

/// Zeros of I_hub + kappa B, the closed loop's frequencies without k1 and k3: between them its bands are cut.
/// They are the poles of a spacecraft whose hub weighs 2/kappa of the real one.
Frequencies undamped(const Parameters& parameters, double kappa, int count) {
  Parameters p = parameters;
  p.hub_inertia *= 2 / kappa;
  return poles(Plant(p), count);
}

}  // namespace

StabilityStatement stability(const Gains& g) {
  require_finite(g);
  if (g.k1 < 0)
    return {Stability::unstable, fmt::format("k1 = {:g} < 0: a real pole lies to the right of 0, where P "
                                             "passes from k1 to infinity",
                                             g.k1)};
  if (g.k2 < -2 && g.k3 > 0)
    return {Stability::unstable,
            fmt::format("k2 = {:g} < -2: the hub gains energy from every high mode of the appendages", g.k2)};
  if (g.k2 < -2 || g.k3 < 0)
    return {Stability::unstable,
            fmt::format("k2 = {:g}, k3 = {:g}: the feedback puts energy in", g.k2, g.k3)};
  if (g.k2 == -2)
    return {Stability::marginal, "k2 = -2: the hub does not feel the appendages, which ring on undamped"};
  if (g.k1 == 0 || g.k3 == 0)
    return {Stability::marginal, fmt::format("k1 = {:g}, k3 = {:g}: without {} the angle does not settle",
                                             g.k1, g.k3, g.k3 == 0 ? "rate feedback" : "angle feedback")};
  return {
      Stability::stable,
      "k1, k3 > 0 and k2 > -2: s (I_hub + (2 + k2) B) + k3 + k1/s is positive real, so every pole lies in "
      "the left half plane; the damping of the modes tends to 0 with growing frequency"};
}

ClosedLoop::ClosedLoop(const Parameters& parameters, const Gains& gains) : plant_(parameters), gains_(gains) {
  require_finite(gains);
  require(gains.k1 >= 0, "k1", "at least 0", gains.k1);
  require(gains.k2 > -2, "k2", "above -2, where the hub no longer feels the appendages", gains.k2);
  require(gains.k3 >= 0, "k3", "at least 0", gains.k3);
}

LoopResponse ClosedLoop::response(Complex s, double x) const {
  plant_.appendage().require_place(x);
  if (!is_finite(s)) return {{}, {}, Outcome::non_finite};
  const Motion<Complex> motion = plant_.appendage().motion(s);
  const Complex determinant = motion.determinant;
  const Complex inner = (gains_.k3 * s + gains_.k1) * determinant;
  const Complex outer = s * s * plant_.effective_inertia(motion, kappa());
  const Complex q = inner + outer;
  // Near the axis the sum of two complex terms vanishes as their real and imaginary parts do.
  const double size = std::abs(inner) + std::abs(outer);
  if (std::abs(q) <= 1e-15 * size || size == 0) return {{}, {}, Outcome::at_pole};
  const Complex theta = gains_.k1 * determinant / q;
  const Complex y = gains_.k1 * s * s * plant_.appendage().deflection(motion, x) / q;
  if (!is_finite(theta) || !is_finite(y)) return {{}, {}, Outcome::non_finite};
  return {theta, y, Outcome::success};
}

Jet ClosedLoop::characteristic(Complex s) const {
  const Motion<Jet> motion = plant_.appendage().motion_with_slope(s);
  const Jet variable = Jet::variable(s), inertia = plant_.effective_inertia(motion, kappa());
  if (gains_.k1 == 0 && gains_.k3 == 0) return inertia;
  if (gains_.k1 == 0) return variable * inertia + gains_.k3 * motion.determinant;
  return variable * variable * inertia + (gains_.k3 * variable + Jet(gains_.k1)) * motion.determinant;
}

LoopTerms ClosedLoop::terms(Complex s, std::span<const double> x) const {
  const Motion<Jet> motion = plant_.appendage().motion_with_slope(s);
  const Jet variable = Jet::variable(s), inertia = plant_.effective_inertia(motion, kappa());
  LoopTerms t;
  t.characteristic =
      variable * variable * inertia + (gains_.k3 * variable + Jet(gains_.k1)) * motion.determinant;
  t.determinant = motion.determinant.value;
  t.open_loop = plant_.effective_inertia(motion).value;
  for (const double place : x) t.shapes.push_back(plant_.appendage().deflection(motion, place).value);
  return t;
}

// With z = -s, Re z = a > 0: Re[z B(z)] = sum c^2 omega^2 a (|z|^2 + omega^2)/|z^2 + omega^2|^2 >= a B(|z|),
// B being positive and falling on the real axis. A pole with |Im| <= top thus has a [I_hub + kappa B(|(a,
// top)|)] <= k3.
double ClosedLoop::least_real_part(double top) const {
  const double hub = parameters().hub_inertia;
  const double scale = 1 / std::sqrt(plant_.appendage().beta_unit());
  const double largest = hub > 0 ? std::min(gains_.k3 / hub, 1e9 * scale) : 1e9 * scale;
  double reach = 0;
  double a = 1e-6 * scale;
  while (a < 1.5 * largest) {
    const double inertia = plant_.appendage().inertia(Complex(std::hypot(a, top))).real();
    // Between two points of the grid the left side changes by a factor of 1.5 at most.
    if (a * (hub + kappa() * inertia) <= 1.5 * gains_.k3) reach = a;
    a *= 1.5;
  }
  return -std::min(1.5 * reach, 1.01 * largest);
}

/// The poles between two heights. The upper one is moved towards @p next if a pole lies on it.
Roots ClosedLoop::band(double bottom, double& top, double next) const {
  const double first = top;
  const AnalyticFunction f = [this](Complex s) { return characteristic(s); };
  Roots roots;
  for (const double shift : {0., 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4}) {
    top = first + shift * (next - first);
    const double margin = 0.3 * (top - std::max(bottom, 0.));
    roots = find_roots(f, {least_real_part(top) - margin, margin, bottom, top});
    if (roots.status.ok()) return roots;
  }
  return roots;
}

// A real pole comes with an imaginary part of rounding's size. From its real part Newton's iteration then
// finds it again; the poles of a pair it does not find.
Complex ClosedLoop::on_real_axis(Complex s) const {
  if (std::abs(s.imag()) > 1e-6 * std::abs(s)) return s;
  const Root real = refine_root([this](Complex z) { return characteristic(z); }, s.real());
  const bool same = real.status.ok() && std::abs(real.s - s) <= 1e-6 * std::abs(s) &&
                    std::abs(real.s.imag()) <= 1e-13 * std::abs(s);
  return same ? Complex(real.s.real()) : s;
}

LoopPoles ClosedLoop::poles(int count) const {
  if (count < 1 || count > 5000)
    throw std::invalid_argument(fmt::format("closed-loop poles: count = {}; 1 to 5000 are possible", count));
  const Frequencies cuts = undamped(parameters(), kappa(), count + 3);
  LoopPoles found;
  if (!cuts.status.ok()) return {{}, cuts.status};
  double bottom = 0, top = 0;
  for (std::size_t i = 0; i + 2 < cuts.omega.size(); ++i) {
    const double middle = (cuts.omega[i] + cuts.omega[i + 1]) / 2;
    top = middle;
    const Roots roots = band(i == 0 ? -middle : bottom, top, (cuts.omega[i + 1] + cuts.omega[i + 2]) / 2);
    if (!roots.status.ok()) {
      found.status = Status::failure(roots.status.outcome(),
                                     fmt::format("closed-loop poles between {:g} and {:g} rad/s: {}", bottom,
                                                 top, roots.status.sentence()));
      return found;
    }
    for (const Complex s : roots.roots) {
      const Complex exact = on_real_axis(s);
      if (exact.imag() >= 0) found.s.push_back(exact);
    }
    bottom = top;
    const auto certain =
        std::count_if(found.s.begin(), found.s.end(), [&](Complex s) { return std::abs(s) <= top; });
    if (certain >= count) break;
  }
  std::stable_sort(found.s.begin(), found.s.end(),
                   [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  if (found.s.size() < static_cast<std::size_t>(count) ||
      std::abs(found.s[static_cast<std::size_t>(count) - 1]) > top)
    found.status =
        Status::failure(Outcome::not_converged,
                        fmt::format("closed-loop poles: {} of {} found up to {:g} rad/s; ask for fewer",
                                    found.s.size(), count, top));
  if (found.s.size() > static_cast<std::size_t>(count)) found.s.resize(static_cast<std::size_t>(count));
  return found;
}

}  // namespace nlmech::spacecraft
