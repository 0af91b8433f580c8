/// @file
/// Methods and peers, each with a sweep of steps or tolerances: what is set side by side, and what it costs.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {

/// Which methods belong together in a picture.
enum class Kind {
  source,         ///< the method of the page's source
  own,            ///< what became of it: adaptive collocation, analytic continuation
  closed_form,    ///< no integration at all
  series,         ///< Taylor series
  polynomial,     ///< collocation and Picard iteration, steps by hand
  classical,      ///< the other methods of fixed step, steps by hand
  explicit_,      ///< Runge-Kutta and Nystrom methods with step control
  extrapolation,  ///< explicit, with control of step and order
  adams,          ///< multistep, not for stiff problems
  implicit        ///< step control, for stiff problems
};

/// The kind of a method or peer, where no page has a source of its own.
[[nodiscard]] Kind kind_of(const ivp::MethodInfo& method);

/// One setting of a method.
struct Setting {
  std::string text;        ///< "step 0.5", "tolerance 1e-06"
  ivp::Settings settings;  ///< the same
};

/// One method with its sweep, or a peer that this build lacks: no settings.
struct MethodSweep {
  std::string name;                          ///< of the method or peer: "rbf-coll"
  std::optional<int> nodes;                  ///< of a collocation
  Kind kind;                                 ///< for its colour
  std::vector<Setting> settings;             ///< cheapest first
  std::optional<int> points = std::nullopt;  ///< of mtl

  /// "rbf-coll, N = 35", "mtl, p = 3"
  [[nodiscard]] std::string label() const;
};

/// A sweep of steps: @p factors times @p scale. @param shape c times the step, of radial functions
/// @param quick every other step
[[nodiscard]] MethodSweep by_steps(const std::string& name, std::optional<int> nodes, Kind kind, double scale,
                                   std::span<const double> factors, bool quick, double shape = 0);

/// The sweep of tolerances that all methods with step control share: 1e-4, 1e-5, ..., 1e-13.
/// @param quick 1e-4 and 1e-8 alone
[[nodiscard]] MethodSweep by_tolerances(const std::string& name, Kind kind, bool quick);

/// All peers with that sweep, explicit ones first.
[[nodiscard]] std::vector<MethodSweep> all_peers(bool quick);

/// Ready to run.
[[nodiscard]] ivp::NamedIntegrator integrator(const MethodSweep& sweep, const Setting& setting);

}  // namespace nlmech::comparison
