/// @file
/// Problems on which integrators fail: stiff ones, with what should come out of them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::rbf_ivp {

/// A stiff problem with its solution at the end.
struct Stiff {
  std::string name;          ///< for tables: "van der Pol 1000"
  ivp::System system;        ///< the equations
  ivp::State x0;             ///< state at time 0
  double end;                ///< end time
  double rate;               ///< of the fastest motion: the greatest |lambda| of the Jacobian, near enough
  ivp::LongState reference;  ///< state at the end: by Taylor series in extended precision, or published
  ivp::LongState size;       ///< what an error of each component is divided by
  double absolute = 1;       ///< absolute over relative tolerance, below the least component that counts
  int halvings = 23;         ///< of the interval, at most, for methods of fixed step

  /// Largest error of a component by its size; NaN if there is one.
  [[nodiscard]] double error(const ivp::State& found) const {
    return static_cast<double>(((found.template cast<long double>() - reference).array() / size.array())
                                   .abs()
                                   .template maxCoeff<Eigen::PropagateNaN>());
  }
  /// -log10 of the error; 0 if nothing is right.
  [[nodiscard]] double digits(const ivp::State& found) const {
    return found.allFinite() ? std::max(0.0, comparison::digits_of(error(found))) : 0;
  }
};

/// Free Duffing with eta = 1e6 over some 27 periods.
[[nodiscard]] Stiff stiff_duffing();
/// The three masses with k1 = 1e8 over 2 s.
[[nodiscard]] Stiff stiff_masses();
/// Van der Pol with mu = 1000 to t = 2000, as the test set has it (there t/mu), each component by itself.
[[nodiscard]] Stiff van_der_pol_of_the_test_set();
/// Robertson's reactions to 1e11 s, each component by itself; digits of the test set.
[[nodiscard]] Stiff robertson();
/// HIRES to 321.8122, each component by itself; digits of the test set.
[[nodiscard]] Stiff hires();

/// Duffing, the masses, van der Pol with mu = 10, 100 and 1000, each over at least one leap, Robertson,
/// HIRES.
/// @param quick without van der Pol 1000, whose reference alone takes seconds
[[nodiscard]] std::vector<Stiff> stiff_problems(bool quick);

}  // namespace nlmech::chapters::rbf_ivp
