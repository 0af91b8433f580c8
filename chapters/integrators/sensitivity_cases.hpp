/// @file
/// Problems whose sensitivities are computed in several ways, for the scene `stm-cost` and its benchmark.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/program/equations.hpp"

namespace nlmech::chapters::integrators {

/// A problem of the library with its sensitivities.
struct SensitivityCase {
  /// @param name of the problem @param of names of the initial values and parameters
  /// @param end end time; the start is 0
  /// @param stiff are explicit methods slow? @param absolute absolute over relative tolerance
  SensitivityCase(std::string name, program::Settings settings, std::vector<std::string> of, double end,
                  bool stiff = false, double absolute = 1);

  std::string name;             ///< name of the problem
  program::Settings settings;   ///< values of its parameters
  std::vector<std::string> of;  ///< what the columns are the derivatives by
  bool stiff;                   ///< are explicit methods slow?
  double absolute;              ///< absolute over relative tolerance
  program::Equations plain;     ///< equations without sensitivities
  ivp::System system;           ///< of `plain`
  ivp::System scaled;           ///< with sensitivities that no step-size control sees
  std::vector<double> sizes;    ///< magnitude of what each column is the derivative by
  comparison::Example
      example;  ///< equations with sensitivities; the reference is a Taylor series in long double

  /// Names for method(): nlmech methods, CVODES if this build has it, and "differences".
  [[nodiscard]] std::vector<std::string> methods() const;
  /// A way to compute the state of `example`, which refers to this object. "differences" are central, of runs
  /// of `dop853` or, if stiff, `adaptive-collocation`, with the best of five changes; their observer sees 16
  /// equidistant ends of the last tenth.
  [[nodiscard]] ivp::NamedIntegrator method(const std::string& name, double tolerance) const;
};

/// The problems that are stiff, or the others.
[[nodiscard]] std::vector<SensitivityCase> sensitivity_cases(bool stiff);

}  // namespace nlmech::chapters::integrators
