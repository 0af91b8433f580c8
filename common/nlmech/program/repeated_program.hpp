/// @file
/// A program whose values in double are computed many times.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/machine_code/machine_code.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program {

/// Outputs @p first to @p last - 1 of a program in double: by the interpreter, and after many evaluations by
/// machine code with the same results. Threads may share an object.
class RepeatedValues {
 public:
  /// Evaluations after which machine code is made: it repays its making, some 10 us and 0.2 us an
  /// instruction, within about as many.
  static constexpr int repays_after = 1000;

  /// @param program outlives this object
  RepeatedValues(const Program& program, std::size_t first, std::size_t last)
      : program_(program), first_(first), last_(last) {}

  /// The machine code, to be called with separate memory for state and values; null: use the interpreter.
  [[nodiscard]] machine_code::Values* code() const {
    if (machine_code::Values* const made = ready_.load(std::memory_order_acquire)) return made;
    // Threads may lose counts, which delays the code.
    const int left = left_.load(std::memory_order_relaxed);
    if (left == 0) return nullptr;
    left_.store(left - 1, std::memory_order_relaxed);
    return left == 1 ? make() : nullptr;
  }

 private:
  [[nodiscard]] machine_code::Values* make() const;

  const Program& program_;
  std::size_t first_, last_;
  mutable std::atomic<int> left_ = repays_after;
  mutable std::atomic<machine_code::Values*> ready_ = nullptr;
  mutable std::shared_ptr<machine_code::Values> owner_;
  mutable std::once_flag once_;
};

/// A right-hand side: the first outputs are the slopes of the state.
class RepeatedProgram : public Program {
 public:
  /// @param outputs the slopes of the state of @p graph, then any others
  RepeatedProgram(const Graph& graph, const std::vector<NodeId>& outputs)
      : Program(graph, outputs),
        size_(graph.size()),
        slopes_(*this, 0, index(size_)),
        accelerations_(*this, index(size_) / 2, index(size_)) {}

  /// dx/dt in double.
  template <class State>
  void slopes(double t, const State& x, State& dxdt) const {
    machine_code::Values* const code = slopes_.code();
    if (code != nullptr && x.data() != dxdt.data()) return code(t, x.data(), dxdt.data());
    run(t, x, 0, index(size_), [&](int i, double value) { dxdt[i] = value; });
  }
  /// The slopes of the second half of the state, @p v.
  template <class Half>
  void accelerations(double t, const Half& q, const Half& v, Half& a) const {
    const int half = size_ / 2;
    machine_code::Values* const code = accelerations_.code();
    if (code != nullptr && size_ <= most_copied) {
      std::array<double, most_copied> state;
      std::copy_n(v.data(), half, std::copy_n(q.data(), half, state.data()));
      return code(t, state.data(), a.data());
    }
    const auto state = [&](int i) { return i < half ? q[i] : v[i - half]; };
    run(t, Indexed<decltype(state)>{state}, index(half), index(size_),
        [&](int i, double value) { a[i] = value; });
  }

 private:
  static constexpr int most_copied = 1024;
  template <class Get>
  struct Indexed {
    const Get& get;
    double operator[](int i) const { return get(i); }
  };

  int size_;
  RepeatedValues slopes_, accelerations_;
};

}  // namespace nlmech::program
