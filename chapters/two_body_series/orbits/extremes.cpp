#include "chapters/two_body_series/orbits/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/orbits/propagators.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::two_body_series {

static const double low_orbit_time = 20 * 6218.7281;

double canonical_time(double length) { return std::sqrt(length * length * length / earth_mu); }

double difference_between_units(double length, double time) {
  const orbit::State si = low_orbit().start, scaled{si.position / length, si.velocity / (length / time)};
  const auto mu = earth_mu / (length * length * length) * (time * time);
  const auto a = orbit::propagate(si, 0, low_orbit_time, {.mu = earth_mu}, orbit::AnalyticContinuation{}),
             b = orbit::propagate(scaled, 0, low_orbit_time / time, {.mu = mu},
                                  orbit::AnalyticContinuation{});
  return (b.x.position * length - a.x.position).norm() / a.x.position.norm();
}

double rounding_between_units() {
  return orbit::kepler_condition(low_orbit().start, low_orbit_time, earth_mu).position *
         std::numeric_limits<double>::epsilon() / 2;
}

}  // namespace nlmech::chapters::two_body_series

namespace nlmech::chapters::two_body_series::extremes {
namespace {

/// A method with its settings.
struct Method {
  std::string name;
  ivp::NamedIntegrator run;
};

std::vector<Method> methods() {
  std::vector<Method> all = {
      {"kepler", kepler_integrator(1)},
      {"series", continuation_integrator(orbit::AnalyticContinuation{}, 1)},
      {"series, tolerance 1e-17",
       continuation_integrator(orbit::AnalyticContinuation{.tolerance = 1e-17}, 1)},
      {"series, order 100", continuation_integrator(orbit::AnalyticContinuation{.order = 100}, 1)}};
  for (const char* name : {"rkn1210", "ode45", "odeint-fehlberg78", "cvode-adams"}) {
    if (!comparison::any_method(name).is_available()) continue;
    all.push_back(
        {fmt::format("{}, tolerance 1e-12", name), comparison::any_method(name).with({.tolerance = 1e-12})});
  }
  return all;
}

/// Initial state and time interval, in units with mu = 1.
struct Case {
  std::string name;
  orbit::State start;
  double time;
};

std::vector<Case> cases() {
  const orbit::State ellipse = on_ellipse(0.7, 1);
  return {{"e = 0.999, 1000 orbits", on_ellipse(0.999), 1000.4 * revolution},
          {"fall from rest into the centre", {{0.6, 0.8, 0}, {0, 0, 0}}, 5},
          {"thrown into the centre", {{0, 0, 2}, {0, 0, -3}}, 5},
          {"flyby, from 1000 past 0.02 to 1000", {{-1000, 0.2, 0}, {1, 0, 0}}, 2000},
          {"parabola", {{1, 0, 0}, {0, std::sqrt(2.0), 0}}, 100},
          {"no time", ellipse, 0},
          {"backwards, e = 0.7, 5 orbits", ellipse, -5 * revolution},
          {"r = 0", {{0, 0, 0}, {0, 1, 0}}, 1}};
}

/// Result of a method.
struct Answer {
  std::string what, method, status;
  double end = 0;               ///< time reached
  std::optional<double> error;  ///< |dr|/|r|; nothing after a failure
  double rounding = 0;          ///< kappa eps/2, kappa the condition of the position
  std::int64_t steps = 0;
};

Answer answer(const Case& c, const Method& m, std::int64_t most_steps) {
  static const ivp::System system(problems::TextProblem("two-body", {{"mu", 1}}));
  Answer a{c.name, m.name, {}, 0, {}, 0, 0};
  try {
    const auto end = m.run(system, joined(c.start), 0, c.time, {}, {.steps = most_steps});
    a.status = to_string(end.status.outcome());
    a.end = end.t;
    a.steps = end.statistics.steps;
    if (end.status.ok()) {
      const orbit::State s = parted(end.x);
      const double exact = orbit::propagate_kepler(c.start, c.time, 1).state.position.norm();
      a.error = position_error(c.start, c.time, 1, s.position) / exact;
      a.rounding = rounding_of_data(c.start, c.time, 1) / exact;
    }
  } catch (const std::invalid_argument&) {
    a.status = "refused";
  }
  return a;
}

/// Fixed continuation of order 2 over an orbit in @p steps steps.
Answer second_order(int steps) {
  const orbit::FixedContinuation method{.step = revolution / steps, .order = 2, .velocity_degree = 2};
  return answer({fmt::format("e = 0.1, an orbit in {} steps", steps), on_ellipse(0.1), revolution},
                {"fixed, order 2", continuation_integrator(method, 1)}, 2 * std::int64_t{steps});
}

struct Outcome {
  std::vector<Answer> answers;
  double powers_of_two = 0, canonical = 0, rounding = 0;  ///< difference_between_units(), its bound
};

Outcome measure(bool quick) {
  Outcome m;
  const std::vector<Method> all = methods();
  const std::vector<std::string> peer_names = peers::all_peer_names();
  for (const Case& c : cases()) {
    for (const Method& method : all) {
      // Fewer steps for peers, which do not finish a thousand orbits with ten times as many either.
      const std::int64_t fewer =
          std::ranges::find(peer_names, method.name.substr(0, method.name.find(','))) != peer_names.end()
              ? 5'000
              : 200'000;
      m.answers.push_back(answer(c, method, quick ? fewer : 2'000'000));
    }
  }
  for (const int steps : {1000, 10'000}) m.answers.push_back(second_order(steps));
  m.powers_of_two = difference_between_units(0x1p23, 0x1p10);
  m.canonical = difference_between_units(7309041.111, canonical_time(7309041.111));
  m.rounding = rounding_between_units();
  return m;
}

void tabulate(const Outcome& m, scene::Show& show) {
  const auto unless_refused = [](auto member) {
    return
        [member](const Answer& a) { return a.status == "refused" ? scene::Cell() : scene::Cell(a.*member); };
  };
  scene::Table table = scene::table_of(
      m.answers, {{"case", &Answer::what},
                  {"method", &Answer::method},
                  {"status", &Answer::status},
                  {"time reached", unless_refused(&Answer::end), 6},
                  {"relative error of the position", &Answer::error, 2},
                  {"condition times rounding",
                   [](const Answer& a) { return a.error ? scene::Cell(a.rounding) : scene::Cell(); }, 2},
                  {"steps", unless_refused(&Answer::steps)}});
  const auto units = [&](const char* name, double difference) {
    table.add({fmt::format("LEO, 20 orbits, SI against {}", name),
               "series",
               "success",
               low_orbit_time,
               difference,
               m.rounding,
               {}});
  };
  units("units of 2^23 m and 2^10 s", m.powers_of_two);
  units("a = 1, mu = 1", m.canonical);
  show.table(std::move(table));
}

void put(const Outcome& m, scene::Show& show) {
  tabulate(m, show);
  const auto of = [&](const std::string& what, const std::string& method) -> const Answer& {
    return *std::ranges::find_if(m.answers,
                                 [&](const Answer& a) { return a.what == what && a.method == method; });
  };
  const auto error = [&](const std::string& what, const std::string& method) {
    return of(what, method).error.value_or(HUGE_VAL);
  };
  const auto by_condition = [&](const std::string& name, const std::string& what, const std::string& method,
                                double most, const char* reason) {
    show.at_most("error over condition times eps, " + name,
                 error(what, method) / (2 * of(what, method).rounding), most, reason);
  };
  const auto count = [&](const std::string& what, const std::string& status) {
    return std::ranges::count_if(m.answers, [&](const Answer& a) {
      return a.what == what && a.status == status && a.method.starts_with("series");
    });
  };
  const std::string thin = "e = 0.999, 1000 orbits", fall = "fall from rest into the centre",
                    flyby = "flyby, from 1000 past 0.02 to 1000", back = "backwards, e = 0.7, 5 orbits";
  const char* condition = "rounding of the data times their condition; the states of some steps are data too";
  by_condition("e = 0.999, Kepler", thin, "kepler", 8, condition);
  by_condition("e = 0.999, series at 1e-17", thin, "series, tolerance 1e-17", 10, condition);
  by_condition("e = 0.999, series", thin, "series", 100,
               "the default leaves out 4.5 eps at each of a thousand passages, always the same");
  show.equals("series that end in a collision, of three", count(fall, "collision"), 3, "all of them");
  show.near("time of the collision", of(fall, "series").end, revolution / 4 / std::sqrt(2.0), 1e-13,
            "half a revolution of the ellipse with a = 1/2; ends where a step is eps of the interval");
  by_condition("through the centre, Kepler", fall, "kepler", 8, condition);
  by_condition("flyby, Kepler", flyby, "kepler", 8, condition);
  by_condition("flyby, series", flyby, "series", 8, condition);
  by_condition("backwards, series", back, "series", 8, condition);
  by_condition("backwards, order 100", back, "series, order 100", 8, condition);
  show.near("order of the fixed series of degree 2",
            std::log10(error("e = 0.1, an orbit in 1000 steps", "fixed, order 2") /
                       error("e = 0.1, an orbit in 10000 steps", "fixed, order 2")),
            2, 0.05, "a hundredth of the error with ten times the steps");
  show.equals("series that refuse r = 0, of three", count("r = 0", "refused"), 3, "all of them");
  show.at_most("error of no time", error("no time", "series"), 0, "the start itself");
  show.at_most("difference between SI and units by powers of two", m.powers_of_two, 0,
               "exact: no digit changes");
  show.at_most("difference between SI and canonical units", m.canonical,
               16 * m.rounding + std::numeric_limits<double>::epsilon(),
               "mu, time and six components rounded once more, times the condition");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcome(
      "extremes",
      "mu = 1; tolerance 1e-15 where none is given; errors against Kepler's equation in 50 digits; at most 2 "
      "million steps",
      measure);
  return {{.name = "extremes",
           .title = "Results of each method for thin ellipses, collisions, flybys and other units",
           .content = scene::Content(put, outcome)}};
}

}  // namespace nlmech::chapters::two_body_series::extremes
