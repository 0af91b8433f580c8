/// @file
/// Pork-chop plots: what a transfer between two orbits costs for every departure and arrival of a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "nlmech/orbit/state.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::orbit {

/// A body on a conic about the centre: where it is at one time.
struct Ephemeris {
  State state;       ///< position and velocity at the epoch, position not 0
  double epoch = 0;  ///< time of the state
};

/// Times at equal distances, ends included.
struct Window {
  double first = 0;  ///< the earliest
  double last = 0;   ///< the latest; not before the first
  int count = 2;     ///< how many, at least 1 (then it is the first alone)

  /// Time number @p k, from 0 to count - 1. Grows with k; the last one is `last` exactly.
  [[nodiscard]] double at(int k) const {
    return k == 0 ? first : k == count - 1 ? last : first + (last - first) * (k / (count - 1.0));
  }
};

/// From which orbit to which, and when. Any consistent units.
struct PorkchopProblem {
  double mu = 1;             ///< gravitational parameter of the centre, positive
  Ephemeris from;            ///< the body that is left
  Ephemeris to;              ///< the body that is reached
  Window departures;         ///< rows of the grid
  Window arrivals;           ///< columns
  int most_revolutions = 0;  ///< transfers of up to so many whole revolutions are looked at; at most 1000
};

/// One pair of times.
struct PorkchopCell {
  double v_departure = 0;         ///< |v_1 - v(body left)|; infinite if there is no transfer
  double v_arrival = 0;           ///< |v_2 - v(body reached)|; infinite if there is no transfer
  std::int32_t revolutions = -1;  ///< whole ones; -1: no transfer, because the arrival is not after the
                                  ///< departure or the positions lie in one direction from the centre and
                                  ///< are not one
  bool long_way = false;          ///< by more than 180 degrees
  LambertBranch branch = LambertBranch::low;  ///< of one revolution or more

  /// Is there a transfer?
  [[nodiscard]] bool exists() const noexcept { return revolutions >= 0; }
};

/// A grid.
struct Porkchop {
  std::vector<double> departures;   ///< times of the rows
  std::vector<double> arrivals;     ///< times of the columns
  std::vector<PorkchopCell> cells;  ///< row after row
  Statistics statistics;  ///< right_hand_sides: evaluations of the time of flight; steps: arcs; seconds
  /// success; `outside_validity` if a search for an arc was lost (a time of flight out of all proportion:
  /// the cell is then left without transfer); `collision` if a body of the two is in the centre at a time of
  /// the grid, and then there are no cells
  Status status;

  /// Row @p i and column @p j.
  [[nodiscard]] const PorkchopCell& at(std::size_t i, std::size_t j) const {
    return cells[i * arrivals.size() + j];
  }
};

/// For every pair of times the transfer whose speeds at departure and arrival have the least sum, over both
/// ways round and all revolutions. Where the positions are opposite, in the plane of the body that is left;
/// where they are one (to 64 eps), by whole revolutions in the direction of that body.
/// The positions of both bodies are computed once a row and column. Every cell is computed by itself, so that
/// the numbers are the same to the last bit for any number of threads.
///
/// Tests hold every cell to the best of all its arcs (16 eps), Hohmann's transfer to the minimum (64 eps),
/// and the bits to be the same for any number of threads.
/// @param threads how many, at most 1024; 0: one a processor
/// @throws std::invalid_argument for states, times or counts that cannot be meant (naming them), more than
/// 2^31 - 1 cells, or mu or a distance beyond 1e-100 to 1e100
[[nodiscard]] Porkchop porkchop(const PorkchopProblem& problem, int threads = 0);

}  // namespace nlmech::orbit
