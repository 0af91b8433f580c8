/// @file
/// The runs behind Figures 3.22 and 3.23 and Tables 3.2 and 3.3: four propagators, two orbits, three times.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::two_body_series {

/// Seconds of one revolution, 2 pi sqrt(a^3/mu).
[[nodiscard]] double period_of(const Orbit& orbit);

/// How a propagator kept the energy.
struct EnergyRecord {
  std::vector<double> t;           ///< output points without the start, s
  std::vector<double> error;       ///< |E_k/E_0 - 1| there (Eq. 3.69), E_k in double precision
  std::vector<double> at_ends;     ///< ode45 alone: at the ends of its own steps
  std::vector<double> at_refined;  ///< ode45 alone: at the four values a step that MATLAB gives by default
  std::int64_t steps = 0;          ///< of the propagator; points for a closed solution
  double position_error = 0;       ///< at the end, m, against Kepler's problem in 50 digits
  double milliseconds = 0;         ///< median time of a run without output
};

/// ||eps||: root of the sum of squares, not of their mean.
[[nodiscard]] double norm_of(const std::vector<double>& errors);

/// The printed methods, and Lagrange's F and G as the library does it.
enum class Propagator {
  f_and_g,   ///< textbook form, from the start to every point
  ode45,     ///< RelTol = AbsTol = 1e-6 in SI units, output at the points of Analytic-Cont
  rkn1210,   ///< rtol = atol = 1e-12 in SI units, output at its steps
  series,    ///< Analytic-Cont: r to degree K, v to degree K - 1
  universal  ///< the library's Kepler propagator, from the start to every point
};
inline constexpr std::array all_propagators = {Propagator::f_and_g, Propagator::ode45, Propagator::rkn1210,
                                               Propagator::series, Propagator::universal};
inline constexpr std::array<int, 3> revolutions = {5, 10, 20};  ///< of the tables

/// As in the tables: "F&G".
[[nodiscard]] const char* name_of(Propagator propagator);

/// "table-3.2" or "table-3.3".
[[nodiscard]] std::string table_of(const Orbit& orbit);
/// The row of that table: "Analytic-Cont 5 orbits (125 steps; order 10)".
[[nodiscard]] std::string row_in_source(const Orbit& orbit, Propagator propagator, int orbits);

/// The name of its norm among published values.
[[nodiscard]] std::string norm_in_source(const Orbit& orbit, Propagator propagator, int orbits);

/// What is timed of a row: the propagation with its settings, without output.
[[nodiscard]] std::function<void()> timed_work(const Orbit& orbit, int orbits, Propagator propagator);

/// Follows an orbit for so many revolutions. @param repeats of the timing
/// @throws Failure if the propagator does not get there
[[nodiscard]] EnergyRecord follow(const Orbit& orbit, int orbits, Propagator propagator, int repeats);

/// The state after @p time by the textbook form of Lagrange's F and G: Kepler's equation in the change of the
/// eccentric anomaly by Newton's iteration, G = t - sqrt(a^3/mu) (dE - sin dE) with t counted from the start.
/// Ellipses alone. @param enough Newton's iteration ends with a change of dE below it; 0: at rounding
[[nodiscard]] orbit::State textbook_f_and_g(const orbit::State& start, double time, double mu,
                                            double enough = 0);

/// The same as a result of the chapter.
[[nodiscard]] scene::Result<EnergyRecord> followed(const Orbit& orbit, int orbits, Propagator propagator);
/// How its settings were read.
[[nodiscard]] const char* reading_of(Propagator propagator);

}  // namespace nlmech::chapters::two_body_series
