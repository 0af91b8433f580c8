/// @file
/// Random expressions with independent values: a tree that is written as typed text and evaluated in 60
/// digits without the tested code.
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

/// An exact value, and the error bound of double precision.
struct Estimate {
  Real value;   ///< exact to 1e-30
  Real spread;  ///< a multiple of the largest change when each operation has a rounding error
};

/// An expression of t, x and y.
class Tree {
 public:
  /// A random expression of some ten operations.
  explicit Tree(Draw& draw);

  /// `left = expression`, followed by the named parts as definitions.
  [[nodiscard]] std::string text(const std::string& left, const std::string& prefix) const;
  /// The value at (t, x, y); empty near limits of a domain, kinks, and the range of double.
  [[nodiscard]] std::optional<Estimate> value(const std::array<double, 3>& point) const;
  /// The derivative by t, x or y from differences; empty as for value().
  [[nodiscard]] std::optional<Estimate> derivative(const std::array<double, 3>& point, int by) const;

  /// Evaluates in any type of number, with rounding errors for @p run > 0. Sets @p edge where value() is
  /// empty.
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
    std::string digits;          // digits of a number
  };
  int grow(Draw& draw, int depth);
  [[nodiscard]] std::string written(int node, int rank, const std::string& prefix) const;
  [[nodiscard]] std::string written_here(const Node& node, int& rank, const std::string& prefix) const;
  template <class T>
  T jumping(std::size_t node, const T& time, int run, bool& edge) const;
  template <class T>
  T apply(std::size_t node, const std::vector<T>& known, int run, bool& edge) const;

  std::vector<Node> nodes_;  // operands precede their operation; the last node is the root
};

/// Taylor coefficients of the solution of x' = first, y' = second from a point: [component][order].
[[nodiscard]] std::optional<std::array<std::vector<Estimate>, 2>> solution(const std::array<Tree, 2>& trees,
                                                                           const std::array<double, 3>& point,
                                                                           int order);

}  // namespace nlmech::randomised
