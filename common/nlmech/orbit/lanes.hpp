/// @file
/// One thread's lanes of an ensemble: orbits come in, move side by side, and go out. Internal to the
/// component.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/kernels/ensemble.hpp"

namespace nlmech::orbit::detail {

/// The lanes, each with a flight or idle.
class Lanes {
 public:
  /// @param limit steps of a flight
  Lanes(const kernels::EnsembleKernel& kernel, const kernels::LaneSettings& settings, const InnerRows& rows,
        std::int64_t limit);

  /// How many may be taken in before the next run().
  [[nodiscard]] int free() const { return kernel_.lanes - busy_; }
  /// Is there anything to run?
  [[nodiscard]] int busy() const { return busy_; }
  /// A flight about a point mass, its start and field checked, that has somewhere to go.
  void take_in(std::size_t number, const Flight& flight);
  /// Steps until a lane is free, or some thousand times. Puts what has ended into @p solutions.
  void run(std::vector<Solution>& solutions);
  /// Ends all flights that are under way.
  void stop(const Status& status, std::vector<Solution>& solutions);

 private:
  /// Powers of two in which a lane counts, and what its flight has asked for.
  struct Lane {
    bool busy = false;
    bool backwards = false;
    std::size_t number = 0;
    int length = 0, time = 0;  ///< exponents of the units
    double mu = 1, until = 0, start_radius = 1;
    std::int64_t first_step = 0, next_row = 1;
  };

  void idle(int lane);
  void choose_units(int lane);
  void give_rows(int lane, double taken);
  void await_row(int lane);
  [[nodiscard]] double row_after_now(const Lane& lane, int i, double t) const;
  [[nodiscard]] State state(int lane) const;
  [[nodiscard]] State users(const Lane& lane, State own) const;
  [[nodiscard]] double time_of(int lane) const;
  [[nodiscard]] Status lost(int lane) const;
  void end(int lane, Status status, std::vector<Solution>& solutions);

  const kernels::EnsembleKernel& kernel_;
  const kernels::LaneSettings& settings_;
  const InnerRows& rows_;
  std::int64_t limit_, steps_ = 0;
  int busy_ = 0;
  std::array<Lane, kernels::most_lanes> lanes_;
  kernels::LaneBlock block_{};
};

}  // namespace nlmech::orbit::detail
