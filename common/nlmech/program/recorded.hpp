/// @file
/// A scalar that records operations: one call of a right-hand side with it gives a graph.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/number_traits.hpp"
#include "nlmech/program/tape.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::program {

/// Graph of a right-hand side during the recording at one time.
class Recorder {
 public:
  /// @param size components of the state
  /// @param t time of the recording, for branches on the time
  /// @param announced may the right-hand side branch on the time?
  Recorder(int size, double t, bool announced) : graph_(size), t_(t), announced_(announced) {}

  /// The graph recorded so far.
  [[nodiscard]] Graph& graph() { return graph_; }
  /// The value of a node, for a branch. @throws std::invalid_argument unless it depends on time only and the
  /// problem gives its discontinuities
  [[nodiscard]] double branch_value(NodeId node) const;

 private:
  Graph graph_;
  double t_;
  bool announced_;
};

/// A node of a recorder, or a constant: the scalar for recording a right-hand side. It has no order (<, >);
/// value_of(), for branches, throws unless the problem gives its discontinuities.
class Recorded {
 public:
  /// The constant 0.
  Recorded() = default;
  /// A constant.
  template <class S>
  requires std::convertible_to<S, double> Recorded(const S& constant)
      : constant_(static_cast<double>(constant)) {}
  /// A node of @p recorder, which outlives the quantity.
  Recorded(Recorder& recorder, NodeId node) : recorder_(&recorder), node_(node) {}

  /// The node; for a constant the node of the number.
  [[nodiscard]] NodeId node(Graph& graph) const {
    return recorder_ == nullptr ? graph.number(constant_) : node_;
  }

  /// The same quantity.
  Recorded operator+() const { return *this; }
  /// Its negative.
  Recorded operator-() const { return -1 * *this; }
  /// Sum.
  friend Recorded operator+(const Recorded& a, const Recorded& b) { return made(&Graph::sum, a, b); }
  /// Difference.
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return made(&Graph::difference, a, b); }
  /// Product.
  friend Recorded operator*(const Recorded& a, const Recorded& b) { return made(&Graph::product, a, b); }
  /// Quotient.
  friend Recorded operator/(const Recorded& a, const Recorded& b) { return made(&Graph::quotient, a, b); }
  /// Adds a quantity.
  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  /// Subtracts a quantity.
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  /// Multiplies by a quantity.
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  /// Divides by a quantity.
  Recorded& operator/=(const Recorded& b) { return *this = *this / b; }

  /// Square root.
  friend Recorded sqrt(const Recorded& a) { return call(Function::sqrt, a); }
  /// Exponential function.
  friend Recorded exp(const Recorded& a) { return call(Function::exp, a); }
  /// Natural logarithm.
  friend Recorded log(const Recorded& a) { return call(Function::log, a); }
  /// Sine.
  friend Recorded sin(const Recorded& a) { return call(Function::sin, a); }
  /// Cosine.
  friend Recorded cos(const Recorded& a) { return call(Function::cos, a); }
  /// Tangent.
  friend Recorded tan(const Recorded& a) { return call(Function::tan, a); }
  /// Hyperbolic sine.
  friend Recorded sinh(const Recorded& a) { return call(Function::sinh, a); }
  /// Hyperbolic cosine.
  friend Recorded cosh(const Recorded& a) { return call(Function::cosh, a); }
  /// Hyperbolic tangent.
  friend Recorded tanh(const Recorded& a) { return call(Function::tanh, a); }
  /// Arc sine.
  friend Recorded asin(const Recorded& a) { return call(Function::asin, a); }
  /// Arc cosine.
  friend Recorded acos(const Recorded& a) { return call(Function::acos, a); }
  /// Arc tangent.
  friend Recorded atan(const Recorded& a) { return call(Function::atan, a); }
  /// Inverse of sinh.
  friend Recorded asinh(const Recorded& a) { return call(Function::asinh, a); }
  /// Error function.
  friend Recorded erf(const Recorded& a) { return call(Function::erf, a); }
  /// Angle of the point (x, y).
  friend Recorded atan2(const Recorded& y, const Recorded& x) { return call(Function::atan2, y, x); }
  /// x^y: by products if y is an integer of at most 1024; otherwise x > 0.
  friend Recorded pow(const Recorded& x, const Recorded& y) { return made(&Graph::power, x, y); }
  /// Absolute value: a branch, see value_of().
  friend Recorded abs(const Recorded& a) { return value_of(a) < 0 ? -a : a; }
  /// The value, for a branch. @throws std::invalid_argument unless it depends on time only and the problem
  /// gives its discontinuities
  friend double value_of(const Recorded& a) {
    return a.recorder_ == nullptr ? a.constant_ : a.recorder_->branch_value(a.node_);
  }

 private:
  static Recorded made(NodeId (Graph::*operation)(NodeId, NodeId), const Recorded& a, const Recorded& b);
  static Recorded call(Function function, const Recorded& a) { return call(function, a, a); }
  static Recorded call(Function function, const Recorded& a, const Recorded& b);
  template <class Note>
  static Recorded noted(Note note, const Recorded& a, const Recorded& b);

  Recorder* recorder_ = nullptr;
  NodeId node_ = 0;
  double constant_ = 0;
};

/// A recorded right-hand side.
struct Recording {
  Graph graph;                 ///< all its operations
  std::vector<NodeId> slopes;  ///< one per component of the state

  /// The tape of the right-hand side.
  [[nodiscard]] Tape tape() const { return {graph, slopes}; }
};

/// Records the right-hand side @p problem for @p size components by one call at time @p t. Without branches
/// the graph is valid at every time and state; with branches on the time, up to the next discontinuity.
/// @param announced has the problem a member discontinuities(t0, t1), so that it may branch on the time?
/// @throws std::invalid_argument if it branches on the state, or on the time without @p announced
template <class Problem, int n = Problem::dimension>
[[nodiscard]] Recording record(const Problem& problem, double t, int size, bool announced) {
  Recorder recorder(size, t, announced);
  Vector<Recorded, n> state(size), slope(size);
  for (int i = 0; i < size; ++i) state[i] = Recorded(recorder, Graph::state(i));
  problem(Recorded(recorder, Graph::time()), state, slope);
  std::vector<NodeId> slopes;
  for (int i = 0; i < size; ++i) slopes.push_back(slope[i].node(recorder.graph()));
  return {std::move(recorder.graph()), std::move(slopes)};
}

}  // namespace nlmech::program

/// @cond Doxygen cannot follow specialisations of another library's templates
// Traits of recorded quantities as entries of Eigen vectors.
template <>
struct Eigen::NumTraits<nlmech::program::Recorded>
    : nlmech::detail::NumberTraits<nlmech::program::Recorded, 5, 10, 100> {};
/// @endcond
