/// @file
/// The registry: methods by the names that command lines and tables use.
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

/// What a user may set of a method. A step or a tolerance, not both: a step for methods of fixed step, a
/// tolerance for those that choose their steps (nothing: default_tolerance).
struct Settings {
  std::optional<double> step = std::nullopt;       ///< length of a step; positive
  std::optional<double> tolerance = std::nullopt;  ///< relative, and absolute if nothing else is said;
                                                   ///< positive. It holds the error of each step: those of
                                                   ///< all add up, times the problem's condition
  std::optional<double> absolute_tolerance = std::nullopt;  ///< of components that become small; positive;
                                                            ///< nothing: the tolerance. Not for fixed steps
  std::optional<int> nodes = std::nullopt;  ///< N of a collocation, from 2 to 200; nothing: its default
  std::optional<double> shape =
      std::nullopt;  ///< c of rbf-coll in 1/time; positive; nothing: (N - 1) / (4 step)
  std::optional<int> order = std::nullopt;   ///< N of series, from 2 to 100; nothing: by the tolerance, or
                                             ///< published_order if there is a step
  std::optional<int> points = std::nullopt;  ///< p of mtl, from 1 to 8; nothing: 3
};

/// The tolerance of Settings without step and tolerance.
inline constexpr double default_tolerance = 1e-9;
/// The order of series with a step and without Settings::order: what Filipich and Rosales take for most of
/// their examples.
inline constexpr int published_order = 20;

/// A method with its settings: integrates a system from x0 at t0 to t1, as integrate() does. The observer may
/// be empty.
using NamedIntegrator = std::function<Solution(const System&, const State& x0, double t0, double t1,
                                               const Observer&, const Limits&)>;

/// A setting that some methods have and others have not. Command lines, refusals and help are made of it.
struct SettingInfo {
  std::string_view name;  ///< "nodes", on a command line --nodes
  std::variant<std::optional<int> Settings::*, std::optional<double> Settings::*> member;  ///< its place
  int least = 0;             ///< whole numbers: from this
  int most = 0;              ///< to this. Others are positive and finite
  std::string_view meaning;  ///< in a few words

  /// What is set; nothing: not set.
  [[nodiscard]] std::optional<double> value(const Settings& settings) const {
    return std::visit([&](auto m) { return std::optional<double>(settings.*m); }, member);
  }
  /// As if it had not been set.
  void reset(Settings& settings) const {
    std::visit([&](auto m) { (settings.*m).reset(); }, member);
  }
};

/// @cond
inline constexpr SettingInfo nodes_setting{"nodes", &Settings::nodes, 2, 200,
                                           "nodes a step of a collocation"};
inline constexpr SettingInfo shape_setting{.name = "shape",
                                           .member = &Settings::shape,
                                           .meaning = "c of rbf-coll, 1/time; (N - 1)/(4 step) without it"};
inline constexpr SettingInfo order_setting{"order", &Settings::order, 2, 100,
                                           "N of series; by the tolerance without it, 20 with a step"};
inline constexpr SettingInfo points_setting{"points", &Settings::points, 1, 8,
                                            "p of mtl, steps solved at once; 3 without it"};
/// @endcond

/// All of them, in the order of the help.
inline constexpr std::array own_settings = {&nodes_setting, &shape_setting, &order_setting, &points_setting};

/// Where a method's steps come from.
enum class Steps {
  fixed,     ///< equal ones, from the user
  adaptive,  ///< the method's, by the tolerance
  both       ///< the method's, or equal ones from the user
};

/// What kind of formula a method has.
enum class Family {
  classical,      ///< formulas of a step that the user gives
  polynomials,    ///< collocation and Picard iteration over such a step
  collocation,    ///< with step control
  series,         ///< Taylor series
  runge_kutta,    ///< explicit, one step, with step control; Nystroem's too
  extrapolation,  ///< explicit, with control of step and order
  adams,          ///< several steps, not for stiff problems
  implicit  ///< with step control; equations are solved in each step, so that stiff problems do not slow
            ///< it down
};

/// One row of the registry of methods, ours and peers: what there is to know of a method, and how it is made.
struct MethodInfo {
  std::string_view name;                            ///< "rk4"
  std::string_view meaning;                         ///< in a few words; of a peer its library
  Family family = Family::classical;                ///< kind of formula
  Steps steps = Steps::fixed;                       ///< where they come from
  NamedIntegrator (*make)(const Settings&) = {};    ///< of checked settings; see with()
  std::array<const SettingInfo*, 2> settings = {};  ///< that it has; the rest is null
  bool second_order_only = false;                   ///< for problems with accelerations alone
  bool estimate_misses_time = false;                ///< its error estimate compares f at equal times alone:
                                                    ///< 0 where f depends on t alone, too small where on both
  bool (*is_built)() noexcept = {};                 ///< of a peer: does this build have it? Ours have none

  /// Is it another author's?
  [[nodiscard]] bool is_peer() const { return is_built != nullptr; }
  /// Does this build have it?
  [[nodiscard]] bool is_available() const { return !is_peer() || is_built(); }
  /// "cvode-bdf is not in this build: configure with CVODE (NLMECH_PEERS)"
  [[nodiscard]] std::string absent_sentence() const;
  /// Does it take a step, and choose none by itself?
  [[nodiscard]] bool fixed_step() const { return steps == Steps::fixed; }
  /// Does the setting count?
  [[nodiscard]] bool has(const SettingInfo& setting) const {
    return settings[0] == &setting || settings[1] == &setting;
  }
  /// Ready to run. Tolerances of inner iterations stay as they are.
  /// @throws std::invalid_argument for settings that the method does not have, that it lacks or that are out
  /// of range, naming them; for a peer that this build lacks
  [[nodiscard]] NamedIntegrator with(const Settings& chosen) const;
};

/// All methods of ours, simple ones first.
[[nodiscard]] std::span<const MethodInfo> named_methods();

/// The method of that name. @throws std::invalid_argument listing the known names
[[nodiscard]] const MethodInfo& method_info(std::string_view name);

/// The method @p name: method_info(name).with(settings). For mcpi the N nodes are those of the
/// polynomial of degree N - 1. rbf-coll whose shape follows the step (no Settings::shape) does not converge
/// for a vanishing step: it goes through the right states in a time that is wrong by a fixed share.
/// @throws std::invalid_argument listing the known names, if there is none of that name; and as with()
[[nodiscard]] NamedIntegrator named_integrator(std::string_view name, const Settings& settings);

}  // namespace nlmech::ivp
