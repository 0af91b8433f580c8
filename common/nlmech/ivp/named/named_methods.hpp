/// @file
/// Registry of methods by the names that command lines and tables use.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// Settings of a method by a user: a step size for methods with fixed steps, or a tolerance for methods with
/// adaptive steps (default: default_tolerance), not both.
struct Settings {
  std::optional<double> step = std::nullopt;       ///< step size; positive
  std::optional<double> tolerance = std::nullopt;  ///< relative, and absolute by default; positive. Bounds
                                                   ///< the error of each step; the errors accumulate, times
                                                   ///< the condition number of the problem
  std::optional<double> absolute_tolerance = std::nullopt;  ///< for components near 0; positive; default:
                                                            ///< `tolerance`. Not for fixed steps
  std::optional<int> nodes = std::nullopt;  ///< N of a collocation, from 2 to 200; default: by the method
  std::optional<double> shape =
      std::nullopt;  ///< c of rbf-coll in 1/time; positive; default: (N - 1) / (4 step)
  std::optional<int> order = std::nullopt;   ///< N of series, from 2 to 100; default: by the tolerance, or
                                             ///< published_order with a step
  std::optional<int> points = std::nullopt;  ///< p of mtl, from 1 to 8; default: 3
};

/// The tolerance of Settings without step and tolerance.
inline constexpr double default_tolerance = 1e-9;
/// The order of series with a step and without Settings::order: that of most examples of Filipich and
/// Rosales.
inline constexpr int published_order = 20;

/// A method with its settings. Integrates a system from (t0, x0) to t1, as integrate() does; the observer may
/// be empty.
using NamedIntegrator = std::function<Solution(const System&, const State& x0, double t0, double t1,
                                               const Observer&, const Limits&)>;

/// A setting that only some methods have; the source of command line options, error messages and help.
struct SettingInfo {
  std::string_view name;  ///< "nodes", on the command line --nodes
  std::variant<std::optional<int> Settings::*, std::optional<double> Settings::*>
      member;                ///< member of Settings
  int least = 0;             ///< integers: smallest value
  int most = 0;              ///< integers: largest value; real numbers are positive and finite
  std::string_view meaning;  ///< description for the help

  /// The value; none if it is not set.
  [[nodiscard]] std::optional<double> value(const Settings& settings) const {
    return std::visit([&](auto m) { return std::optional<double>(settings.*m); }, member);
  }
  /// Resets the setting to its default.
  void reset(Settings& settings) const {
    std::visit([&](auto m) { (settings.*m).reset(); }, member);
  }
};

/// @cond
inline constexpr SettingInfo nodes_setting{"nodes", &Settings::nodes, 2, 200,
                                           "nodes per step of collocation"};
inline constexpr SettingInfo shape_setting{
    .name = "shape",
    .member = &Settings::shape,
    .meaning = "shape parameter c of rbf-coll, 1/time (default (N - 1)/(4 step))"};
inline constexpr SettingInfo order_setting{"order", &Settings::order, 2, 100,
                                           "order N of series (default by the tolerance; 20 with --step)"};
inline constexpr SettingInfo points_setting{"points", &Settings::points, 1, 8,
                                            "steps p of mtl solved together (default 3)"};
/// @endcond

/// All such settings, in the order of the help.
inline constexpr std::array own_settings = {&nodes_setting, &shape_setting, &order_setting, &points_setting};

/// Step sizes of a method.
enum class Steps {
  fixed,     ///< fixed, from the user
  adaptive,  ///< adaptive, by the tolerance
  both       ///< adaptive, or fixed from the user
};

/// Kind of a method.
enum class Family {
  classical,      ///< fixed steps from the user
  polynomials,    ///< collocation and Picard iteration with fixed steps
  collocation,    ///< collocation with step-size control
  series,         ///< Taylor series
  runge_kutta,    ///< explicit one-step, with step-size control; also Nystroem
  extrapolation,  ///< explicit, with control of step size and order
  adams,          ///< multistep, for nonstiff problems
  implicit        ///< with step-size control; solves equations in each step, for stiff problems
};

/// One row of the registry, for an nlmech method or a peer: properties of the method, and its constructor.
struct MethodInfo {
  std::string_view name;                          ///< "rk4"
  std::string_view meaning;                       ///< description for the help; for a peer its library
  Family family = Family::classical;              ///< kind of the method
  Steps steps = Steps::fixed;                     ///< fixed or adaptive
  NamedIntegrator (*make)(const Settings&) = {};  ///< makes the integrator from checked settings; see with()
  std::array<const SettingInfo*, 2> settings = {};  ///< its settings; the rest is null
  bool second_order_only = false;                   ///< requires a problem with accelerations
  bool estimate_misses_time = false;  ///< the error estimate compares f at equal times only: 0 if f depends
                                      ///< on t only, too small if f depends on t and x
  bool (*is_built)() noexcept = {};   ///< for a peer: is it in this build? Null for nlmech methods

  /// Is it a method of another library?
  [[nodiscard]] bool is_peer() const { return is_built != nullptr; }
  /// Is it in this build?
  [[nodiscard]] bool is_available() const { return !is_peer() || is_built(); }
  /// "cvode-bdf is not in this build: configure with CVODE (NLMECH_PEERS)"
  [[nodiscard]] std::string absent_sentence() const;
  /// Are its steps always fixed?
  [[nodiscard]] bool fixed_step() const { return steps == Steps::fixed; }
  /// Does the method have the setting?
  [[nodiscard]] bool has(const SettingInfo& setting) const {
    return settings[0] == &setting || settings[1] == &setting;
  }
  /// The integrator with these settings. Tolerances of inner iterations keep their defaults.
  /// @throws std::invalid_argument for settings that the method does not have, that are missing or out of
  /// range, with their names; for a peer that is not in this build
  [[nodiscard]] NamedIntegrator with(const Settings& chosen) const;
};

/// All nlmech methods, simple ones first.
[[nodiscard]] std::span<const MethodInfo> named_methods();

/// The method with the name @p name. @throws std::invalid_argument with the known names
[[nodiscard]] const MethodInfo& method_info(std::string_view name);

/// The method @p name: method_info(name).with(settings). For mcpi N nodes give the polynomial of degree N -
/// 1. rbf-coll without Settings::shape does not converge for a vanishing step size: it passes through the
/// right states at times that are wrong by a fixed ratio.
/// @throws std::invalid_argument with the known names for an unknown one; and as with()
[[nodiscard]] NamedIntegrator named_integrator(std::string_view name, const Settings& settings);

}  // namespace nlmech::ivp
