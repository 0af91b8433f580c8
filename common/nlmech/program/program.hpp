/// @file
/// Expressions compiled to a list of instructions for any number type.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/interval.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::machine_code {
class ValueAssembler;
}

namespace nlmech::program {

/// Evaluates several expressions at a time and a state. Each operation is done once, operations on numbers in
/// advance, and the memory of results is reused.
class Program {
 public:
  /// Nothing to compute.
  Program() = default;
  /// @param outputs expressions of @p graph
  Program(const Graph& graph, const std::vector<NodeId>& outputs);

  /// Number of instructions.
  [[nodiscard]] std::size_t instructions() const { return instructions_.size(); }
  /// Number of expressions.
  [[nodiscard]] std::size_t outputs() const { return outputs_.size(); }

  /// Computes outputs @p first to @p last - 1 (all instructions are run).
  /// @param t time
  /// @param x component i of the state is x[i]
  /// @param out called as out(i - first, value) for each output i
  template <class T, class State, class Out>
  void run(const T& t, const State& x, std::size_t first, std::size_t last, Out&& out) const {
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (places_ <= few) return run_on_stack<few>(t, x, first, last, out);
      if (places_ <= many_bytes / sizeof(T))
        return run_on_stack<many_bytes / sizeof(T)>(t, x, first, last, out);
    }
    std::vector<T> place(places_);
    run_in(place.data(), t, x, first, last, out);
  }

 private:
  friend class ProgramCompiler;
  friend class machine_code::ValueAssembler;
  /// An operation with the places of its operands; r is that of the result.
  struct Instruction {
    Operation operation;
    Function function;
    std::uint32_t r, a, b, decides;
    double c;
  };
  /// A place, or a number.
  struct Output {
    bool number;
    std::uint32_t place;
    double c;
  };

  static constexpr std::size_t few = 32, many_bytes = 65'536;

  // Runs in uninitialised memory on the stack.
  template <std::size_t most, class T, class State, class Out>
  void run_on_stack(const T& t, const State& x, std::size_t first, std::size_t last, Out& out) const {
    alignas(T) std::array<std::byte, most * sizeof(T)> memory;
    run_in(reinterpret_cast<T*>(memory.data()), t, x, first, last, out);
  }

  template <class T, class State, class Out>
  void run_in(T* place, const T& t, const State& x, std::size_t first, std::size_t last, Out& out) const {
    place[0] = t;
    for (std::size_t i = 0; i < size_; ++i) place[i + 1] = component(x, i);
    for (const Instruction& i : instructions_) carry_out(i, place);
    for (std::size_t i = first; i < last; ++i) {
      const Output& o = outputs_[i];
      out(static_cast<int>(i - first), o.number ? T(o.c) : place[o.place]);
    }
  }

  // Containers of the standard library have an unsigned index, all others a signed one.
  template <class State>
  static decltype(auto) component(const State& x, std::size_t i) {
    if constexpr (requires { typename State::size_type; })
      return x[i];
    else
      return x[static_cast<int>(i)];
  }
  // The common operations are inlined; the others cost more than a call.
  template <class T>
  [[gnu::always_inline]] void carry_out(const Instruction& i, T* place) const {
    const T &a = place[i.a], &b = place[i.b];
    T& r = place[i.r];
    switch (i.operation) {
      case Operation::sum: r = a + b; return;
      case Operation::difference: r = a - b; return;
      case Operation::shifted: r = a + i.c; return;
      case Operation::scaled: r = i.c * a; return;
      case Operation::product: r = product(a, b); return;
      case Operation::quotient: r = a / b; return;
      case Operation::combined: r = a + i.c * b; return;
      default: r = value(i, place); return;
    }
  }
  template <class T>
  [[gnu::always_inline]] static T product(const T& a, const T& b) {
    if constexpr (std::is_same_v<T, Interval>)
      return &a == &b ? square(a) : a * b;
    else
      return a * b;
  }
  template <class T>
  [[gnu::noinline]] T value(const Instruction& i, const T* place) const {
    using std::atan2;
    using std::pow;
    const T &a = place[i.a], &b = place[i.b];
    switch (i.operation) {
      case Operation::divided: return a / i.c;
      case Operation::reciprocal: return i.c / a;
      case Operation::power: return pow(a, i.c);
      case Operation::any_power: return any_power(a, b);
      case Operation::function: return apply(i.function, a);
      case Operation::atan2: return atan2(a, b);
      case Operation::choice: return chosen(place[i.decides], a, b);
      case Operation::floor: return T(rounded_down(a));
      case Operation::table: return of_table(*tables_[static_cast<std::size_t>(i.c)], a);
      case Operation::number: return T(i.c);
      default: return a;
    }
  }

  // A switching function that is NaN gives NaN.
  template <class T>
  static T chosen(const T& decides, const T& a, const T& b) {
    if constexpr (std::is_same_v<T, Interval>) {
      return choice(decides, a, b);
    } else {
      const auto value = value_of(decides);
      return value >= 0 ? a : value < 0 ? b : decides;
    }
  }

  template <class T>
  static T of_table(const Table& table, const T& a) {
    if constexpr (std::is_same_v<T, Interval>)
      return table.bounds(a);
    else
      return table.at(a);
  }

  // A plain number also for types with derivatives: it is constant up to the next jump.
  template <class T>
  static auto rounded_down(const T& a) {
    using std::floor;
    return floor(value_of(a));
  }

  // std::pow for numbers; otherwise exp(b log a), for a > 0.
  template <class T>
  static T any_power(const T& a, const T& b) {
    using std::exp;
    using std::log;
    using std::pow;
    if constexpr (std::is_floating_point_v<T>) {
      return pow(a, b);
    } else if constexpr (std::is_same_v<T, Interval>) {
      return a.low < 0 ? Interval() : exp(b * log(a));
    } else {
      return exp(b * log(a));
    }
  }

  template <class T>
  static T apply(Function function, const T& a) {
    using std::acos;
    using std::asin;
    using std::asinh;
    using std::atan;
    using std::cos;
    using std::cosh;
    using std::erf;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sinh;
    using std::sqrt;
    using std::tan;
    using std::tanh;
    switch (function) {
      case Function::sqrt: return sqrt(a);
      case Function::exp: return exp(a);
      case Function::log: return log(a);
      case Function::sin: return sin(a);
      case Function::cos: return cos(a);
      case Function::tan: return tan(a);
      case Function::asin: return asin(a);
      case Function::acos: return acos(a);
      case Function::atan: return atan(a);
      case Function::sinh: return sinh(a);
      case Function::cosh: return cosh(a);
      case Function::tanh: return tanh(a);
      case Function::asinh: return asinh(a);
      default: return erf(a);
    }
  }

  std::size_t size_ = 0, places_ = 0;
  std::vector<Instruction> instructions_;
  std::vector<Output> outputs_;
  std::vector<std::shared_ptr<const Table>> tables_;
};

}  // namespace nlmech::program
