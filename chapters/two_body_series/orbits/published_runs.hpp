/// @file
/// Runs of Figures 3.22 and 3.23 and Tables 3.2 and 3.3: four propagators, two orbits, three times.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::two_body_series {

/// Period 2 pi sqrt(a^3/mu), s.
[[nodiscard]] double period_of(const Orbit& orbit);

/// Energy errors of a propagator, and its work.
struct EnergyRecord {
  std::vector<double> t;           ///< times of the output points without the start, s
  std::vector<double> error;       ///< |E_k/E_0 - 1| at t (Eq. 3.69), E_k in double precision
  std::vector<double> at_ends;     ///< ode45 only: errors at the ends of its steps
  std::vector<double> at_refined;  ///< ode45 only: errors at MATLAB's default four values per step
  std::int64_t steps = 0;          ///< number of steps; number of points for a closed solution
  double position_error = 0;       ///< at the end, m, against Kepler's solution in 50 digits
  double milliseconds = 0;         ///< median time of a run without output
};

/// Norm ||eps||: square root of the sum of squares, not of their mean.
[[nodiscard]] double norm_of(const std::vector<double>& errors);

/// The printed methods and the library's Kepler propagator.
enum class Propagator {
  f_and_g,   ///< textbook form of Lagrange's F and G, from the start to every point
  ode45,     ///< RelTol = AbsTol = 1e-6 in SI units, output at the points of Analytic-Cont
  rkn1210,   ///< rtol = atol = 1e-12 in SI units, output at its steps
  series,    ///< Analytic-Cont: r to degree K, v to degree K - 1
  universal  ///< the library's Kepler propagator, from the start to every point
};
inline constexpr std::array all_propagators = {Propagator::f_and_g, Propagator::ode45, Propagator::rkn1210,
                                               Propagator::series, Propagator::universal};
inline constexpr std::array<int, 3> revolutions = {5, 10, 20};  ///< numbers of orbits in the tables

/// Name in the tables, such as "F&G".
[[nodiscard]] const char* name_of(Propagator propagator);

/// Table of an orbit: "table-3.2" or "table-3.3".
[[nodiscard]] std::string table_of(const Orbit& orbit);
/// Row of that table, such as "Analytic-Cont 5 orbits (125 steps; order 10)".
[[nodiscard]] std::string row_in_source(const Orbit& orbit, Propagator propagator, int orbits);

/// Name of the row's norm among the published values.
[[nodiscard]] std::string norm_in_source(const Orbit& orbit, Propagator propagator, int orbits);

/// Timed work of a row: the propagation with its settings, without output.
[[nodiscard]] std::function<void()> timed_work(const Orbit& orbit, int orbits, Propagator propagator);

/// Propagates an orbit over @p orbits revolutions and records the errors. @param repeats of the timing
/// @throws Failure if the propagation fails
[[nodiscard]] EnergyRecord follow(const Orbit& orbit, int orbits, Propagator propagator, int repeats);

/// State on an ellipse after @p time by the textbook form of Lagrange's F and G: Newton's iteration for the
/// change dE of the eccentric anomaly, G = t - sqrt(a^3/mu) (dE - sin dE) with t from the start.
/// @param enough Newton's iteration stops at a change of dE of at most this; 0: at rounding
[[nodiscard]] orbit::State textbook_f_and_g(const orbit::State& start, double time, double mu,
                                            double enough = 0);

/// follow() as a result of the chapter.
[[nodiscard]] scene::Result<EnergyRecord> followed(const Orbit& orbit, int orbits, Propagator propagator);
/// Interpretation of the printed settings.
[[nodiscard]] const char* reading_of(Propagator propagator);

}  // namespace nlmech::chapters::two_body_series
