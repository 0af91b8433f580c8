#include "nlmech/spacecraft/control/closed_loop.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// Margin of a band beyond the bounds of the poles' real parts, relative to its height.
constexpr double band_margin = 0.3;

void require(bool right, const char* name, const char* range, double value) {
  if (!right) throw invalid_argument("{} = {:g}: it must be {}", name, value, range);
}

void require_finite(const Gains& g) {
  require(std::isfinite(g.k1), "k1", "finite", g.k1);
  require(std::isfinite(g.k2), "k2", "finite", g.k2);
  require(std::isfinite(g.k3), "k3", "finite", g.k3);
}

/// Zeros of I_hub + kappa B: frequencies of the closed loop for k1 = k3 = 0. The bands end midway between
/// them. They are the poles of a spacecraft with 2/kappa of the hub inertia.
Frequencies undamped(const Parameters& parameters, double kappa, int count) {
  Parameters p = parameters;
  // A larger hub inertia does not change the frequencies in double precision.
  const double beam = p.mass_per_length * p.length * p.length * p.length;
  p.hub_inertia = std::min(p.hub_inertia * (2 / kappa), std::max(p.hub_inertia, 1e60 * beam));
  return poles(Plant(p), count);
}

}  // namespace

ClosedLoop::ClosedLoop(const Parameters& parameters, const Gains& gains) : plant_(parameters), gains_(gains) {
  require_finite(gains);
  require(gains.k1 >= 0, "k1", "at least 0", gains.k1);
  require(gains.k2 > -2, "k2", "above -2, at which the appendages exert no torque on the hub", gains.k2);
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
  // Rounding of the sum is relative to the moduli of its two terms.
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
  t.inertia = inertia.value;
  t.determinant = motion.determinant.value;
  t.open_loop = plant_.effective_inertia(motion).value;
  for (const double place : x) t.shapes.push_back(plant_.appendage().deflection(motion, place).value);
  return t;
}

// With z = -s, Re z = a > 0: Re[z B(z)] = sum c^2 omega^2 a (|z|^2 + omega^2)/|z^2 + omega^2|^2 >= a B(|z|),
// because B is positive and decreasing on the real axis. So a pole with |Im| <= top satisfies a [I_hub +
// kappa B(|(a, top)|)] <= k3. To the left of the second bound waves from the tip are negligible (exp(-2 q) is
// below rounding for both wave numbers); fast_poles() finds these poles.
double ClosedLoop::least_real_part(double top) const {
  const double hub = parameters().hub_inertia;
  const double scale = 1 / std::sqrt(plant_.appendage().beta_unit());
  const double waves = scale * std::max(700., 40 * std::sqrt(top / scale));
  const double largest = hub > 0 ? std::min(gains_.k3 / hub, waves) : waves;
  double reach = 0;
  for (double a = 1e-6 * scale; a < 1.5 * largest; a *= 1.5) {
    const double inertia = plant_.appendage().inertia(Complex(std::hypot(a, top))).real();
    // Between two grid points the left side of the inequality changes by a factor of at most 1.5.
    if (a * (hub + kappa() * inertia) <= 1.5 * gains_.k3) reach = a;
  }
  return -std::min(1.5 * reach, 1.01 * largest);
}

// With waves from the root alone, s = -y^2 in the appendage's unit of time, |arg y| <= pi/4, and eta = r/L, B
// = rho L^3 sqrt 2 (eta^2 y^2 + sqrt 2 eta y + 1)/y^3 up to signs, and P is a polynomial in y.
std::vector<Complex> ClosedLoop::fast_poles() const {
  if (!parameters().is_cantilever()) return {};
  const double unit = plant_.appendage().beta_unit(), root2 = std::sqrt(2.);
  const double eta = plant_.appendage().ratios().hub, length = parameters().length;
  const double beam = kappa() * parameters().mass_per_length * length * length * length / unit;
  std::vector<double> p = {gains_.k1, root2 * beam, 2 * eta * beam - gains_.k3 / std::sqrt(unit),
                           root2 * beam * eta * eta, parameters().hub_inertia / unit};
  while (p.size() > 2 && p.back() == 0) p.pop_back();
  const std::size_t degree = p.size() - 1;
  // Scales y so that the first and last coefficients have the same size.
  const double y_unit = std::pow(std::max(p[0], 1e-300) / p.back(), 1 / static_cast<double>(degree));
  std::vector<Complex> scaled;
  for (std::size_t i = 0; i < degree; ++i)
    scaled.emplace_back(p[i] / p.back() / std::pow(y_unit, static_cast<double>(degree - i)));
  std::vector<Complex> poles;
  if (!std::ranges::all_of(scaled, is_finite)) return poles;
  for (const Complex& zero : polynomial_zeros(scaled)) {
    const Complex y = y_unit * zero;
    // Only the conjugate with Im s >= 0.
    if (!(y.real() > 0 && y.imag() <= 0 && -y.imag() <= y.real())) continue;
    const Complex s = -y * y / std::sqrt(unit);
    const Root exact = refine_root([this](Complex z) { return characteristic(z); }, s);
    poles.push_back(exact.status.ok() && std::abs(exact.s - s) < 1e-6 * std::abs(s) ? exact.s : s);
  }
  return poles;
}

/// Poles with imaginary parts between @p bottom and @p top. If a pole lies at @p top, that is moved by a
/// fraction of its distance from @p next.
Roots ClosedLoop::band(double bottom, double& top, double next, double& left) const {
  const double first = top;
  const AnalyticFunction f = [this](Complex s) { return characteristic(s); };
  Roots roots;
  for (const double shift : {0., 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4}) {
    top = first + shift * (next - first);
    const double margin = band_margin * (top - std::max(bottom, 0.));
    left = least_real_part(top) - margin;
    roots = find_roots(f, {left, margin, bottom, top});
    if (roots.status.ok()) return roots;
  }
  return roots;
}

// A real pole is found with an imaginary part from rounding. Newton's iteration from its real part converges
// to it again, but not to a pole of a conjugate pair.
Complex ClosedLoop::on_real_axis(Complex s) const {
  if (std::abs(s.imag()) > 1e-6 * std::abs(s)) return s;
  const Root real = refine_root([this](Complex z) { return characteristic(z); }, s.real());
  const bool same = real.status.ok() && std::abs(real.s - s) <= 1e-6 * std::abs(s) &&
                    std::abs(real.s.imag()) <= 1e-13 * std::abs(s);
  return same ? Complex(real.s.real()) : s;
}

/// Roots of a band, with those next to the real axis made real or conjugate pairs. Two nearly coincident
/// roots are accurate only to the square root of rounding; so they are classified together.
std::vector<Complex> ClosedLoop::settled(const std::vector<Complex>& roots) const {
  std::vector<Complex> all;
  std::vector<bool> done(roots.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double size = std::abs(roots[i]);
    if (done[i]) continue;
    if (std::abs(roots[i].imag()) > 1e-6 * size) {
      all.push_back(roots[i]);
      continue;
    }
    std::vector<std::size_t> near;
    double sum = 0;
    for (std::size_t k = i; k < roots.size(); ++k) {
      if (done[k] || std::abs(roots[k] - roots[i]) > 1e-5 * size) continue;
      near.push_back(k);
      sum += roots[k].real();
    }
    if (near.size() > 1) {
      const double centre = sum / static_cast<double>(near.size());
      const ZeroCluster zeros =
          zeros_in_circle([this](Complex s) { return characteristic(s); }, centre, 1e-4 * size);
      if (zeros.status.ok() && zeros.zeros.size() == near.size()) {
        for (const Complex& z : zeros.zeros) all.push_back(centre + z);
        for (const std::size_t k : near) done[k] = true;
        continue;
      }
    }
    all.push_back(on_real_axis(roots[i]));
  }
  return all;
}

LoopPoles ClosedLoop::poles(int count, PoleOrder order) const {
  if (count < 1 || count > 5000)
    throw invalid_argument("closed-loop poles: count = {}; 1 to 5000 are possible", count);
  require_restored(parameters(), "closed-loop poles");
  const Frequencies cuts = undamped(parameters(), kappa(), count + 3);
  LoopPoles found;
  if (!cuts.status.ok()) return {{}, cuts.status};
  if (const double a = 700 / std::sqrt(plant_.appendage().beta_unit());
      !parameters().is_cantilever() &&
      a * (parameters().hub_inertia + kappa() * plant_.appendage().inertia(Complex(a)).real()) <=
          1.5 * gains_.k3) {
    return {{},
            failed_with(Outcome::outside_validity,
                        "closed-loop poles: a pole may lie beyond Re s = {:g}, where only those of "
                        "appendages with clamped roots and free tips are found; choose a smaller k3",
                        -a)};
  }
  const std::vector<Complex> fast = fast_poles();
  double bottom = 0, top = 0;
  for (std::size_t i = 0; i + 2 < cuts.omega.size(); ++i) {
    const double middle = (cuts.omega[i] + cuts.omega[i + 1]) / 2;
    top = middle;
    double left = 0;
    const Roots roots =
        band(i == 0 ? -middle : bottom, top, (cuts.omega[i + 1] + cuts.omega[i + 2]) / 2, left);
    if (!roots.status.ok()) {
      found.status = failed_with(roots.status.outcome(), "closed-loop poles between {:g} and {:g} rad/s: {}",
                                 bottom, top, roots.status.sentence());
      return found;
    }
    for (const Complex s : settled(roots.roots)) {
      if (s.imag() >= 0) found.s.push_back(s);
    }
    for (const Complex s : fast) {
      if (s.real() < left && s.imag() <= top && (s.imag() > bottom || i == 0))
        found.s.push_back(on_real_axis(s));
    }
    bottom = top;
    const auto certain =
        std::count_if(found.s.begin(), found.s.end(), [&](Complex s) { return std::abs(s) <= top; });
    if (certain >= count) break;
  }
  std::stable_sort(found.s.begin(), found.s.end(),
                   [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  const auto last = static_cast<std::size_t>(count) - 1;
  if (found.s.size() <= last || std::abs(found.s[last]) > top) {
    found.status = failed_with(Outcome::not_converged,
                               "closed-loop poles: {} of {} found up to {:g} rad/s; ask for fewer",
                               found.s.size(), count, top);
  }
  if (found.s.size() <= last) return found;
  double highest = 0;
  for (std::size_t k = 0; k <= last; ++k) highest = std::max(highest, found.s[k].imag());
  std::vector<Complex> selected;
  for (std::size_t k = 0; k < found.s.size(); ++k) {
    if (k <= last || (order == PoleOrder::frequency && found.s[k].imag() <= highest))
      selected.push_back(found.s[k]);
  }
  found.s = std::move(selected);
  return found;
}

}  // namespace nlmech::spacecraft
