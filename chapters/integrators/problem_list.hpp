/// @file
/// The problem set with the types of its problems: what its references, and its type-erased list, are made
/// of.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"

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
/// @tparam by how its reference is computed
template <class Problem, By by = By::taylor>
struct Case {
  static constexpr By reference = by;  ///< how its reference is computed
  std::string_view name;               ///< in tables: "kepler-0.99"
  Problem problem;                     ///< its parameters
  double end = problem.final_time;     ///< time
  Kind kind = Kind::smooth;            ///< what makes it hard
  double absolute = 1;                 ///< absolute over relative tolerance: below the components that count
  std::int64_t length = 1;             ///< how many times as many steps it takes as the others
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

/// Calls @p visit with each Case in the order of tables. Friction is not among them.
template <class Visit>
void for_each_case(Visit&& visit) {
  using namespace problems;
  using enum Kind;
  visit(Case<Duffing>{"duffing", {}});
  visit(Case<ImpactDuffing>{"impact", {}});
  visit(Case<ForcedDuffing>{"forced-duffing", {}});
  visit(Case<StrongOscillator>{"oscillator", {}});
  visit(Case<ThreeMassChain>{"three-masses", {}});
  visit(Case<DuffingChain>{"chain-10", {}});
  visit(Case<Lorenz>{"lorenz", {}});
  visit(Case<TextProblem>{"kepler-0.1", TextProblem("kepler", {{"eccentricity", 0.1}})});
  visit(Case<TextProblem>{"kepler-0.7", TextProblem("kepler", {{"eccentricity", 0.7}})});
  visit(Case<TextProblem>{"kepler-0.99", TextProblem("kepler", {{"eccentricity", 0.99}})});
  visit(Case<TextProblem>{"arenstorf", TextProblem("arenstorf")});
  visit(Case<FourBodies>{"four-bodies", {}, FourBodies::final_time, smooth, 1e-3});
  visit(Case<TextProblem>{"pleiades", TextProblem("pleiades")});
  visit(Case<Duffing>{"duffing-1e6", {.hardening = 1e6}, 0.2, stiff});
  ThreeMassChain pinned;
  pinned.k1 = 1e8;
  visit(Case<ThreeMassChain>{"three-masses-1e8", pinned, 2, stiff});
  visit(Case<TextProblem, By::radau>{"spring-pendulum", TextProblem("spring-pendulum"), 10, stiff});
  visit(Case<Hires, By::radau>{"hires", {}, Hires::final_time, stiff, 1e-4});
  visit(Case<VanDerPol, By::radau>{"van-der-pol-1000", {.mu = 1000}, 2000, stiff, 1e-3});
  visit(Case<Robertson, By::radau>{"robertson", {}, Robertson::final_time, stiff, 1e-12});
  visit(Case<TextProblem, By::radau>{"pollution", TextProblem("pollution"), 60, stiff, 1e-8});
  visit(Case<Duffing>{"duffing-10000", {}, 47680.5, extreme, 1, 100});
  visit(Case<BlowUp, By::nothing>{"blow-up", {}, BlowUp::final_time, extreme});
  visit(Case<TextProblem, By::nothing>{"dead-end", TextProblem("dead-end"), 2, extreme});
  visit(Case<TextProblem, By::nothing>{"lost-domain", TextProblem("lost-domain"), 2, extreme});
}

/// The times at which errors are judged: 16 equidistant ones in the last tenth, the last of them the end.
inline constexpr int judged_times = 16;
/// The time number @p k from 0 of them, for a way from @p t0 to @p t1.
[[nodiscard]] constexpr double judged_time(double t0, double t1, int k) {
  return k + 1 == judged_times ? t1 : t1 - (t1 - t0) / 10 * (judged_times - 1 - k) / (judged_times - 1);
}

}  // namespace nlmech::chapters::integrators
