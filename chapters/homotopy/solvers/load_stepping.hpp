/// @file
/// Load stepping: one load after another, each solved from the deflection found under the one before.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// The greatest load, pound.
inline constexpr double stepping_top = 50;

/// Part of a load-deflection curve. A curve without limit points is all `first`.
enum class Branch : std::uint8_t {
  first,    ///< rising, from rest to the maximum
  falling,  ///< between the limit points
  far       ///< rising, behind the minimum
};

/// What was found under one load.
struct LoadPoint {
  double load;        ///< W, pound
  bool found;         ///< did the iteration converge?
  double deflection;  ///< delta where it ended, inch
  double distance;  ///< of delta from the deflection at which the path carries the load, on the same branch,
                    ///< inch; NaN if that branch does not carry it
  Branch branch;    ///< where delta is
};

/// How to step.
struct Stepping {
  Model model = Model::williams;  ///< which equations
  double height = 0.44;           ///< inch
  double step = 1;                ///< of the load, pound; divides `stepping_top`
  Iteration iteration = {.scheme = Scheme::fixed_point, .step = example_step};  ///< but for its start
};

/// Loads up from one step to the top, and down again to one step. After a load whose iteration does not
/// converge the next one starts from the last deflection found.
struct Stepped {
  Stepping how;                     ///< the settings
  std::vector<LoadPoint> up, down;  ///< in the order in which they were computed
};

/// How many of 20 iterations from deflections of 0.25 to 0.45 in, between the limit points of a toggle of
/// 0.44 in, under 34, 36, 38 and 41 lb, converge to the falling branch.
[[nodiscard]] int found_from_the_falling_branch(Model model);
/// Is it Williams' equation?
[[nodiscard]] bool is_williams(const Stepped& steps);
/// Runs it.
[[nodiscard]] Stepped step_loads(const Stepping& how);

/// A change of branch.
struct Jump {
  LoadPoint before, after;  ///< the last point found on a branch, and the next one found
};
/// All changes of branch on the way up or down, loads without a solution left out.
[[nodiscard]] std::vector<Jump> jumps(const Stepped& steps, bool up);
/// Loads whose iteration did not converge.
[[nodiscard]] int unsolved(const std::vector<LoadPoint>& way);
/// Found points on a branch.
[[nodiscard]] int points_on(const std::vector<LoadPoint>& way, Branch branch);
/// The greatest distance of a found point from the path; NaN if one is on no path.
[[nodiscard]] double greatest_distance(const Stepped& steps);
/// How far the load of the jump is past the limit load known from elsewhere, pound; NaN if there is not one
/// jump.
[[nodiscard]] double past_limit(const Stepped& steps, bool up);

/// Draws the found points and the jumps between them.
void draw_steps(scene::Panel& panel, const Stepped& steps);
/// Checks what must be true of them. @param which a name for the checks
void check_steps(const Stepped& steps, const std::string& which, scene::Show& show);

}  // namespace nlmech::chapters::homotopy
