/// @file
/// Problems on which integrators fail: stiff ones, with what should come out of them.
#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "nlmech/comparison/reference_end.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters {

/// A stiff problem with its solution at the end.
template <int n>
struct Stiff {
  std::string name;       ///< for tables: "van der Pol 1000"
  ivp::System<n> system;  ///< the equations
  ivp::State<n> x0;       ///< state at time 0
  double end;             ///< end time
  double rate;            ///< of the fastest motion: the greatest |lambda| of the Jacobian, near enough
  Vector<long double, n> truth;  ///< state at the end, by Taylor series in extended precision

  /// -log10 of the largest error of a component relative to the largest component; 0 if nothing is right.
  [[nodiscard]] double digits(const ivp::State<n>& found) const {
    const auto error = static_cast<double>(
        (found.template cast<long double>() - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff());
    return std::isfinite(error) ? std::max(0.0, comparison::digits_of(error)) : 0;
  }
};

/// One of them, to be visited.
using AnyStiff = std::variant<Stiff<2>, Stiff<6>>;

/// Duffing with eta = 1e6 over some 27 periods; the three masses with k1 = 1e8 over 2 s; van der Pol with
/// mu = 10, 100 and 1000, each over at least one leap.
/// @param quick without the last one, whose reference alone takes seconds
[[nodiscard]] std::vector<AnyStiff> stiff_problems(bool quick);

}  // namespace nlmech::chapters
