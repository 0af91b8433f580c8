/// @file
/// Taylor coefficients of several solutions in parallel, one per lane of the vector registers.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "nlmech/program/machine_code/code_on_demand.hpp"
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
  /// Sets time, state and unit of time for the expansion of a lane; see TapeExpansion::expand().
  void set(int lane, double t, const double* x, double scale);
  /// Expands all lanes.
  void expand();
  /// Coefficient @p k of component @p i in lane 0; those of the other lanes follow.
  [[nodiscard]] const double* coefficients(int i, int k) const { return at(i + 1, k); }

  /// The sum of c_k s^k for k = 1, ..., order() of component @p i in lane 0, from the latest add_up(); those
  /// of the other lanes follow.
  [[nodiscard]] const double* increments(int i) const { return sums_.get() + i * lanes_; }
  /// Sets the argument s for the sum of the series of a lane.
  void set_argument(int lane, double s) { arguments_.get()[lane] = s; }
  /// Sums the series of all lanes.
  void add_up();

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
  Numbers memory_, constants_, scales_, arguments_, sums_;
  std::vector<double> reciprocals_;
  InstructionSet set_;
  std::shared_ptr<const machine_code::SeriesCode> code_;
};

}  // namespace nlmech
