/// @file
/// Problems whose sensitivities are computed in several ways, for the scene `stm-cost` and its benchmark.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/equations.hpp"

namespace nlmech::chapters::integrators {

/// A way to compute sensitivities: its run to a time gives the extended state, or nothing if it fails. Made
/// for a tolerance, which is relative and absolute.
struct SensitivityMethod {
  /// Runs to a time.
  using Run = std::function<std::optional<ivp::State>(double t1)>;
  std::string name;                           ///< "series", "cvodes-bdf", "differences"
  std::function<Run(double tolerance)> make;  ///< prepares a run, which is timed without the preparation
};

/// Typed equations with their sensitivities.
struct SensitivityCase {
  /// @param name of a problem of the library, and in tables
  /// @param of names of the initial values and parameters
  /// @param end end time
  SensitivityCase(std::string name, std::vector<std::string> of, double end);

  std::string name;                    ///< name of the problem
  std::vector<std::string> of;         ///< what the columns are the derivatives by
  double end;                          ///< end time; the start is 0
  program::Equations equations;        ///< without sensitivities
  program::Equations extended;         ///< with sensitivities
  ivp::System system;                  ///< of `equations`
  ivp::System all;                     ///< of `extended`
  ivp::State x0;                       ///< initial state of `extended`
  std::vector<double> sizes;           ///< magnitude of what each column is the derivative by
  std::vector<ivp::State> exact = {};  ///< extended states at time(k)

  /// Number of times at which a run is judged.
  static constexpr int times = 16;
  /// Judged time @p k: equidistant in the last tenth.
  [[nodiscard]] double time(int k) const { return end * (1 - 0.1 * (times - 1 - k) / (times - 1)); }
  /// The largest error of a column at time(k), in the column's maximum norm and relative to it.
  [[nodiscard]] double error(const ivp::State& x, int k) const;
  /// Median of error() of runs to all judged times; nothing if one fails.
  [[nodiscard]] std::optional<double> error(const SensitivityMethod::Run& run) const;
  /// nlmech methods, CVODES, and central differences of runs of `dop853`. They refer to this case.
  [[nodiscard]] std::vector<SensitivityMethod> methods() const;
};

/// The problems. Their references are Taylor series of the variational equations in long double.
[[nodiscard]] std::vector<SensitivityCase> sensitivity_cases();

}  // namespace nlmech::chapters::integrators
