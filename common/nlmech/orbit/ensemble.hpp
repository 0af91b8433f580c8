/// @file
/// Propagation of many orbits: vectorised, one orbit per lane, and multithreaded.
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

/// Initial value problem of one orbit of an ensemble.
struct PropagationRequest {
  State start;       ///< initial state at t = 0
  double until = 0;  ///< end time, of either sign
  Gravity gravity;   ///< gravity field
};

/// Vectorised Taylor series for many orbits. Every orbit has its own step size; a finished orbit is replaced
/// by the next one. The step-size control for point masses is that of AnalyticContinuation, for zonal fields
/// that of ivp::Series.
///
/// The result of an orbit is bitwise independent of the other orbits, their number and order, and the number
/// of threads. AVX-512 and AVX2 give the same bits; the baseline, without fused multiply-add, gives others
/// (see instructions).
///
/// Tests check the errors against the bound of AnalyticContinuation. On ellipses the energy error is a random
/// walk; on an exact circle every step has the same rounding error, and the energy drifts by about 1e-16 per
/// orbit.
struct TaylorEnsemble {
  static constexpr std::string_view name = "taylor-ensemble";  ///< name in messages
  double tolerance = 1e-15;  ///< relative tolerance of a step for |r| and |v|; from 1e-18 to 0.1
  int order = 0;             ///< degree of the series, even, from 8 to 32; 0: chosen by the tolerance
  int threads = 0;           ///< number of threads, at most 1024; 0: one per processor
  /// Instruction set; empty: the best of this processor.
  std::optional<InstructionSet> instructions = std::nullopt;
};

/// Called with the index of an orbit, a time and its state; in order of time for each orbit, from several
/// threads.
using RowSink = std::function<void(std::size_t request, double t, const State& x)>;

/// Output rows between start and end.
struct InnerRows {
  double every = std::numeric_limits<double>::infinity();  ///< interval of output, positive
  RowSink sink = {};                                       ///< receiver of the rows
};

/// Propagates every orbit from its start at t = 0 to its end. Failures of an orbit are reported in its status
/// and do not affect the others: `non_finite` for an initial state that is not finite, `collision` for a body
/// in the centre, `outside_validity` for an invalid field, and those of propagate(). A failed orbit with
/// zonal terms is repeated by AnalyticContinuation. Statistics::seconds stays 0.
/// @param limits steps of each orbit; seconds for all: at this limit a running orbit keeps its last state and
/// a waiting one its initial state
/// @return one solution per orbit, in order
/// @throws std::invalid_argument for options out of range
[[nodiscard]] std::vector<Solution> propagate_all(std::span<const PropagationRequest> requests,
                                                  const TaylorEnsemble& method = {},
                                                  const InnerRows& rows = {}, const Limits& limits = {});

}  // namespace nlmech::orbit
