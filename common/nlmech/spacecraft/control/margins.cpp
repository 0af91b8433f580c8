#include "nlmech/spacecraft/control/margins.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/sign_change.hpp"

namespace nlmech::spacecraft {
namespace {

using std::numbers::pi;

void require_modes(const ClosedLoop& loop, int modes) {
  if (modes < 1 || modes > 1000) throw invalid_argument("margins: modes = {}; 1 to 1000 are possible", modes);
  if (loop.gains().k1 <= 0 || loop.gains().k3 <= 0)
    throw invalid_argument("margins: k1 = {:g} and k3 = {:g} must be positive for a stable loop",
                           loop.gains().k1, loop.gains().k3);
}

/// L = numerator/denominator at j omega, both times D_0: entire functions of omega.
struct Parts {
  Complex numerator;   ///< (k1 + k3 s) D_0 + k2 s^2 B D_0
  double denominator;  ///< s^2 (I_hub + 2B) D_0
};

Parts parts(const ClosedLoop& loop, double omega) {
  const Motion<double> motion = loop.plant().appendage().motion_at_frequency(omega);
  const Gains& g = loop.gains();
  const double square = omega * omega, d0 = motion.determinant;
  const double load = loop.plant().appendage().inertia(motion);
  return {{g.k1 * d0 - g.k2 * square * load, g.k3 * omega * d0},
          -square * (loop.parameters().hub_inertia * d0 + 2 * load)};
}

/// (|N|^2 - |D|^2)/(|N|^2 + |D|^2): positive if |L| > 1.
double excess(const ClosedLoop& loop, double omega) {
  const Parts p = parts(loop, omega);
  const double n = std::norm(p.numerator), d = p.denominator * p.denominator;
  return (n - d) / (n + d);
}

Crossover crossover(const ClosedLoop& loop, double a, double b) {
  const double omega = sign_change([&](double at) { return excess(loop, at); }, a, b);
  const Parts p = parts(loop, omega);
  const double phase = std::arg(-p.numerator / p.denominator);
  return {omega, phase, (phase > 0 ? phase : phase + 2 * pi) / omega};
}

/// Points of [a, b], graded towards both ends down to 1e-13 of b, where |L| changes rapidly.
std::vector<double> graded(double a, double b) {
  std::vector<double> points;
  const double half = (b - a) / 2;
  std::vector<double> distances;
  double distance = half;
  while (distance > 1e-13 * b) {
    distances.push_back(distance);
    distance /= 1.35;
  }
  points.push_back(a);
  for (std::size_t i = distances.size(); i-- > 0;) points.push_back(a + distances[i]);
  for (const double d : distances) points.push_back(b - d);
  points.push_back(b);
  return points;
}

}  // namespace

Complex loop_gain(const ClosedLoop& loop, double omega) {
  const Parts p = parts(loop, omega);
  return p.numerator / p.denominator;
}

double sensitivity(const ClosedLoop& loop, double omega) {
  const Parts p = parts(loop, omega);
  return std::abs(p.denominator) / std::abs(p.numerator + p.denominator);
}

Margins margins(const ClosedLoop& loop, int modes) {
  require_modes(loop, modes);
  Margins m;
  // |L| can cross 1 near its poles, those of the open loop, and near its zeros and the hub-locked resonances.
  const Frequencies open = poles(loop.plant(), modes), locked = hub_zeros(loop.plant(), modes);
  m.status = open.status.ok() ? locked.status : open.status;
  if (!m.status.ok()) return m;
  std::vector<double> marks = {1e-9 * locked.omega[0]};
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(modes); ++i) {
    marks.push_back(locked.omega[i]);
    marks.push_back(open.omega[i]);
  }
  marks.push_back(locked.omega.back());
  double before = excess(loop, marks[0]), at = marks[0];
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    for (const double omega : graded(marks[i], marks[i + 1])) {
      const double here = excess(loop, omega);
      if ((here > 0) != (before > 0)) m.crossovers.push_back(crossover(loop, at, omega));
      before = here;
      at = omega;
    }
  }
  m.phase_margin = pi;
  m.delay_margin = std::numeric_limits<double>::infinity();
  for (const Crossover& c : m.crossovers) {
    m.phase_margin = std::min(m.phase_margin, std::abs(c.phase_margin));
    m.delay_margin = std::min(m.delay_margin, c.delay);
  }
  // With all gains multiplied by g the loop is stable for g k2 > -2.
  m.gain_margin = loop.gains().k2 < 0 ? -2 / loop.gains().k2 : std::numeric_limits<double>::infinity();
  return m;
}

std::vector<SensitivityPeak> sensitivity_peaks(const ClosedLoop& loop, int modes) {
  require_modes(loop, modes);
  const LoopPoles poles = loop.poles(modes + 1);
  std::vector<SensitivityPeak> peaks;
  for (std::size_t k = 0; k + 1 < poles.s.size(); ++k) {
    const Complex p = poles.s[k];
    const double below = k == 0 ? p.imag() : (p.imag() - poles.s[k - 1].imag()) / 2;
    const double above = (poles.s[k + 1].imag() - p.imag()) / 2;
    const double a = p.imag() - std::min(8 * std::abs(p.real()), below);
    const double b = p.imag() + std::min(8 * std::abs(p.real()), above);
    // Coarse sampling, then Brent's method around the best sample.
    constexpr int parts = 64;
    const double step = (b - a) / parts;
    double best = std::max(a, step);
    for (int i = 0; i <= parts; ++i) {
      const double omega = a + i * step;
      if (omega > 0 && sensitivity(loop, omega) > sensitivity(loop, best)) best = omega;
    }
    // The argument is the offset from there: relative to omega a peak can be narrower than the square root of
    // rounding.
    const auto negative = [&](double steps) { return -sensitivity(loop, best + steps * step); };
    const auto [at, value] = boost::math::tools::brent_find_minima(
        negative, best - step < a ? 0. : -1., best + step > b ? 0. : 1., std::numeric_limits<double>::digits);
    peaks.push_back({best + at * step, -value});
  }
  return peaks;
}

DelayedPoles delayed_poles(const ClosedLoop& loop, double delay, int modes) {
  require_modes(loop, modes);
  if (!(delay >= 0) || !std::isfinite(delay))
    throw invalid_argument("delayed_poles: the delay is {:g}; it must be at least 0", delay);
  const LoopPoles start = loop.poles(modes);
  DelayedPoles result{{}, 0, start.status};
  const Gains g = loop.gains();
  // Q_tau = D + N e^(-s tau), with N and D the numerator and denominator of L times D_0.
  const auto characteristic = [&](Complex s, double tau, Complex& by_delay) {
    const Motion<Jet> motion = loop.plant().appendage().motion_with_slope(s);
    const Jet z = Jet::variable(s), d = z * z * loop.plant().effective_inertia(motion);
    const Jet n =
        (g.k3 * z + Jet(g.k1)) * motion.determinant + g.k2 * z * z * loop.plant().appendage().inertia(motion);
    const Jet late = n * exp(-tau * z);
    by_delay = -s * late.value;
    return d + late;
  };
  for (const Complex first : start.s) {
    // Predictor along ds/dtau = -(dQ/dtau)/(dQ/ds), in steps short against a period; Newton corrector.
    Complex s = first;
    double tau = 0, step = delay;
    // Steps of at most a twentieth of a radian of this pole limit the delay.
    bool followed = 20 * std::abs(first) * delay < 1e5;
    if (!followed) {
      result.status = failed_with(Outcome::step_limit,
                                  "delayed_poles: a delay of {:g} s is {:g} radians of the pole {:g}{:+g}i; "
                                  "ask for fewer modes or a shorter delay",
                                  delay, std::abs(first) * delay, first.real(), first.imag());
    }
    for (int steps = 0; followed && tau < delay; ++steps) {
      Complex by_delay;
      const Jet q = characteristic(s, tau, by_delay);
      const Complex slope = -by_delay / q.slope;
      step = std::min({step * 2, delay - tau, 0.05 / std::abs(s)});
      for (;; step /= 2) {
        const double next = tau + step >= delay ? delay : tau + step;
        const Complex predicted = s + (next - tau) * slope;
        const Root root = refine_root(
            [&](Complex z) {
              Complex unused;
              return characteristic(z, next, unused);
            },
            predicted);
        // Corrections small against the predictor step do not jump to another branch.
        const double limit = 0.2 * std::abs(predicted - s) + 1e-9 * std::abs(s);
        if (root.status.ok() && std::abs(root.s - predicted) <= limit) {
          s = root.s;
          tau = next;
          break;
        }
        if (step < 1e-9 * delay) {
          followed = false;
          break;
        }
      }
      if (!followed || steps > 100000) {
        result.status = failed_with(Outcome::not_converged,
                                    "delayed_poles: the pole from {:g}{:+g}i could not be followed beyond a "
                                    "delay of {:g} s; ask for a shorter one",
                                    first.real(), first.imag(), tau);
        break;
      }
    }
    result.s.push_back(s);
    if (s.real() > 0) ++result.unstable;
  }
  return result;
}

}  // namespace nlmech::spacecraft
