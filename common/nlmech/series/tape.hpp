/// @file
/// A right-hand side recorded once as a tape: the list of its operations, from which Taylor coefficients are
/// computed without calling it again.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <type_traits>
#include <vector>

#include "nlmech/series/number_traits.hpp"
#include "nlmech/series/tape_program.hpp"
#include "nlmech/series/vector.hpp"

namespace nlmech {

/// A recorded right-hand side. Made by record(); replayed by TapeExpansion.
class Tape {
 public:
  /// Components of the state.
  [[nodiscard]] int size() const { return static_cast<int>(outputs_.size()); }
  /// Series that a replay keeps: the time, the state and one or two for each instruction.
  [[nodiscard]] int series() const { return series_; }
  /// Operations in one pass.
  [[nodiscard]] int instructions() const { return static_cast<int>(instructions_.size()); }
  /// Instructions with a Cauchy product, whose cost grows with the order.
  [[nodiscard]] int products() const;
  /// Does a component depend on the time, or on one that moves at a constant rate and so stands for it?
  [[nodiscard]] bool depends_on_time() const;
  /// The tape as the kernels read it; valid as long as the tape lives and stays where it is.
  [[nodiscard]] tape::Program program() const;

 private:
  friend class TapeCompiler;
  std::vector<tape::Instruction> instructions_;
  std::vector<tape::Term> terms_;
  std::vector<tape::Output> outputs_;
  int series_ = 0;
};

/// Notes the operations on Recorded quantities. The same operation on the same operands is noted once;
/// operations on constants are carried out.
class TapeRecorder {
 public:
  /// What was done.
  enum class Step : std::uint8_t {
    variable,
    sum,
    difference,
    scaled,   ///< constant times a
    divided,  ///< a over constant
    shifted,  ///< a plus constant
    product,
    quotient,
    reciprocal,  ///< constant over a
    root,
    exponential,
    logarithm,
    sine,
    cosine,
    hyperbolic_sine,
    hyperbolic_cosine,
    tangent,
    hyperbolic_tangent,
    power,           ///< a to the constant
    arc_sine,        ///< asin a, whose derivative by a is b
    arc_cosine,      ///< acos a, whose derivative by a is b
    arc_tangent,     ///< atan a, whose derivative by a is b
    error_function,  ///< erf a, whose derivative by a is b
    angle            ///< atan2(a, b)
  };
  /// An operation and its result.
  struct Node {
    Step step;        ///< operation
    int a;            ///< operand
    int b;            ///< second operand, or the same one again
    double constant;  ///< see Step
    double value;     ///< of the result at the point of the recording
    int degree;       ///< of the result as a polynomial of the time
    bool timed;       ///< does it depend on the time alone?
  };
  /// Degree of what is no polynomial of the time.
  static constexpr int endless = 1 << 20;

  /// @param size components of the state
  /// @param announced may the right-hand side branch on the time?
  TapeRecorder(int size, bool announced) : size_(size), announced_(announced) {}

  /// The time (the first variable) or the next component of the state, with its value.
  [[nodiscard]] int add_variable(double value);
  /// The result of an operation, new or noted before.
  [[nodiscard]] int add(Step step, int a, int b, double constant);
  /// The value of a result, for a branch. @throws std::invalid_argument unless it depends on the time alone
  /// and the problem announces its discontinuities
  [[nodiscard]] double branch_value(int node) const;
  /// All operations, operands first.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// The tape of what was recorded. Operations that no output needs are left out; sums, differences and
  /// multiples are gathered in linear combinations.
  [[nodiscard]] Tape finish(const std::vector<tape::Output>& outputs) const;

 private:
  int size_;
  bool announced_;
  std::vector<Node> nodes_;
  std::map<std::tuple<Step, int, int, double>, int> known_;
};

/// A quantity that remembers how it was made, or a constant: the scalar with which a right-hand side is
/// called once to be recorded. It has no order (<, >); value_of() of it, on which programs branch, is refused
/// unless the branch is announced.
class Recorded {
 public:
  /// The constant 0.
  Recorded() = default;
  /// A constant.
  template <class S>
  requires std::convertible_to<S, double> Recorded(const S& constant)
      : constant_(static_cast<double>(constant)) {}
  /// The node @p node of a recorder, which outlives the quantity.
  Recorded(TapeRecorder& recorder, int node) : recorder_(&recorder), node_(node) {}

  /// What a tape has to deliver: node (for now as number of the recording) or constant.
  [[nodiscard]] tape::Output output() const { return {node_, constant_}; }

  /// The same quantity.
  Recorded operator+() const { return *this; }
  /// Its negative.
  Recorded operator-() const;
  /// Sum.
  friend Recorded operator+(const Recorded& a, const Recorded& b);
  /// Difference.
  friend Recorded operator-(const Recorded& a, const Recorded& b);
  /// Product.
  friend Recorded operator*(const Recorded& a, const Recorded& b);
  /// Quotient.
  friend Recorded operator/(const Recorded& a, const Recorded& b);
  /// Adds a quantity.
  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  /// Subtracts a quantity.
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  /// Multiplies by a quantity.
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  /// Divides by a quantity.
  Recorded& operator/=(const Recorded& b) { return *this = *this / b; }

  /// Square root.
  friend Recorded sqrt(const Recorded& a);
  /// Exponential function.
  friend Recorded exp(const Recorded& a);
  /// Natural logarithm.
  friend Recorded log(const Recorded& a);
  /// Sine.
  friend Recorded sin(const Recorded& a);
  /// Cosine.
  friend Recorded cos(const Recorded& a);
  /// Tangent.
  friend Recorded tan(const Recorded& a);
  /// Hyperbolic sine.
  friend Recorded sinh(const Recorded& a);
  /// Hyperbolic cosine.
  friend Recorded cosh(const Recorded& a);
  /// Hyperbolic tangent.
  friend Recorded tanh(const Recorded& a);
  /// Arc sine.
  friend Recorded asin(const Recorded& a);
  /// Arc cosine.
  friend Recorded acos(const Recorded& a);
  /// Arc tangent.
  friend Recorded atan(const Recorded& a);
  /// Angle of the point (x, y).
  friend Recorded atan2(const Recorded& y, const Recorded& x);
  /// Error function.
  friend Recorded erf(const Recorded& a);
  /// a^p for a constant exponent: by products if p is a whole number, else for a_0 > 0.
  template <class P>
  requires std::is_arithmetic_v<P>
  friend Recorded pow(const Recorded& a, P p) { return a.power(static_cast<double>(p)); }
  /// x^y = exp(y log x), for x > 0.
  friend Recorded pow(const Recorded& x, const Recorded& y) {
    return y.recorder_ == nullptr ? x.power(y.constant_) : exp(y * log(x));
  }
  /// Absolute value: a branch, see value_of().
  friend Recorded abs(const Recorded& a) { return value_of(a) < 0 ? -a : a; }
  /// The number, for a branch. @throws std::invalid_argument unless it depends on the time alone and the
  /// problem announces its discontinuities
  friend double value_of(const Recorded& a) {
    return a.recorder_ == nullptr ? a.constant_ : a.recorder_->branch_value(a.node_);
  }

 private:
  [[nodiscard]] bool is_constant() const { return recorder_ == nullptr; }
  [[nodiscard]] Recorded step(TapeRecorder::Step step, double constant = 0) const;
  static Recorded step(TapeRecorder::Step step, const Recorded& a, const Recorded& b);
  // The function of that step, and its derivative.
  template <class Slope>
  [[nodiscard]] Recorded by_slope(TapeRecorder::Step step, Slope slope) const;
  [[nodiscard]] Recorded power(double p) const;
  [[nodiscard]] Recorded whole_power(double p) const;

  TapeRecorder* recorder_ = nullptr;
  int node_ = -1;
  double constant_ = 0;
};

/// Records the right-hand side @p problem as it is at time @p t and state @p x. It is called once. Without
/// branches the tape holds at every time and state; with announced ones, up to the next discontinuity.
/// @param announced has the problem a member discontinuities(t0, t1), so that it may branch on the time?
/// @throws std::invalid_argument if it branches on the state, or on the time without announcement
template <class Problem, int n>
[[nodiscard]] Tape record(const Problem& problem, double t, const Vector<double, n>& x, bool announced) {
  const auto size = static_cast<int>(x.size());
  TapeRecorder recorder(size, announced);
  const Recorded time(recorder, recorder.add_variable(t));
  Vector<Recorded, n> state(size), slope(size);
  for (int i = 0; i < size; ++i) state[i] = Recorded(recorder, recorder.add_variable(x[i]));
  problem(time, state, slope);
  std::vector<tape::Output> outputs;
  for (int i = 0; i < size; ++i) outputs.push_back(slope[i].output());
  return recorder.finish(outputs);
}

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// What Eigen has to know about recorded quantities as entries of vectors.
template <>
struct Eigen::NumTraits<nlmech::Recorded> : nlmech::detail::NumberTraits<nlmech::Recorded, 5, 10, 100> {};
/// @endcond
