/// @file
/// Stiff problems with reference solutions.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::rbf_ivp {

/// A stiff problem with its reference state at the end.
struct Stiff {
  std::string name;          ///< name in tables, such as "van der Pol 1000"
  ivp::System system;        ///< the equations
  ivp::State x0;             ///< state at time 0
  double end;                ///< final time
  double rate;               ///< approximate largest |lambda| of the Jacobian
  ivp::LongState reference;  ///< state at the end, by Taylor series in extended precision or published
  ivp::LongState size;       ///< scale of the error of each component
  double absolute = 1;       ///< absolute over relative tolerance, below the smallest relevant component
  int halvings = 23;         ///< maximum number of halvings of the interval for fixed-step methods

  /// Largest error of a component over its size; NaN if a component is NaN.
  [[nodiscard]] double error(const ivp::State& found) const {
    return static_cast<double>(((found.template cast<long double>() - reference).array() / size.array())
                                   .abs()
                                   .template maxCoeff<Eigen::PropagateNaN>());
  }
  /// Correct digits: -log10 of the error, at least 0; 0 for non-finite states.
  [[nodiscard]] double digits(const ivp::State& found) const {
    return found.allFinite() ? std::max(0.0, comparison::digits_of(error(found))) : 0;
  }
};

/// Free Duffing with eta = 1e6 over some 27 periods.
[[nodiscard]] Stiff stiff_duffing();
/// The three masses with k1 = 1e8 over 2 s.
[[nodiscard]] Stiff stiff_masses();
/// Van der Pol with mu = 1000 to t = 2000, as in the test set (there t/mu); errors relative to each
/// component.
[[nodiscard]] Stiff van_der_pol_of_the_test_set();
/// Robertson's reactions to 1e11 s; errors relative to each component; reference of the test set.
[[nodiscard]] Stiff robertson();
/// HIRES to 321.8122; errors relative to each component; reference of the test set.
[[nodiscard]] Stiff hires();

/// Duffing, the three masses, van der Pol with mu = 10, 100 and 1000 (each over at least one jump),
/// Robertson, HIRES.
/// @param quick omits van der Pol 1000, whose reference takes seconds
[[nodiscard]] std::vector<Stiff> stiff_problems(bool quick);

}  // namespace nlmech::chapters::rbf_ivp
