/// @file
/// The problem set: initial value problems with references of known accuracy and condition numbers.
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
  std::string name;                            ///< in tables, such as "kepler-0.99"
  Kind kind;                                   ///< kind of difficulty
  double absolute;                             ///< absolute over relative tolerance
  std::int64_t length;                         ///< number of steps relative to other problems
  ivp::System system;                          ///< the equations
  ivp::State x0;                               ///< state at t0
  double t0;                                   ///< initial time
  double t1;                                   ///< final time
  std::vector<double> times;                   ///< judged times; the last is t1
  std::vector<ivp::LongState> reference = {};  ///< states at `times`; empty: no solution reaches t1
  ivp::State flagged = {};         ///< scale of the error of components near zero; 0: relative error
  double condition = 1;            ///< largest amplification of a relative error at an earlier time until t1
  double tolerance_condition = 1;  ///< the same for an error of one tolerance, absolute + |x|

  /// Does the solution reach t1?
  [[nodiscard]] bool has_solution() const { return !reference.empty(); }
  /// The largest error of a component of @p x at times[k], divided by flagged[i] if positive, else by the
  /// reference component. NaN if a component is NaN.
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

/// All problems, with data from tables/reference/problem_set.csv and problem_set_conditions.csv.
/// @throws Failure naming a file that is missing or does not fit the problems
[[nodiscard]] std::vector<SetProblem> problem_set();

/// Names of the problems in the order of problem_set(). Reads no file.
/// @param solved only problems whose solution reaches t1
[[nodiscard]] std::vector<std::string> problem_names(bool solved = false);

}  // namespace nlmech::chapters::integrators
