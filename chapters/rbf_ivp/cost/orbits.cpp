#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"

namespace nlmech::chapters::rbf_ivp::orbits {
namespace {

using comparison::by_tolerances;
using comparison::Example;
using comparison::Kind;

/// Units of length and time: R and sqrt(R^3/mu) of the Earth, so that R = mu = 1.
constexpr double radius = 6378137;
const double second = 1 / std::sqrt(radius * radius * radius / 3.986004418e14);
const double day = 86400 * second;

/// The low orbit of the dissertation's Eq. 3.71, its velocity turned by 60 degrees out of the equator.
ivp::State start() {
  const double speed = 1 / (radius * second);
  ivp::State x(6);
  x << 1702547.136867679 / radius, 6353992.417071098 / radius, 0, -3943.007026914627 * speed,
      1056.5255486120175 * speed, 7070.406775 * speed;
  return x;
}

/// Position after a day with J_2, in m. oracle: two_body_series_orbits day of tilted x, day of tilted y, day
/// of tilted z
const Eigen::Vector3d after_a_day(3544510.0483122083031, 4581007.8506592658063, -3355191.8038390635496);

/// Equations of the motion about a point mass, or about an oblate body with J_2 (R = mu = 1).
program::Problem equations(bool oblate) {
  std::string text = "square = x x + y y + z z; pull = -1/(square sqrt(square));";
  text += oblate ? "bulge = 1.5*1.08262668e-3/square; polar = 5 z z/square;"
                   "across = pull (1 + bulge (1 - polar)); along = pull (1 + bulge (3 - polar));"
                   "x'' = across x; y'' = across y; z'' = along z"
                 : "x'' = pull x; y'' = pull y; z'' = pull z";
  return program::Problem(program::Equations({"orbit", text}));
}

/// A day on the orbit; the error is the distance from the reference over that from the centre.
Example example_of(bool oblate) {
  Example c = comparison::example_of(equations(oblate), oblate ? "J2" : "Kepler", start(), 0, day);
  c.error = [](const ivp::State& found, const ivp::LongState& exact) {
    const auto miss = found.head<3>().cast<long double>() - exact.head<3>();
    return static_cast<double>(miss.norm() / exact.head<3>().norm());
  };
  return c;
}

/// One revolution of the Kepler orbit.
double period() {
  const ivp::State x = start();
  const double axis = 1 / (2 / x.head<3>().norm() - x.tail<3>().squaredNorm());
  return 2 * std::numbers::pi * std::sqrt(axis * axis * axis);
}

/// Methods of the chapter with the steps and shapes, in periods, that the dissertation has for the free
/// oscillator; MCPI with 41 nodes in steps of half a revolution; and methods made for orbits. Without
/// implicit methods, which an orbit does not need, and the classical ones of fixed step, which are slower.
std::vector<comparison::MethodSweep> methods(bool quick) {
  const double revolution = period();
  constexpr std::array halves = {2.0, 1.0, 0.5, 0.25};
  auto all = sweeps({.few_nodes = revolution / 10,
                     .many_nodes = revolution,
                     .few_shape = free_duffing_steps().few_shape,
                     .many_shape = free_duffing_steps().many_shape},
                    quick);
  std::erase_if(all, [](const comparison::MethodSweep& method) {
    return method.kind == Kind::classical || method.kind == Kind::implicit;
  });
  all.push_back(comparison::by_steps("mcpi", 41, Kind::polynomial, revolution / 4, halves, quick));
  all.push_back(by_tolerances("series", Kind::series, quick));
  all.push_back(by_tolerances("rkn1210", Kind::explicit_, quick));
  return all;
}

/// Runs of all methods on one orbit.
struct Orbit {
  scene::ProblemLines lines;
  double condition = 0;  ///< condition number of the end
  double known = 0;      ///< distance of the reference's end from an independent solution, relative
};

Orbit orbit_of(bool oblate, bool quick) {
  const Example c = example_of(oblate);
  const auto accurate = ivp::named_integrator("series", {.tolerance = 1e-16});
  const orbit::BasicState<long double> from{c.x0.head<3>().cast<long double>(),
                                            c.x0.tail<3>().cast<long double>()};
  const Eigen::Vector3d end =
      oblate
          ? Eigen::Vector3d(after_a_day / radius)
          : orbit::kepler_state<long double>(from, static_cast<long double>(day), 1).position.cast<double>();
  Orbit o{{oblate ? "with J_2" : "point mass", comparison::cost_curves(c, methods(quick), quick)},
          comparison::condition_of(c, accurate),
          (end - c.reference(day).head<3>().cast<double>()).norm() / end.norm()};
  for (scene::MethodLine& line : o.lines.lines) {  // the page compares radial functions with them
    if (line.group == static_cast<std::size_t>(Kind::polynomial)) line.side = scene::Side::subject;
  }
  return o;
}

std::vector<Orbit> all_orbits(bool quick) { return {orbit_of(false, quick), orbit_of(true, quick)}; }

void check(const Orbit& o, scene::Show& show) {
  const std::string of = o.lines.problem == "with J_2" ? ", J2" : ", Kepler";
  const double half_epsilon = std::numeric_limits<double>::epsilon() / 2;
  show.at_most("reference against an independent one" + of, o.known, 16 * o.condition * half_epsilon,
               "Kepler's equation in extended precision; with J2 extrapolation in 36 digits, whose start is "
               "rounded to double here: the condition times a few roundings");
  show.between("least error of rbf-coll, N = 35" + of, o.lines.of("rbf-coll, N = 35").least_error(), 1e-8,
               1e-4, "rounding in the derivatives, condition 1e13 to 1e16, scatters tenfold");
  show.at_most("least error of radau-coll, N = 17" + of, o.lines.of("radau-coll, N = 17").least_error(),
               1e3 * o.condition * half_epsilon,
               "a few roundings in each of at most 240 steps, all of one sign");
  show.at_most("least error of mcpi, N = 41" + of, o.lines.of("mcpi, N = 41").least_error(), 1e-10,
               "the iteration ends at changes of 1e-13, 1e-11 at the most, in each of some hundred steps");
  const scene::MethodLine& series = o.lines.of("series");
  show.at_most("least error of series" + of, series.least_error(),
               comparison::tightest_tolerance(show.quick()) * o.condition *
                   static_cast<double>(comparison::steps_of(*series.best())),
               "the tightest tolerance in each step, all of one sign, times the condition");
}

void put(const std::vector<Orbit>& all, scene::Show& show) {
  double condition = 0, radial = HUGE_VAL;
  std::vector<scene::ProblemLines> lines;
  for (const Orbit& o : all) {
    check(o, show);
    condition = std::max(condition, o.condition);
    radial = std::min(radial, o.lines.of("rbf-coll, N = 35").least_error());
    lines.push_back(o.lines);
  }
  scene::show_work_precision(
      {.heading =
           fmt::format("A day on a low orbit: RBF collocation ends at {:.0f} digits, polynomials at rounding",
                       std::floor(-std::log10(radial))),
       .digits = "digits: -log_{10} of |dr|/r",
       .work = comparison::work_columns(),
       .work_label = "right-hand sides evaluated",
       .groups = comparison::method_groups(),
       .rounding = condition * std::numeric_limits<double>::epsilon() / 2},
      lines, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result orbits(
      "times-orbits",
      "a day, fourteen revolutions, of the orbit of Eq. 3.71 turned by 60 degrees; units of the Earth's "
      "radius "
      "with mu = 1; steps and shapes in revolutions as the dissertation's in periods of the oscillator; one "
      "sweep of tolerances; without implicit and classical methods",
      all_orbits);
  return {{.name = "error-vs-time-orbits",
           .title = "A day on a low orbit, point mass and J2: achieved digits and cost",
           .place = "our own, for the future work of section 4.5",
           .content = scene::Content(put, orbits)}};
}

}  // namespace nlmech::chapters::rbf_ivp::orbits
