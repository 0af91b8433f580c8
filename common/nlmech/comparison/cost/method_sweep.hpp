/// @file
/// Methods and peers of a work-precision diagram, each with a sweep of step sizes or tolerances.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {

/// Groups of methods in a figure.
enum class Kind {
  source,         ///< the method of the reproduced source
  own,            ///< nlmech methods derived from it: adaptive collocation, analytic continuation
  closed_form,    ///< closed form without integration
  series,         ///< Taylor series
  polynomial,     ///< collocation and Picard iteration with fixed steps
  classical,      ///< other methods with fixed steps
  explicit_,      ///< Runge-Kutta and Nystroem methods with step-size control
  extrapolation,  ///< explicit extrapolation with control of step size and order
  adams,          ///< multistep methods for non-stiff problems
  implicit        ///< methods with step-size control for stiff problems
};

/// The kind of a method or peer by its family.
[[nodiscard]] Kind kind_of(const ivp::MethodInfo& method);

/// One setting of a method.
struct Setting {
  std::string text;        ///< label: "step 0.5", "tolerance 1e-06"
  ivp::Settings settings;  ///< the settings themselves
};

/// One method with its sweep; no settings for a peer that this build lacks.
struct MethodSweep {
  std::string name;                          ///< name of the method or peer: "rbf-coll"
  std::optional<int> nodes;                  ///< nodes of a collocation
  Kind kind;                                 ///< kind, which determines the colour
  std::vector<Setting> settings;             ///< cheapest first
  std::optional<int> points = std::nullopt;  ///< points of `mtl`

  /// "rbf-coll, N = 35", "mtl, p = 3"
  [[nodiscard]] std::string label() const;
};

/// A sweep of step sizes @p factors times @p scale. @param shape shape parameter of radial functions times
/// the step size; 0: none
/// @param quick every other step size
[[nodiscard]] MethodSweep by_steps(const std::string& name, std::optional<int> nodes, Kind kind, double scale,
                                   std::span<const double> factors, bool quick, double shape = 0);

/// The common sweep of tolerances of methods with step-size control: 1e-4, 1e-5, ..., 1e-13.
/// @param quick only 1e-4 and 1e-8
[[nodiscard]] MethodSweep by_tolerances(const std::string& name, Kind kind, bool quick);

/// All peers with the sweep of by_tolerances(), explicit ones first.
[[nodiscard]] std::vector<MethodSweep> all_peers(bool quick);

/// Integrator of one setting of a sweep.
[[nodiscard]] ivp::NamedIntegrator integrator(const MethodSweep& sweep, const Setting& setting);

}  // namespace nlmech::comparison
