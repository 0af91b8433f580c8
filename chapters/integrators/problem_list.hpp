/// @file
/// The problem set: what its references and its list are made of.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::integrators {

/// What makes a problem hard.
enum class Kind {
  smooth,  ///< nothing: explicit methods are at home
  stiff,   ///< motions that are much faster than the solution
  extreme  ///< its length, its end, its jumps
};

/// How the reference of a problem is computed.
enum class By {
  taylor,   ///< Taylor series of two orders
  radau,    ///< collocation at Radau points of two orders
  nothing,  ///< there is no solution at the end: every success is wrong
};

/// A problem of the set.
struct Case {
  std::string_view name;            ///< in tables: "kepler-0.99"
  problems::TextProblem problem;    ///< with its parameters
  By by = By::taylor;               ///< how its reference is computed
  double end = problem.final_time;  ///< time
  Kind kind = Kind::smooth;         ///< what makes it hard
  double absolute = 1;              ///< absolute over relative tolerance: below the components that count
  std::int64_t length = 1;          ///< how many times as many steps it takes as the others
};

/// Friction between a mass on a spring and its support, as typed: x' changes its sign nine times.
struct Friction {
  static constexpr std::string_view name = "friction";  ///< in tables
  static constexpr const char* equation =
      "x'' + x + 0.125 sign(x') = 0; x(0) = 2.5; x'(0) = 0";  ///< a number of binary digits: all exact
  static constexpr double position = 2.5;                     ///< x(0); x'(0) = 0
  static constexpr double force = 0.125;                      ///< of friction
  static constexpr double end = 25;                           ///< before the mass sticks
};

/// All of them in the order of tables, but friction.
[[nodiscard]] inline std::vector<Case> all_cases() {
  using problems::TextProblem;
  using enum Kind;
  using enum By;
  const TextProblem duffing("duffing"), van_der_pol("van-der-pol", {{"mu", 1000}});
  return {{.name = "duffing", .problem = duffing},
          {.name = "impact", .problem = TextProblem("impact")},
          {.name = "forced-duffing", .problem = TextProblem("forced-duffing")},
          {.name = "oscillator", .problem = TextProblem("oscillator")},
          {.name = "three-masses", .problem = TextProblem("three-dof")},
          {.name = "chain-10", .problem = TextProblem("duffing-chain")},
          {.name = "lorenz", .problem = TextProblem("lorenz")},
          {.name = "kepler-0.1", .problem = TextProblem("kepler", {{"eccentricity", 0.1}})},
          {.name = "kepler-0.7", .problem = TextProblem("kepler", {{"eccentricity", 0.7}})},
          {.name = "kepler-0.99", .problem = TextProblem("kepler", {{"eccentricity", 0.99}})},
          {.name = "arenstorf", .problem = TextProblem("arenstorf")},
          {.name = "four-bodies", .problem = TextProblem("bodies"), .absolute = 1e-3},
          {.name = "pleiades", .problem = TextProblem("pleiades")},
          {.name = "duffing-1e6",
           .problem = TextProblem("duffing", {{"hardening", 1e6}}),
           .end = 0.2,
           .kind = stiff},
          {.name = "three-masses-1e8",
           .problem = TextProblem("three-dof", {{"k1", 1e8}}),
           .end = 2,
           .kind = stiff},
          {.name = "spring-pendulum", .problem = TextProblem("spring-pendulum"), .by = radau, .kind = stiff},
          {.name = "hires", .problem = TextProblem("hires"), .by = radau, .kind = stiff, .absolute = 1e-4},
          {.name = "van-der-pol-1000",
           .problem = van_der_pol,
           .by = radau,
           .end = 2000,
           .kind = stiff,
           .absolute = 1e-3},
          {.name = "robertson",
           .problem = TextProblem("robertson"),
           .by = radau,
           .kind = stiff,
           .absolute = 1e-12},
          {.name = "pollution",
           .problem = TextProblem("pollution"),
           .by = radau,
           .kind = stiff,
           .absolute = 1e-8},
          {.name = "duffing-10000", .problem = duffing, .end = 47680.5, .kind = extreme, .length = 100},
          {.name = "blow-up", .problem = TextProblem("blow-up"), .by = nothing, .kind = extreme},
          {.name = "dead-end", .problem = TextProblem("dead-end"), .by = nothing, .kind = extreme},
          {.name = "lost-domain", .problem = TextProblem("lost-domain"), .by = nothing, .kind = extreme}};
}

/// The times at which errors are judged: 16 equidistant ones in the last tenth, the last of them the end.
inline constexpr int judged_times = 16;
/// The time number @p k from 0 of them, for a way from @p t0 to @p t1.
[[nodiscard]] constexpr double judged_time(double t0, double t1, int k) {
  return k + 1 == judged_times ? t1 : t1 - (t1 - t0) / 10 * (judged_times - 1 - k) / (judged_times - 1);
}

}  // namespace nlmech::chapters::integrators
