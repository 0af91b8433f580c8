/// @file
/// Taylor coefficients of several solutions side by side, one a lane of the processor's vectors.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "nlmech/program/tape.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech {

/// As TapeExpansion, for as many solutions at once as there are lanes: of one right-hand side, or of several
/// that differ in their constants alone. Every lane has the bits of a TapeExpansion with
/// replay_instruction_set() (in baseline lanes: with InstructionSet::baseline), whatever the others hold;
/// tests hold all operations to that.
class TapeLanes {
 public:
  static constexpr int most_lanes = 16;  ///< of any processor

  /// @throws std::invalid_argument if this processor does not have @p set
  explicit TapeLanes(InstructionSet set = best_instruction_set());

  /// Takes the operations of a tape for series of order @p order >= 2, with its constants in all lanes.
  void load(Tape tape, int order);
  /// Has @p tape the operations of the loaded one on the same operands, so that it can be put into a lane?
  [[nodiscard]] bool fits(const Tape& tape) const;
  /// Puts the constants of a tape that fits into a lane.
  void put(int lane, const Tape& tape);

  /// How many solutions at once.
  [[nodiscard]] int lanes() const { return static_cast<int>(lanes_); }
  /// Components of the state.
  [[nodiscard]] int size() const { return tape_.size(); }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }
  /// Where and with which unit of time a lane is to be expanded, see TapeExpansion::expand().
  void set(int lane, double t, const double* x, double scale);
  /// Expands all lanes.
  void expand();
  /// Coefficient @p k of component @p i in lane 0; those of the other lanes follow.
  [[nodiscard]] const double* coefficients(int i, int k) const { return at(i + 1, k); }

  /// The sums of c_k s^k for k = 1, ..., order() of component @p i in lane 0, by the latest add_up(); those
  /// of the other lanes follow.
  [[nodiscard]] const double* increments(int i) const { return sums_.get() + i * lanes_; }
  /// Where the series of a lane is to be summed.
  void set_argument(int lane, double s) { arguments_.get()[lane] = s; }
  /// Sums the series of all lanes.
  void add_up();

 private:
  struct Release {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  /// Begins with a line of memory, as the widest registers want it.
  using Numbers = std::unique_ptr<double[], Release>;
  static Numbers zeros(std::ptrdiff_t count);

  [[nodiscard]] double* at(int series, int k) const {
    return memory_.get() + (static_cast<std::ptrdiff_t>(series) * (order_ + 1) + k) * lanes_;
  }
  [[nodiscard]] double* constant(int i) const { return constants_.get() + i * lanes_; }
  void first_pass();
  void first_linear(const tape::Program& program, int j);

  const tape::LaneKernel* kernel_;
  std::ptrdiff_t lanes_;  // what pointers are moved by
  int order_ = 0;
  Tape tape_;
  Numbers memory_, constants_, scales_, arguments_, sums_;
  std::vector<double> reciprocals_;
};

}  // namespace nlmech
