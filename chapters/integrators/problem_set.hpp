/// @file
/// The problem set: initial value problems with references of known accuracy and their condition.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "chapters/integrators/problem_list.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::integrators {

/// A problem with its reference.
struct SetProblem {
  std::string name;                            ///< in tables: "kepler-0.99"
  Kind kind;                                   ///< what makes it hard
  double absolute;                             ///< absolute over relative tolerance
  std::int64_t length;                         ///< how many times as many steps it takes as the others
  ivp::System system;                          ///< the equations
  ivp::State x0;                               ///< state at t0
  double t0;                                   ///< begin
  double t1;                                   ///< end
  std::vector<double> times;                   ///< at which errors are judged; the last is t1
  std::vector<ivp::LongState> reference = {};  ///< there; empty: no solution reaches the end
  ivp::State flagged = {};  ///< what errors of components near zero are divided by; 0: by the component
  double condition = 1;     ///< greatest factor from relative errors at earlier times to that at the end
  double tolerance_condition = 1;  ///< the same from errors of one tolerance, absolute + |x|

  /// Does the solution reach the end?
  [[nodiscard]] bool has_solution() const { return !reference.empty(); }
  /// The greatest error of a component of @p x at the time number @p k: relative to the component, or, where
  /// it is near zero, absolute in the unit of its size. NaN if @p x has one.
  [[nodiscard]] double error(const ivp::State& x, std::size_t k) const {
    double worst = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const long double scale =
          flagged[i] > 0 ? static_cast<long double>(flagged[i]) : std::abs(reference[k][i]);
      const auto error = static_cast<double>(std::abs(x[i] - reference[k][i]) / scale);
      if (std::isnan(error)) return error;
      worst = std::max(worst, error);
    }
    return worst;
  }
};

/// All of them with what tables/reference/problem_set.csv and problem_set_conditions.csv say.
/// @throws Failure naming the file, if one is not there or does not fit the problems
[[nodiscard]] std::vector<SetProblem> problem_set();

/// Their names, in that order. Reads no file.
/// @param solved those alone whose solution reaches the end
[[nodiscard]] std::vector<std::string> problem_names(bool solved = false);

}  // namespace nlmech::chapters::integrators
