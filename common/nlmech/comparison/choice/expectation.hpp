/// @file
/// What is to be expected of a method on a problem that nobody has solved, from problems that are like it.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/choice/evidence.hpp"
#include "nlmech/ivp/solution.hpp"

namespace nlmech::comparison {

/// How unlike two problems are: 0 the same, 1 a decade of stiffness, say, apart. The scales are of the
/// features alone and know no method.
[[nodiscard]] double distance(const Features& a, const Features& b);

/// What to expect of a method.
struct Expectation {
  std::string method;       ///< its name
  double behind = 0;        ///< log10 of its time over that of the fastest, on problems that are like it
  double tolerance = 1e-9;  ///< that gives the accuracy that is asked for
  double short_of = 0;      ///< digits by which its tightest tolerance falls short of that; 0: none
  double cost = 1;          ///< of one right-hand side with all that comes with it, in units of Measured
  double step = 1;          ///< cost of a step, in the same units

  /// Limits of a run that come to a cost, and to two seconds where right-hand sides are expensive.
  /// @param largest_step the bound on its steps
  [[nodiscard]] ivp::Limits limits(double most_cost, double largest_step) const;
};

/// Is the method made for such equations?
[[nodiscard]] bool suits(const std::string& method, const Features& features);

/// Of all methods that suit, the least behind first; of equals ours first.
/// @param level digits to hold on the way: those wanted at the end and the logarithm of the problem's
/// condition
[[nodiscard]] std::vector<Expectation> expectations(const Evidence& evidence, const Features& features,
                                                    double level);

/// The names of the problems that count most, at most @p count.
[[nodiscard]] std::vector<std::string> most_alike(const Evidence& evidence, const Features& features,
                                                  std::size_t count);

inline constexpr double loosest_measured = 1e-3;    ///< first tolerance of the evidence
inline constexpr double tightest_measured = 1e-13;  ///< last tolerance of the evidence

}  // namespace nlmech::comparison
