/// @file
/// Problems from typed equations, for tests: they are interpreted, not compiled.
#pragma once

#include <string>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::ivp::testing {

/// A problem from its text, such as "x'' = -x - 0.1 x'; y' = x".
inline program::Problem typed_problem(const std::string& equations) {
  return program::Problem(program::Equations(program::SourceText("equation", equations)));
}

/// The system of that problem.
inline System typed(const std::string& equations) { return System(typed_problem(equations)); }

}  // namespace nlmech::ivp::testing
