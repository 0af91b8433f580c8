#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_inverse::extremes_lambert {
namespace {

using orbit::LambertArc;
using orbit::LambertBranch;
using orbit::LambertProblem;
using orbit::LambertSolution;
using orbit::Vector3;
using Digits50 = ExtendedReal<50>;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Extreme problem with its expected outcome.
struct Extreme {
  std::string label;
  LambertProblem problem;
  LambertArc arc;
  Outcome expected = Outcome::success;
};

/// Problem with radii 1 and 1.5 at an angle and mu = 1, rounded to double.
LambertProblem apart(double angle) {
  return {{1, 0, 0}, {1.5 * std::cos(angle), 1.5 * std::sin(angle), 0}, 4, 1};
}
/// Ordinary problem with a given time.
LambertProblem plain(double time) { return {{1, 0, 0}, {0.5, 1.5, 0.2}, time, 1}; }

/// Time of flight on a parabola, short way, by Euler's equation: 6 t = (r_1 + r_2 + c)^(3/2) - (r_1 + r_2 -
/// c)^(3/2).
double parabolic_time(const LambertProblem& p) {
  const double r = p.from.norm() + p.to.norm(), c = (p.to - p.from).norm();
  return (std::pow(r + c, 1.5) - std::pow(r - c, 1.5)) / 6;
}

/// Problem at @p factor times its least time for a number of revolutions.
LambertProblem at_limit(int revolutions, double factor) {
  return plain(orbit::least_time(plain(1), false, revolutions) * factor);
}

/// The ordinary problem in units smaller by factors of 2^length and 2^time.
LambertProblem in_units(int length, int time) {
  LambertProblem p = plain(7);
  const double unit = std::ldexp(1., length);
  return {p.from * unit, p.to * unit, std::ldexp(p.time, time), std::ldexp(1., 3 * length - 2 * time)};
}

std::vector<Extreme> extremes() {
  std::vector<Extreme> all;
  const auto add = [&](std::string label, const LambertProblem& p, const LambertArc& arc = {},
                       Outcome expected = Outcome::success) {
    all.push_back({std::move(label), p, arc, expected});
  };
  const LambertArc long_way{.long_way = true};
  for (const double lacking : {1e-3, 1e-8, 1e-12}) {  // computed without cancellation
    const LambertProblem p{{1, 0, 0}, {-1.5 * std::cos(lacking), 1.5 * std::sin(lacking), 0}, 4, 1};
    add(fmt::format("180 degrees less {:g} rad", lacking), p);
    add(fmt::format("180 degrees and {:g} rad", lacking), p, long_way);
  }
  LambertProblem opposite{{1, 0, 0}, {-1.5, 0, 0}, 4, 1};
  add("180 degrees, no plane given", opposite, {}, Outcome::outside_validity);
  opposite.normal = Vector3<double>(0, 1, 2);
  add("180 degrees in a given plane", opposite);
  for (const double angle : {1e-3, 1e-8, 1e-12}) {
    add(fmt::format("{:g} rad", angle), apart(angle));
    add(fmt::format("360 degrees less {:g} rad", angle), apart(angle), long_way);
  }
  add("0 degrees", apart(0), {}, Outcome::outside_validity);
  add("360 degrees", apart(0), long_way, Outcome::outside_validity);
  for (const double time : {1e-3, 1e-50, 1e-140})
    add(fmt::format("hyperbola in a time of {:g}", time), plain(time));
  add("a time of 1e-200", plain(1e-200), {}, Outcome::outside_validity);
  add("parabola", plain(parabolic_time(plain(1))));
  for (const double time : {1e3, 1e7}) add(fmt::format("a time of {:g}", time), plain(time));
  add("a time of 1e12", plain(1e12), {}, Outcome::outside_validity);
  for (const int n : {1, 20, 1000}) {
    const std::string label = fmt::format("{} revolutions, least time", n);
    add(label + " less 1e-12", at_limit(n, 1 - 1e-12), {false, n}, Outcome::infeasible);
    add(label + " and 1e-12, low", at_limit(n, 1 + 1e-12), {false, n, LambertBranch::low});
    add(label + " and 1e-12, high", at_limit(n, 1 + 1e-12), {false, n, LambertBranch::high});
  }
  add("1000000 revolutions, twice the least time", at_limit(1000000, 2), {false, 1000000});
  add("r_2 = 1e-8 r_1", {{1, 0, 0}, {0, 1e-8, 0}, 1, 1});
  add("r_2 = 1e8 r_1", {{1, 0, 0}, {0, 1e8, 0}, 1e12, 1});
  add("lengths of 2^-600, times of 2^-700", in_units(-600, -700));
  add("lengths of 2^600, times of 2^700", in_units(600, 700));
  return all;
}

/// Result of a problem.
struct Trial {
  Extreme extreme;
  LambertSolution solution;
  double miss = 0;    ///< miss of the orbit propagated in 50 digits, relative to |r_2|
  double scaled = 0;  ///< largest relative error of position and velocity, over kappa eps

  /// The cell, or an empty one if the problem was not solved.
  [[nodiscard]] scene::Cell if_solved(const scene::Cell& cell) const {
    return solution.status.ok() ? cell : scene::Cell();
  }
};

double relative(const Vector3<double>& a, const Vector3<Digits50>& b) {
  const Vector3<Digits50> difference = a.cast<Digits50>() - b;
  return static_cast<double>(Digits50(sqrt(Digits50(difference.dot(difference) / b.dot(b)))));
}

Trial attempt(const Extreme& e) {
  const LambertProblem& p = e.problem;
  Trial t{e, solve_lambert(p, e.arc)};
  if (!t.solution.status.ok()) return t;
  const orbit::BasicState<Digits50> start{p.from.cast<Digits50>(), t.solution.v1.cast<Digits50>()};
  const auto end =
      moved(start, orbit::lagrange_coefficients<Digits50>(start, Digits50(p.time), Digits50(p.mu)));
  const orbit::KeplerCondition kappa = orbit::kepler_condition({p.from, t.solution.v1}, p.time, p.mu);
  t.miss = relative(p.to, end.position);
  t.scaled = std::max(t.miss / kappa.position, relative(t.solution.v2, end.velocity) / kappa.velocity) / eps;
  return t;
}

/// |v_low - v_high| at departure at the relative distance @p above from the least time.
double gap(int revolutions, double above) {
  const LambertProblem p = at_limit(revolutions, 1 + above);
  return (solve_lambert(p, {false, revolutions, LambertBranch::low}).v1 -
          solve_lambert(p, {false, revolutions, LambertBranch::high}).v1)
      .norm();
}

/// Largest relative difference of velocities between systems of units.
double worst_unit() {
  const Vector3<double> here = solve_lambert(in_units(0, 0)).v1;
  double worst = 0;
  for (const auto& [length, time] : {std::pair{-600, -700}, {600, 700}, {100, -60}, {-100, 60}}) {
    const Vector3<double> other = solve_lambert(in_units(length, time)).v1 * std::ldexp(1., time - length);
    worst = std::max(worst, (other - here).norm() / here.norm());
  }
  return worst;
}

void put(scene::Show& show) {
  std::vector<Trial> trials;
  std::ranges::transform(extremes(), std::back_inserter(trials), attempt);
  show.table(trials, {{"case", [](const Trial& t) { return t.extreme.label; }},
                      {"status", [](const Trial& t) { return to_string(t.solution.status.outcome()); }},
                      {"iterations", [](const Trial& t) { return t.if_solved(t.solution.iterations); }},
                      {"1/a", [](const Trial& t) { return t.if_solved(t.solution.reciprocal_axis); }},
                      {"miss over |r_2|", [](const Trial& t) { return t.if_solved(t.miss); }, 2},
                      {"over kappa eps too", [](const Trial& t) { return t.if_solved(t.scaled); }, 2}});
  double worst = 0, parabola = HUGE_VAL;
  std::size_t right = 0;
  for (const Trial& t : trials) {
    right += t.solution.status.outcome() == t.extreme.expected ? 1 : 0;
    worst = std::max(worst, t.scaled);
    if (t.extreme.label == "parabola") parabola = std::abs(t.solution.reciprocal_axis);
  }
  show.equals("cases that end as they must", right, static_cast<double>(trials.size()),
              "0 and 360 degrees, 180 without a plane, times that double precision cannot distinguish and "
              "times too short for the revolutions are refused, all others solved");
  show.at_most("largest miss over kappa eps, positions and velocities", worst, 8,
               "what the method states; integrated in 50 digits, kappa the condition of the orbit");
  show.at_most("1/a on the parabola", parabola, 64 * eps,
               "0; Euler's time to a rounding, and 1/a changes by less than ten times its share");
  show.at_most("largest difference of velocities in other units, relative", worst_unit(), 4 * eps,
               "units by powers of two change no digit; sqrt(mu) of an odd power rounds");
  for (const int n : {1, 20, 1000})
    show.near(
        fmt::format("gap of both branches 1e-8 above the least time over that at 1e-12, {} revolutions", n),
        gap(n, 1e-8) / gap(n, 1e-12), 100, 1e-2, "a square root at the fold; eps/1e-12 of rounding");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "extremes-lambert",
           .title = "Lambert's problem, extreme cases: angles, times, revolutions, units",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::rbf_inverse::extremes_lambert
