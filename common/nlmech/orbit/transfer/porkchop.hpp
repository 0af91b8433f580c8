/// @file
/// Pork-chop plots: speeds of transfer between two orbits on a grid of departure and arrival times.
#pragma once

#include <cstdint>
#include <vector>

#include "nlmech/orbit/state.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::orbit {

/// Body on a conic about the centre, given by its state at one time.
struct Ephemeris {
  State state;       ///< position and velocity at the epoch, position not 0
  double epoch = 0;  ///< time of the state
};

/// Equidistant times, including both ends.
struct Window {
  double first = 0;  ///< earliest time
  double last = 0;   ///< latest time; not before the first
  int count = 2;     ///< number of times, at least 1 (then only `first`)

  /// Time @p k, from 0 to count - 1. Increases with k; the last one is exactly `last`.
  [[nodiscard]] double at(int k) const {
    return k == 0 ? first : k == count - 1 ? last : first + (last - first) * (k / (count - 1.0));
  }
};

/// Orbits and time windows of a pork-chop plot. Any consistent units.
struct PorkchopProblem {
  double mu = 1;             ///< gravitational parameter of the centre, positive
  Ephemeris from;            ///< departure body
  Ephemeris to;              ///< arrival body
  Window departures;         ///< departure times: rows of the grid
  Window arrivals;           ///< arrival times: columns of the grid
  int most_revolutions = 0;  ///< limit of whole revolutions of a transfer, 0 to 1000
};

/// Best transfer for one pair of times.
struct PorkchopCell {
  double v_departure = 0;  ///< |v_1 - v(departure body)|; infinite if there is no transfer
  double v_arrival = 0;    ///< |v_2 - v(arrival body)|; infinite if there is no transfer
  /// Whole revolutions; -1: no transfer, because the arrival is not after the departure, or the positions
  /// differ but lie in one direction from the centre.
  std::int32_t revolutions = -1;
  bool long_way = false;                      ///< transfer angle above 180 degrees
  LambertBranch branch = LambertBranch::low;  ///< branch, for one revolution or more

  /// Is there a transfer?
  [[nodiscard]] bool exists() const noexcept { return revolutions >= 0; }
};

/// Grid of best transfers.
struct Porkchop {
  std::vector<double> departures;   ///< times of the rows
  std::vector<double> arrivals;     ///< times of the columns
  std::vector<PorkchopCell> cells;  ///< row after row
  Statistics statistics;  ///< right_hand_sides: evaluations of the time of flight; steps: arcs; seconds
  /// success; `outside_validity` if the search for an arc failed (an extreme time of flight; the cell may
  /// then lack a transfer); `collision` if one of the bodies is in the centre at a time of the grid, in which
  /// case there are no cells
  Status status;

  /// Row @p i and column @p j.
  [[nodiscard]] const PorkchopCell& at(std::size_t i, std::size_t j) const {
    return cells[i * arrivals.size() + j];
  }
};

/// For every pair of times, the transfer with the smallest sum of the speeds at departure and arrival, over
/// short and long way and all revolutions. For opposite positions the plane is that of the departure body;
/// for equal positions (to 64 eps) the transfer is by whole revolutions in the direction of motion of that
/// body. Positions of the bodies are computed once per row and column. Cells are independent, so the results
/// are bitwise equal for any number of threads.
///
/// Tests compare every cell with the best of all its arcs (16 eps) and the minimum with Hohmann's transfer
/// (64 eps), and check bitwise equality for any number of threads.
/// @param threads number of threads, at most 1024; 0: one per processor
/// @throws std::invalid_argument for invalid states, times or counts (with their values), more than 2^31 - 1
/// cells, or mu or a distance outside 1e-100 to 1e100
[[nodiscard]] Porkchop porkchop(const PorkchopProblem& problem, int threads = 0);

}  // namespace nlmech::orbit
