/// @file
/// Random expressions with a value of their own: a tree that writes itself as a user would, and is evaluated
/// in 60 digits without the code under test.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/support/extended_real.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised {

/// 60 digits.
using Real = ExtendedReal<60>;

/// A true value, and how far double precision may be from it.
struct Estimate {
  Real value;   ///< exact to 1e-30
  Real spread;  ///< the largest change when each operation is disturbed by a rounding, many times over
};

/// An expression of t, x and y.
class Tree {
 public:
  /// Random, of some ten operations.
  explicit Tree(Draw& draw);

  /// `left = expression`, and the parts that have a name as definitions behind it.
  [[nodiscard]] std::string text(const std::string& left, const std::string& prefix) const;
  /// At (t, x, y); nothing near the edge of a function's definition, a kink, or the range of double.
  [[nodiscard]] std::optional<Estimate> value(const std::array<double, 3>& point) const;
  /// The derivative by t, x or y, by differences.
  [[nodiscard]] std::optional<Estimate> derivative(const std::array<double, 3>& point, int by) const;

  /// On any type of number, disturbed for the run @p run > 0. Sets @p edge where value() gives nothing.
  template <class T>
  T evaluate(const std::array<T, 3>& at, int run, bool& edge) const;

 private:
  struct Node {
    std::string what;            // "+", "sin", "x", "number"; "<": if(c < d, a, b)
    int a = -1, b = -1;          // operands
    int c = -1, d = -1;          // sides of a comparison
    double number = 0;           // an exponent; the other number of mod
    double rate = 0, start = 0;  // floor(rate t + start)
    bool named = false;          // a definition
    bool blank = false;          // a product without its sign
    std::string digits;          // of a number
  };
  int grow(Draw& draw, int depth);
  [[nodiscard]] std::string written(int node, int rank, const std::string& prefix) const;
  [[nodiscard]] std::string written_here(const Node& node, int& rank, const std::string& prefix) const;
  template <class T>
  T jumping(std::size_t node, const T& time, int run, bool& edge) const;
  template <class T>
  T apply(std::size_t node, const std::vector<T>& known, int run, bool& edge) const;

  std::vector<Node> nodes_;  // operands before what they are operands of; the last is the whole
};

/// Taylor coefficients of the solution of x' = first, y' = second from a point on: [component][order].
[[nodiscard]] std::optional<std::array<std::vector<Estimate>, 2>> solution(const std::array<Tree, 2>& trees,
                                                                           const std::array<double, 3>& point,
                                                                           int order);

}  // namespace nlmech::randomised
