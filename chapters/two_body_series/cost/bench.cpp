/// @file
/// `two_body_series_bench`: transition matrices against states alone; analytic continuation against RKN12(10)
/// and Odeint's fehlberg78 in its own loop, at equal achieved error, and the overhead of the nlmech step loop
/// for Odeint; by Google Benchmark. Exit code 1 if a claim does not hold.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/native_peers.hpp"
#include "chapters/plain_equations.hpp"
#include "chapters/speed.hpp"
#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/transition.hpp"
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"

namespace {

using namespace nlmech;
namespace two_body = chapters::two_body_series;
using two_body::revolution;
using Place = std::optional<orbit::Vector3<double>>;

constexpr int orbits = 20, phases = 16;
constexpr auto fehlberg78 = peers::Odeint::Formula::fehlberg78;

/// An ellipse with a = 1 and mu = 1 from its periapsis, with reference positions at the end times.
struct Ellipse {
  explicit Ellipse(double eccentricity) : e(eccentricity), start(two_body::on_ellipse(eccentricity)) {
    for (int i = 0; i < phases; ++i) {
      times.push_back(revolution * (orbits - 1 + (i + 0.5) / phases));
      places.push_back(two_body::state_in_50_digits(start, times.back(), 1).position.cast<double>());
    }
  }
  double e;
  orbit::State start;
  std::vector<double> times;
  std::vector<orbit::Vector3<double>> places;
};

/// Integrates from the start to a time with a tolerance; returns nothing after a failure.
using Integrator = std::function<Place(const orbit::State&, double time, double tolerance)>;

struct TimedMethod {
  std::string name;
  Integrator run;
};

template <class Method>
Integrator general(Method (*make)(double tolerance)) {
  return [make, system = ivp::Direct(chapters::PlainTwoBody{})](const orbit::State& s, double time,
                                                                double tolerance) -> Place {
    ivp::State x(6);
    x << s.position, s.velocity;
    const auto end = ivp::integrate(system, x, 0, time, make(tolerance), {}, {.steps = 100'000});
    if (!end.status.ok()) return std::nullopt;
    return orbit::Vector3<double>(end.x[0], end.x[1], end.x[2]);
  };
}

Place by_series(const orbit::State& s, double time, double tolerance) {
  const auto end = orbit::propagate(s, 0, time, orbit::Gravity{}, {.tolerance = tolerance});
  if (!end.status.ok()) return std::nullopt;
  return end.x.position;
}

/// Odeint's own loop on its own state.
Place by_odeint(const orbit::State& s, double time, double tolerance) {
  std::array<double, 6> x;
  std::copy_n(s.position.begin(), 3, x.begin());
  std::copy_n(s.velocity.begin(), 3, x.begin() + 3);
  const auto run = chapters::odeint_alone<6>(chapters::PlainTwoBody{}, fehlberg78);
  if (!run(tolerance, tolerance, 0, time, x.data())) return std::nullopt;
  return orbit::Vector3<double>(x[0], x[1], x[2]);
}

/// Adds all methods on an ellipse. Each uses the fastest tolerance of a sweep whose median |dr|/a over the
/// end times is at most @p wanted.
void add_rows(chapters::Speed& all, const Ellipse& ellipse, double wanted) {
  const auto name_of = [&](const std::string& method) {
    return fmt::format("e = {:g}, {} to {:g}", ellipse.e, method, wanted);
  };
  const Integrator rkn1210 = general<ivp::Rkn1210>([](double tolerance) {
    return ivp::Rkn1210{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  });
  const Integrator stepped = general<peers::OdeintDirect>([](double tolerance) {
    return peers::OdeintDirect{{fehlberg78, tolerance, tolerance}};
  });
  const std::string computed = "analytic-continuation", alone = "odeint-fehlberg78 alone",
                    in_loop = "odeint-fehlberg78 in our loop";
  for (const TimedMethod& method :
       {TimedMethod{computed, by_series}, {"rkn1210", rkn1210}, {in_loop, stepped}, {alone, by_odeint}}) {
    const auto error = [&](double tolerance) -> std::optional<double> {
      // With a tolerance below rounding Odeint's own loop may not terminate; the nlmech loop returns a
      // failure.
      if (method.name == alone && !stepped(ellipse.start, orbits * revolution, tolerance))
        return std::nullopt;
      return chapters::median_error(phases, [&](std::size_t i) -> std::optional<double> {
        const Place end = method.run(ellipse.start, ellipse.times[i], tolerance);
        return end ? std::optional((*end - ellipse.places[i]).norm()) : std::nullopt;
      });
    };
    const auto whole = [run = method.run, start = ellipse.start](double tolerance) {
      return run(start, orbits * revolution, tolerance);
    };
    all.add(chapters::fastest(name_of(method.name), chapters::half_decades(8, 33), wanted, error, whole));
  }
  const auto claim = [&](const std::string& mine, const std::string& peer, double least) {
    all.claim(name_of(mine), name_of(peer), least, fmt::format("{} against {}", name_of(mine), peer));
  };
  claim(computed, "rkn1210", wanted < 1e-9 ? 1.8 : 1.5);
  if (wanted < 1e-9) return;
  claim(computed, alone, 3);
  claim(in_loop, alone, 0.5);  // at most twice the time in the nlmech loop
}

/// Times of the transition matrix against the state alone and against central differences of 12 states.
void add_matrices(chapters::Speed& all) {
  struct Motion {
    orbit::State start;
    double time;
  };
  std::vector<Motion> motions;  // conics with 0.3 to 1.7 times the circular speed, up to three radians
  for (int i = 0; i < 64; ++i) {
    const double speed = 0.3 + 1.4 * i / 63, angle = 0.3 + 0.04 * i;
    motions.push_back(
        {{{0.6, 0, 0.8}, {speed * std::cos(angle), speed * std::sin(angle), 0.1}}, 0.1 + 0.045 * i});
  }
  const auto add = [&](const std::string& name, auto move) {
    all.add(chapters::Work{name, chapters::keep_result([motions, move] {
                             double sum = 0;
                             for (const Motion& m : motions) sum += move(m.start, m.time);
                             return sum;
                           }),
                           static_cast<double>(motions.size())});
  };
  const auto state = [](const orbit::State& s, double time) {
    return orbit::propagate_kepler(s, time, 1).state.position[0];
  };
  const std::string alone = "Kepler, state", matrix = "Kepler, state and transition matrix",
                    differences = "Kepler, central differences";
  add(alone, state);
  add(matrix, [](const orbit::State& s, double time) {
    const auto k = orbit::kepler_transition(s, time, 1);
    return k.transition.sum() + k.state.position[0];
  });
  add(differences, [state](orbit::State s, double time) {
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
      double& x = i < 3 ? s.position[i] : s.velocity[i - 3];
      const double middle = x;
      for (const double change : {1e-6, -1e-6}) {
        x = middle + change;
        sum += state(s, time) / change;
      }
      x = middle;
    }
    return sum;
  });
  all.claim(matrix, alone, 0.25);
  all.claim(matrix, differences, 4);
  const std::string series = "J2 to J6, ten orbits by series, state",
                    with = "J2 to J6, ten orbits by series, state and transition matrix";
  orbit::Gravity oblate = orbit::earth(6);
  oblate.radius /= 7e6;
  oblate.mu = 1;
  const orbit::State start{{1, 0, 0}, {0, 0.7, 0.75}};
  all.add(series, [=] { return orbit::propagate(start, 0, 10 * revolution, oblate).x; });
  all.add(with, [=] { return orbit::propagate_transition(start, 0, 10 * revolution, oblate).transition; });
  all.claim(with, series, 1. / 3);
}

void rows(chapters::Speed& all) {
  add_matrices(all);
  for (const double e : {0.1, 0.7, 0.9, 0.99}) {
    const Ellipse ellipse(e);
    for (const double wanted : {1e-9, 1e-12}) add_rows(all, ellipse, wanted);
  }
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("two_body_series", &rows, argc, argv); }
