/// @file
/// A program whose values are computed many times.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "nlmech/program/machine_code/code_on_demand.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program {

/// A right-hand side, computed by the interpreter, and after many evaluations by machine code with the same
/// results.
class RepeatedProgram : public Program {
 public:
  /// Evaluations, of all runs, after which the code is made. Making it takes some 10 us and 0.2 us an
  /// instruction, which it repays within about as many.
  static constexpr int repays_after = 1000;

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
  machine_code::CodeOnDemand<machine_code::Values> slopes_{repays_after}, accelerations_{repays_after};
};

}  // namespace nlmech::program
