/// @file
/// Equations of tests as one types them: no compiler works on them.
#pragma once

#include <string>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::ivp::testing {

/// A problem as "x'' = -x - 0.1 x'; y' = x".
inline program::Problem typed_problem(const std::string& equations) {
  return program::Problem(program::Equations(program::SourceText("equation", equations)));
}

/// Its system.
inline System typed(const std::string& equations) { return System(typed_problem(equations)); }

}  // namespace nlmech::ivp::testing
