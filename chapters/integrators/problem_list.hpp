/// @file
/// Definitions of the problems of the set, for the set itself and for the computation of its references.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::integrators {

/// Kind of difficulty of a problem.
enum class Kind {
  smooth,  ///< none; suits explicit methods
  stiff,   ///< time scales much shorter than that of the solution
  extreme  ///< long interval, singularity at the end, or jumps
};

/// How the reference of a problem is computed.
enum class By {
  taylor,   ///< Taylor series of two orders compared
  radau,    ///< Radau collocation of two orders compared
  nothing,  ///< no solution reaches t1: every success is wrong
};

/// A problem of the set.
struct Case {
  std::string_view name;            ///< in tables, such as "kepler-0.99"
  problems::TextProblem problem;    ///< with its parameters
  By by = By::taylor;               ///< how its reference is computed
  double end = problem.final_time;  ///< final time
  Kind kind = Kind::smooth;         ///< kind of difficulty
  double absolute = 1;              ///< absolute over relative tolerance; below the relevant components
  std::int64_t length = 1;          ///< number of steps relative to other problems
};

/// Mass on a spring with dry friction, as equation text. x' changes its sign nine times.
struct Friction {
  static constexpr std::string_view name = "friction";  ///< in tables
  static constexpr const char* equation =
      "x'' + x + 0.125 sign(x') = 0; x(0) = 2.5; x'(0) = 0";  ///< the constants are exact in binary
  static constexpr double position = 2.5;                     ///< x(0); x'(0) = 0
  static constexpr double force = 0.125;                      ///< friction force
  static constexpr double end = 25;                           ///< final time, before the mass sticks
};

/// All problems except friction, in the order of tables.
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

/// Number of judged times, equidistant in the last tenth of the interval; the last one is t1.
inline constexpr int judged_times = 16;
/// Judged time number @p k (from 0) of the interval from @p t0 to @p t1.
[[nodiscard]] constexpr double judged_time(double t0, double t1, int k) {
  return k + 1 == judged_times ? t1 : t1 - (t1 - t0) / 10 * (judged_times - 1 - k) / (judged_times - 1);
}

}  // namespace nlmech::chapters::integrators
