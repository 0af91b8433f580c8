/// @file
/// Many orbits at once: one in each lane of a register, and on all processors.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nlmech/orbit/continuation.hpp"

namespace nlmech::orbit {

/// One orbit of many.
struct Flight {
  State start;       ///< at t = 0
  double until = 0;  ///< time at which it ends, of either sign
  Gravity gravity;   ///< of its centre
};

/// Taylor series of many orbits, in lanes. Every orbit has steps of its own, and an orbit that has arrived
/// makes room for the next. About point masses the steps are chosen like those of AnalyticContinuation, in
/// zonal fields like those of ivp::Series.
///
/// An orbit gives the same bits whatever its neighbours, their number and order, and the number of threads;
/// with AVX-512 and with AVX2 also the same as with the other. Without a fused multiply-add, in the baseline,
/// products are rounded by themselves, and the bits are others (see instructions).
///
/// Tests hold the errors to the bound of AnalyticContinuation. On ellipses the energy walks at random; on an
/// exact circle every step rounds alike, and it drifts, by some 1e-16 an orbit.
struct TaylorEnsemble {
  static constexpr std::string_view name = "taylor-ensemble";  ///< in sentences
  double tolerance = 1e-15;  ///< of a step, relative to |r| and |v|; from 1e-18 to 0.1
  int order = 0;             ///< degree of the series, even, from 8 to 32; 0: what suits the tolerance
  int threads = 0;           ///< how many, at most 1024; 0: one a processor
  /// Nothing: the best of this processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// Called with the number of a flight, a time and the state then; for one flight in the order of the times,
/// for several from several threads.
using RowSink = std::function<void(std::size_t flight, double t, const State& x)>;

/// Rows between start and end.
struct InnerRows {
  double every = std::numeric_limits<double>::infinity();  ///< distance in time, positive
  RowSink sink = {};                                       ///< what takes them
};

/// Moves every flight from its start at t = 0 to its end. Never throws for what a flight is or does: a start
/// that is none is `non_finite`, a body in the centre `collision`, a field that is none `outside_validity`,
/// and what happens on the way as for propagate(); the others are not touched by it. A flight with zonal
/// terms that fails is repeated by AnalyticContinuation. Statistics::seconds stays 0.
/// @param limits steps of each flight; seconds of the whole: then a flight under way stays where it is, and
/// one that has not begun at its start
/// @return a solution for each flight, in their order
/// @throws std::invalid_argument for options out of range
[[nodiscard]] std::vector<Solution> propagate_all(std::span<const Flight> flights,
                                                  const TaylorEnsemble& method = {},
                                                  const InnerRows& rows = {}, const Limits& limits = {});

}  // namespace nlmech::orbit
