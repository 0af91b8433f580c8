/// @file
/// What programs could have printed for the paper's tables 4 and 5: starts, timings of the load, iterations
/// cut short and readings of a peak, and how well any of them, or chance, fits nine numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/hermitian/peaks.hpp"

namespace nlmech::chapters::hermitian {

/// A table of first peaks: by Laier's, Argyris' and Newmark's operators with the step 0.2, then 0.1 and 0.05.
using Nine = std::array<double, 9>;

/// The table's steps, in its order.
inline constexpr std::array peak_steps = {0.2, 0.1, 0.05};
/// The table's columns, in its order.
inline constexpr std::array peak_operators = {ivp::laier, ivp::argyris, ivp::newmark_pair};

/// Names of these operators.
inline constexpr std::array peak_columns = {"Laier", "Argyris", "Newmark"};

/// One of the paper's two tables of first peaks.
struct PeakTable {
  std::string title;       ///< "Table 4"
  std::string place;       ///< "table-4"
  std::string oscillator;  ///< "Duffing"
  Case what;               ///< equation and start
  double exact;            ///< the first peak

  /// What is printed in a row and a column, as PublishedValue::name().
  [[nodiscard]] std::string name(std::size_t row, std::size_t column) const;
  /// All that is printed.
  [[nodiscard]] Nine printed() const;
};
/// The Duffing oscillator from rest.
[[nodiscard]] PeakTable table_4();
/// Van der Pol's oscillator from (0.01, 0).
[[nodiscard]] PeakTable table_5();

/// What the paper does not say of the run that gave a number.
struct Program {
  ivp::State x0;          ///< position and velocity at first
  double begin = 0;       ///< time on the load's clock at which the motion begins
  double ahead = 0;       ///< steps by which the load runs ahead besides
  bool no_first = false;  ///< acceleration and jerk are taken for 0 at the begin of the first step
  int updates = 50;       ///< Newton's, at most, from the state before
  bool old_load = false;  ///< the end of a step gets the load of its begin
};

/// Ends of steps round the first turn, which is between the second and the third.
struct Turn {
  std::array<ivp::State, 4> x;  ///< NaN where there is none
  double step;                  ///< between them
};

/// Steps of @p program until one after the velocity has passed zero against @p sign; all NaN if it does not
/// before 20 units of time. With 50 updates and no other oddity it is the run of ivp::Hermitian.
[[nodiscard]] Turn turn_of(const ivp::System& system, const Program& program, const ivp::HermitianPair& pair,
                           double step, double sign);

/// How a peak is read off the ends of steps.
enum class Reading {
  furthest,  ///< position at the end of a step that is furthest out
  before,    ///< the last one before the velocity turns
  after,     ///< the first one after
  parabola,  ///< vertex through the furthest and its neighbours
  cubic      ///< between the two by positions and velocities
};
/// All of them.
inline constexpr std::array readings = {Reading::furthest, Reading::before, Reading::after, Reading::parabola,
                                        Reading::cubic};
/// For tables: "furthest end of a step".
[[nodiscard]] std::string_view to_string(Reading reading);

/// The peak. @param sign 1: a maximum; -1: a minimum
[[nodiscard]] double peak_of(const Turn& turn, Reading reading, double sign);

/// One combination and the table that it gives.
struct Combination {
  Program program;  ///< of all nine runs
  Reading reading;  ///< of all nine peaks
  Nine peaks;       ///< NaN where a run has none
};

/// Rest, and a position or a velocity of plus or minus 0.001, 0.002, 0.005 to 2 alone: 45 starts.
[[nodiscard]] std::vector<ivp::State> searched_starts();
/// Starts, loads of plus or minus cosine or sine, ahead by -2 to 2 steps in halves, with and without a first
/// acceleration, one Newton update with the old or the new load, two, or as many as it takes, five readings.
[[nodiscard]] std::vector<Combination> duffing_combinations();
/// The same without a load, and without rest, which never moves.
[[nodiscard]] std::vector<Combination> van_der_pol_combinations();

/// The least miss, in units of the last printed digit, 1e-4, and the number of the combination that has it.
struct Best {
  double miss = HUGE_VAL;  ///< of the number that is missed most
  std::size_t number = 0;  ///< of the combination
};
/// How close combinations come to a table.
struct Fit {
  Best all;                     ///< one combination for all nine numbers
  std::array<Best, 3> columns;  ///< one for each column of three
  int most = 0;                 ///< greatest number of the nine that one combination gives, to a unit

  /// The miss where each column may have a combination of its own.
  [[nodiscard]] double by_columns() const;
};
/// How many of the nine are missed by one unit at most. A NaN is missed.
[[nodiscard]] int rows_met(const Nine& ours, const Nine& printed);
/// Over all combinations. @param all at least one
[[nodiscard]] Fit best_fit(std::span<const Nine> all, const Nine& printed);

/// What a surrogate keeps of a printed table.
enum class Surrogates {
  same_peak,  ///< the peak: the distances of a column from it are multiplied by one number from 0.5 to 1.5
  any_peak    ///< not even that: the peak is multiplied by such a number, too
};
/// Tables like @p printed that no program has made: as smooth, of like errors, rounded alike. They depend on
/// the arguments alone. @param peak to which its columns converge
[[nodiscard]] std::vector<Nine> surrogates(const Nine& printed, double peak, Surrogates kind, int count,
                                           std::uint64_t seed = 1);
/// (1 + those of @p others that are not above @p ours) / (1 + all of them): how often chance fits as well.
[[nodiscard]] double chance_of(std::span<const double> others, double ours);

}  // namespace nlmech::chapters::hermitian
