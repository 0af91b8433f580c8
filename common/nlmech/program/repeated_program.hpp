/// @file
/// A program whose values and partial derivatives are computed many times.
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

/// A function in machine code that is made when it has been asked for often enough. Threads may share an
/// object.
template <class Function>
class CodeOnDemand {
 public:
  /// Requests after which the code is made. Making it takes some 10 us and 0.2 us an instruction, which it
  /// repays within about as many.
  static constexpr int repays_after = 1000;

  /// The code; null as long as the interpreter is to be used.
  /// @param make returns the code, or null if there is none; it is called once
  template <class Make>
  [[nodiscard]] Function* operator()(const Make& make) const {
    if (Function* const made = ready_.load(std::memory_order_acquire)) return made;
    // Threads may lose counts, which delays the code.
    const int left = left_.load(std::memory_order_relaxed);
    if (left == 0) return nullptr;
    left_.store(left - 1, std::memory_order_relaxed);
    if (left > 1) return nullptr;
    std::call_once(once_, [&] {
      owner_ = make();
      ready_.store(owner_.get(), std::memory_order_release);
    });
    return owner_.get();
  }

 private:
  mutable std::atomic<int> left_ = repays_after;
  mutable std::atomic<Function*> ready_ = nullptr;
  mutable std::shared_ptr<Function> owner_;
  mutable std::once_flag once_;
};

/// A right-hand side, computed by the interpreter, and after many evaluations by machine code with the same
/// results.
class RepeatedProgram : public Program {
 public:
  /// @param outputs the slopes of the state of @p graph, then any others
  RepeatedProgram(const Graph& graph, const std::vector<NodeId>& outputs)
      : Program(graph, outputs), size_(graph.size()) {}

  /// dx/dt in double.
  template <class State>
  void slopes(double t, const State& x, State& dxdt) const {
    auto* const code = slopes_([this] { return machine_code::values(*this, 0, index(size_)); });
    if (code != nullptr && x.data() != dxdt.data()) return code(t, x.data(), dxdt.data());
    run(t, x, 0, index(size_), [&](int i, double value) { dxdt[i] = value; });
  }
  /// dx/dt with partial derivatives.
  template <class State>
  void slopes(const machine_code::Numbers& t, const State& x, State& dxdt) const {
    const auto put = [&](int i, const machine_code::Numbers& value) { dxdt[i] = value; };
    if (auto* const code = partial_derivatives_([this] { return machine_code::partial_derivatives(*this); }))
      run_by(*code, t, x, 0, index(size_), put);
    else
      run(t, x, 0, index(size_), put);
  }
  /// The slopes of the second half of the state, @p v.
  template <class Half>
  void accelerations(double t, const Half& q, const Half& v, Half& a) const {
    const int half = size_ / 2;
    auto* const code = accelerations_([&] { return machine_code::values(*this, index(half), index(size_)); });
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
  CodeOnDemand<machine_code::Values> slopes_, accelerations_;
  CodeOnDemand<machine_code::PartialDerivatives> partial_derivatives_;
};

}  // namespace nlmech::program
