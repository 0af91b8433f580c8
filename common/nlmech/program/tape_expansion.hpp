/// @file
/// Taylor coefficients of a solution from a tape, in vectors that the processor has.
#pragma once

#include <cstddef>
#include <vector>

#include "nlmech/program/tape.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech {

/// The set with which tapes are replayed: AVX2 where there is it, also beside AVX-512. Sums of at most a
/// hundred terms are too short for eight lanes, and a wide load waits for the many coefficients that were
/// just stored.
[[nodiscard]] InstructionSet replay_instruction_set();

/// The coefficients of the solution through a point. With a tape of m Cauchy products order p costs
/// m p^2/2 multiplications and as many additions, squares half of that.
///
/// Time is counted in units of a scale T, the paper's tau = t/T (Filipich and Rosales, Eq. 40): coefficient k
/// is T^k times the Taylor coefficient. With a power of two for T all roundings are those of T = 1, and
/// nothing overflows as long as T is not far from the radius of convergence.
class TapeExpansion {
 public:
  /// @param set which kernels to use: with more than the baseline those of AVX2. The two sum in other orders,
  /// so their last digits differ.
  /// @throws std::invalid_argument if this processor does not have it
  explicit TapeExpansion(InstructionSet set = replay_instruction_set());

  /// Takes a tape for series of order @p order >= 1. Allocates if it needs more memory than before.
  void load(Tape tape, int order);

  /// Computes the coefficients of the solution through @p x (as many components as the tape has) at time
  /// @p t. Never throws; what is not finite stays so in the coefficients.
  void expand(double t, const double* x, double scale = 1);

  /// Coefficients 0 to order() of component @p i.
  [[nodiscard]] const double* coefficients(int i) const { return memory_.data() + (i + 1) * stride_; }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }
  /// The tape.
  [[nodiscard]] const Tape& tape() const { return tape_; }

 private:
  void first_pass(double scale);

  Tape tape_;
  tape::Replay replay_;
  int order_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> memory_, reciprocals_;
};

}  // namespace nlmech
