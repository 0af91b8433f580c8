/// @file
/// Load stepping: a sequence of loads, each solved from the deflection found under the previous one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// Largest load of the sequence, pound.
inline constexpr double stepping_top = 50;

/// Branch of a load-deflection curve. A curve without limit points is `first` throughout.
enum class Branch : std::uint8_t {
  first,    ///< rising, from rest to the maximum
  falling,  ///< between the limit points
  far       ///< rising, beyond the minimum
};

/// Result under one load.
struct LoadPoint {
  double load;        ///< W, pound
  bool found;         ///< did the iteration converge?
  double deflection;  ///< delta of the last iterate, inch
  double distance;  ///< |delta - deflection under the load on the same branch|, inch; NaN if the branch does
                    ///< not carry the load
  Branch branch;    ///< branch of delta
};

/// Settings of load stepping.
struct Stepping {
  Model model = Model::williams;  ///< equations
  double height = 0.44;           ///< inch
  double step = 1;                ///< load increment, pound; divides `stepping_top`
  Iteration iteration = {.scheme = Scheme::fixed_point, .step = example_step};  ///< its start is not used
};

/// Result of load stepping: from one increment up to `stepping_top` and down again. If the iteration does not
/// converge under a load, the next load starts from the last deflection found.
struct Stepped {
  Stepping how;                     ///< the settings
  std::vector<LoadPoint> up, down;  ///< loading and unloading, in the order of computation
};

/// Number of iterations, of 20, that converge to the falling branch of a toggle of 0.44 in. They start at
/// deflections from 0.25 to 0.45 in, between the limit points, under 34, 36, 38 and 41 lb.
[[nodiscard]] int found_from_the_falling_branch(Model model);
/// Is the model Williams' equation?
[[nodiscard]] bool is_williams(const Stepped& steps);
/// Runs load stepping.
[[nodiscard]] Stepped step_loads(const Stepping& how);

/// A jump between branches.
struct Jump {
  LoadPoint before, after;  ///< successive found points on different branches
};
/// All jumps during loading (@p up) or unloading; loads without a solution are skipped.
[[nodiscard]] std::vector<Jump> jumps(const Stepped& steps, bool up);
/// Number of loads whose iteration did not converge.
[[nodiscard]] int unsolved(const std::vector<LoadPoint>& way);
/// Number of found points on a branch.
[[nodiscard]] int points_on(const std::vector<LoadPoint>& way, Branch branch);
/// Largest distance of a found point from the equilibrium path, inch; NaN if a branch does not carry its
/// load.
[[nodiscard]] double greatest_distance(const Stepped& steps);
/// Load of the jump beyond the reference limit load, pound; NaN unless there is exactly one jump.
[[nodiscard]] double past_limit(const Stepped& steps, bool up);

/// Draws the found points and the jumps between them.
void draw_steps(scene::Panel& panel, const Stepped& steps);
/// Checks the results of load stepping. @param which name of the model in the checks
void check_steps(const Stepped& steps, const std::string& which, scene::Show& show);

}  // namespace nlmech::chapters::homotopy
