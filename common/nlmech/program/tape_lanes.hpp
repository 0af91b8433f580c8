/// @file
/// Taylor coefficients of several solutions in parallel, one per lane of the vector registers.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "nlmech/program/machine_code/code_on_demand.hpp"
#include "nlmech/program/series_step.hpp"
#include "nlmech/program/tape.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech {

/// TapeExpansion for as many solutions in parallel as there are lanes: of one right-hand side, or of several
/// that differ in constants only. Every lane has the bits of a TapeExpansion with replay_instruction_set()
/// (baseline lanes: with InstructionSet::baseline), independent of the other lanes; tests assert this for all
/// operations.
class TapeLanes {
 public:
  static constexpr int most_lanes = 16;  ///< largest number of lanes
  /// Expansions of all lanes, of all threads, after which machine code with the same results replaces the
  /// kernel.
  static constexpr int repays_after = 400;

  /// @throws std::invalid_argument if the processor does not have @p set
  explicit TapeLanes(InstructionSet set = best_instruction_set());

  /// Loads the operations of a tape for series of order @p order >= 2, with its constants in all lanes.
  /// @param codes as for TapeExpansion::load()
  void load(Tape tape, int order, machine_code::SeriesCodes* codes = nullptr);
  /// Does @p tape have the operations and operands of the loaded tape, so that a lane can hold it?
  [[nodiscard]] bool fits(const Tape& tape) const;
  /// Loads the constants of a tape that fits() into a lane.
  void put(int lane, const Tape& tape);

  /// Number of solutions in parallel.
  [[nodiscard]] int lanes() const { return static_cast<int>(lanes_); }
  /// Components of the state.
  [[nodiscard]] int size() const { return tape_.size(); }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }
  /// Sets time, state and unit of time for the expansion of a lane; see TapeExpansion::expand(). The state
  /// has no carry.
  void set(int lane, double t, const double* x, double scale);
  /// Sets time and unit of time.
  void set_time(int lane, double t, double scale);
  /// Expands all lanes.
  void expand();
  /// Coefficient @p k of component @p i in lane 0; those of the other lanes follow.
  [[nodiscard]] const double* coefficients(int i, int k) const { return at(i + 1, k); }

  /// The last terms of the series of all lanes in the norm of SeriesTail.
  void measure(double absolute_tolerance, double relative_tolerance);
  /// Those of a lane, from the latest measure().
  [[nodiscard]] SeriesTail<double> tail(int lane) const {
    const double* const all = tails_.get() + lane;
    return {all[0], all[lanes_], all[2 * lanes_]};
  }

  /// Sets the argument s for the sum of the series of a lane.
  void set_argument(int lane, double s) { arguments_.get()[lane] = s; }
  /// Sums the series of all lanes to end() and end_carry().
  void advance();
  /// Component @p i of the state in lane 0, and its carry; those of the other lanes follow.
  /// @{
  [[nodiscard]] const double* state(int i) const { return at(i + 1, 0); }
  [[nodiscard]] const double* carry(int i) const { return carries_.get() + i * lanes_; }
  /// @}
  /// The same at the end of the step; see add_increment().
  /// @{
  [[nodiscard]] double* end(int i) { return ends_.get() + i * lanes_; }
  [[nodiscard]] double* end_carry(int i) { return end_carries_.get() + i * lanes_; }
  /// @}
  /// Continues a lane from the end of its step.
  void accept(int lane);

 private:
  struct Release {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  /// Memory aligned to a cache line, for the widest registers.
  using Numbers = std::unique_ptr<double[], Release>;
  static Numbers zeros(std::ptrdiff_t count);

  [[nodiscard]] double* at(int series, int k) const {
    return memory_.get() + (static_cast<std::ptrdiff_t>(series) * (order_ + 1) + k) * lanes_;
  }
  [[nodiscard]] double* constant(int i) const { return constants_.get() + i * lanes_; }
  void first_pass();
  void first_linear(const tape::Program& program, int j);

  const tape::LaneKernel* kernel_;
  std::ptrdiff_t lanes_;  // number of lanes, signed for pointer arithmetic
  int order_ = 0;
  Tape tape_;
  Numbers memory_, constants_, scales_, arguments_, tails_, carries_, ends_, end_carries_;
  std::vector<double> reciprocals_;
  InstructionSet set_;
  std::shared_ptr<const machine_code::SeriesCode> code_;
};

}  // namespace nlmech
