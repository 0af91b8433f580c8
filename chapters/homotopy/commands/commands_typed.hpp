/// @file
/// Options of the commands for typed equations F(x) = 0, and the solvers that they know.
#pragma once

#include <string>
#include <vector>

#include "nlmech/algebraic/typed/solve_typed.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::homotopy {

/// Equations as typed, and where to start.
struct TypedRoots {
  std::string equation, file, start, bounds;
  std::vector<std::string> set;
  double tolerance = 1e-10;
  int iterations = 1000;
};

/// Declares --equation, --file, --set, --start, --bounds, --tolerance and --iterations.
void declare_roots(scene::Options& options, TypedRoots& typed);

/// The equations. @param unknowns further names that are unknowns @param parameter name that varies, or empty
/// @throws InputError
[[nodiscard]] algebraic::TypedSystem system_of(const TypedRoots& typed, std::set<std::string> unknowns = {},
                                               const std::string& parameter = {});

/// The named solvers; for no name the library's solvers that apply, then kinsol and gsl-hybrid if the build
/// has them. @throws InputError naming @p option for a name that is none of these
[[nodiscard]] std::vector<algebraic::TypedSolver> solvers_of(const algebraic::TypedSystem& system,
                                                             const std::string& option = {},
                                                             const std::vector<std::string>& names = {});

/// Names in a box "x=-5:5, y=0:2"; none in an empty text. @throws InputError
[[nodiscard]] std::set<std::string> names_in_box(const std::string& box);

/// The box. @throws InputError naming --box unless it has a range for each unknown, and no other
[[nodiscard]] algebraic::Box box_of(const algebraic::TypedSystem& system, const std::string& box);

/// "x,y,": names as columns of CSV, each before a comma.
[[nodiscard]] std::string columns_of(const algebraic::TypedSystem& system);

}  // namespace nlmech::chapters::homotopy
