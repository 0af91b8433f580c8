#include "nlmech/spacecraft/plant/poles.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/sign_change.hpp"

namespace nlmech::spacecraft {
namespace {

/// Function whose zeros are sought: real on the imaginary axis, as a function of omega, and entire as a
/// function of z = s^2.
struct Characteristic {
  double beta_unit;
  std::function<double(double)> on_axis;
  AnalyticFunction of_square;
};

/// Characteristic function from @p part, which evaluates numerator or denominator of a transfer function on a
/// motion. Divided by s^2 if the appendages swing about pinned roots, where D_0 and D_0 B vanish at s = 0.
template <class Part>
Characteristic characteristic(const Plant& plant, const Part& part, bool divide = false) {
  const Ratios ratios = plant.appendage().ratios();
  const double unit = plant.appendage().beta_unit(), least = divide ? 1e-10 / std::sqrt(unit) : 0;
  return {unit,
          [&plant, part, divide, least](double omega) {
            const Motion<double> m = plant.appendage().motion_at_frequency(std::max(omega, least));
            return divide ? part(m) / m.b : part(m);
          },
          [ratios, unit, part, divide](Complex z) {
            const Jet b(z * unit, Complex(unit));
            const Jet f = part(std::abs(b.value) < series_limit ? motion_by_series(ratios, b)
                                                                : motion_by_waves(ratios, b));
            return divide ? f / b : f;
          }};
}

/// Zeros by sign changes in steps of @p step of |beta|^(1/4) L, until @p enough returns true.
template <class Enough>
std::vector<double> scan(const Characteristic& c, double step, const Enough& enough) {
  std::vector<double> found;
  const double unit = std::sqrt(c.beta_unit);
  const auto at = [&](int i) { return (i * step) * (i * step) / unit; };
  double before = c.on_axis(0);
  for (int i = 1; !enough(found, at(i - 1)); ++i) {
    const double here = c.on_axis(at(i));
    if ((here > 0) != (before > 0)) found.push_back(sign_change(c.on_axis, at(i - 1), at(i)));
    before = here;
  }
  return found;
}

Frequencies frequencies(const Plant& plant, int count, const Characteristic& c, const char* what) {
  if (count < 1) throw invalid_argument("{}: a count of {}", what, count);
  const std::size_t wanted = static_cast<std::size_t>(count) + 1;
  // Zeros are about pi apart; a heavy tip body adds two low ones.
  const double last = (count + 20) * std::numbers::pi, highest = last * last / std::sqrt(c.beta_unit);
  Frequencies all;
  for (double step = 0.2; step > 1e-3; step /= 4) {
    all.omega = scan(c, step, [&](const std::vector<double>& found, double omega) {
      return found.size() >= wanted || omega > highest;
    });
    if (all.omega.size() < wanted) continue;
    const double end = (all.omega[wanted - 2] + all.omega[wanted - 1]) / 2, side = end * end;
    const RootCount counted = count_roots(c.of_square, {-side, side / 16, -side / 2, side / 2});
    all.counted = counted.count;
    all.status = counted.status;
    if (counted.status.ok() && counted.count == count) {
      all.omega.resize(wanted - 1);
      return all;
    }
  }
  all.omega.resize(std::min(all.omega.size(), wanted - 1));
  if (all.status.ok()) {
    all.status = failed_with(Outcome::not_converged,
                             "{}: {} found, {} counted by the argument principle, up to {} rad/s for {}; "
                             "some lie too close to each other",
                             what, all.omega.size(), all.counted, all.omega.empty() ? 0. : all.omega.back(),
                             plant.parameters().has_tip() ? "a spacecraft with tip bodies" : "one without");
  }
  return all;
}

/// Appends the roots s of s^2 = z with Im s >= 0.
void append(std::vector<Complex>& s, Complex z) {
  const Complex root = std::sqrt(z);
  if (z.imag() == 0 && z.real() < 0) {
    s.emplace_back(0, std::sqrt(-z.real()));
  } else if (z.imag() == 0) {
    s.push_back(root);
    s.push_back(-root);
  } else {
    s.push_back(root.imag() > 0 ? root : -root);
  }
}

}  // namespace

Frequencies poles(const Plant& plant, int count) {
  const auto part = [&plant](const auto& m) { return plant.effective_inertia(m); };
  return frequencies(plant, count, characteristic(plant, part, plant.parameters().swings()), "poles");
}

Frequencies hub_zeros(const Plant& plant, int count) {
  const auto part = [](const auto& m) { return m.determinant; };
  return frequencies(plant, count, characteristic(plant, part, plant.parameters().swings()), "hub zeros");
}

Zeros deflection_zeros(const Plant& plant, double x, double omega) {
  plant.appendage().require_place(x);
  if (x == 0 || (x == plant.parameters().length && plant.parameters().tip_stays()))
    throw invalid_argument("deflection_zeros: y is always 0 at x = {}", x);
  if (!(omega > 0) || !std::isfinite(omega))
    throw invalid_argument("deflection_zeros: up to {} rad/s", omega);
  const auto part = [&plant, x](const auto& m) { return plant.appendage().deflection(m, x); };
  const Characteristic c = characteristic(plant, part);

  Zeros zeros;
  double side = omega * omega;
  RootCount counted;
  // If a zero lies on the boundary, enlarge the square.
  for (int i = 0; i < 5; ++i, side *= 1.0171) {
    counted = count_roots(c.of_square, {-side, side, -side, side});
    if (counted.status.ok()) break;
  }
  zeros.counted = counted.count;
  zeros.status = counted.status;
  if (!counted.status.ok()) return zeros;

  const double end = std::sqrt(side);
  std::vector<double> axis =
      scan(c, 0.1, [&](const std::vector<double>& /*found*/, double at) { return at > end; });
  while (!axis.empty() && axis.back() > end) axis.pop_back();
  for (const double w : axis) append(zeros.s, Complex(-w * w));
  if (static_cast<int>(axis.size()) != zeros.counted) {
    const Roots all = find_roots(c.of_square, {-side, side, -side, side});
    zeros.s.clear();
    for (const Complex& z : all.roots)
      append(zeros.s, std::abs(z.imag()) <= 1e-11 * std::abs(z) ? Complex(z.real()) : z);
    zeros.status = all.status;
  }
  std::sort(zeros.s.begin(), zeros.s.end(), [](const Complex& a, const Complex& b) {
    const double x1 = std::abs(a), x2 = std::abs(b);
    return x1 != x2 ? x1 < x2 : a.real() < b.real();
  });
  return zeros;
}

}  // namespace nlmech::spacecraft
