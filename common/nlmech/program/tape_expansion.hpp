/// @file
/// Taylor coefficients of a solution from a tape, with vector instructions.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "nlmech/program/machine_code/code_on_demand.hpp"
#include "nlmech/program/tape.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech {

/// The instruction set for the replay of tapes: AVX2 if available, also on processors with AVX-512. Sums of
/// at most a hundred terms are too short for eight lanes, and a wide load stalls on coefficients that were
/// just stored.
[[nodiscard]] InstructionSet replay_instruction_set();

/// Taylor coefficients of the solution through a point. For a tape of m Cauchy products order p costs m p^2/2
/// multiplications and as many additions; squares cost half of that.
///
/// Time is counted in units of a scale T, the paper's tau = t/T (Filipich and Rosales, Eq. 40): coefficient k
/// is T^k times the Taylor coefficient. For a power of two T all roundings are those of T = 1, and nothing
/// overflows if T is near the radius of convergence.
class TapeExpansion {
 public:
  /// @param set baseline kernels, or for any other set those of AVX2. Both sum in different orders, so the
  /// last digits differ.
  /// @throws std::invalid_argument if the processor does not have @p set
  explicit TapeExpansion(InstructionSet set = replay_instruction_set());

  /// Expansions, of all runs, that take about as long as making machine code, which then replaces the kernel.
  static constexpr int repays_after = 300;

  /// Loads a tape for series of order @p order >= 1. Allocates if more memory is needed than before.
  /// @param codes code that other runs share and whose expansions count too; none: that of this object
  void load(Tape tape, int order, machine_code::SeriesCodes* codes = nullptr);

  /// Computes the coefficients of the solution through @p x (with the size of the tape) at time @p t. Never
  /// throws; values that are not finite propagate to the coefficients.
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
  std::shared_ptr<const machine_code::SeriesCode> code_;
};

}  // namespace nlmech
