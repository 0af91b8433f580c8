/// @file
/// Mazzia and Cash's test set for boundary value problems: parameters, reference values, and solutions by
/// collocation.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/bvp/typed/typed_solve.hpp"

namespace nlmech::chapters::rbf_inverse {

/// A problem of the set with the values of its parameter.
struct TestProblem {
  int number;                     ///< 1 to 35: bvpT1 to bvpT35
  double moderate;                ///< smallest eps of the vignette bvpTests of the R package bvpSolve
  double hard;                    ///< a harder value
  const char* parameter = "eps";  ///< its name
  double easy = 0.1;              ///< value at which zeros, or the guess, are a sufficient start
  const char* guess = "";         ///< see bvp::TypedProblem
  bool is_linear = false;         ///< linear in the unknowns
};

/// All problems, in their order.
[[nodiscard]] std::span<const TestProblem> test_problems();

/// The problem with a value of its parameter.
[[nodiscard]] bvp::TypedProblem typed(const TestProblem& test, double value);

/// Solution from the guess, and where Newton's iteration does not converge from there, followed in the
/// parameter from the easy value.
[[nodiscard]] bvp::Solution solve_test(const TestProblem& test, double value, double tolerance);

/// A value of a solution.
struct ReferenceValue {
  double t;               ///< time
  std::string component;  ///< name
  double number;          ///< value, 14 digits
};

/// Values of `tables/reference/bvp_test_set.csv` for a value of the parameter; none if it is not there.
[[nodiscard]] std::vector<ReferenceValue> references(const TestProblem& test, double value);

/// Largest error at the times of the references, relative to the largest value of each component.
/// @param state components at a time
/// @param sizes largest absolute value of each component
[[nodiscard]] double error_against(std::span<const ReferenceValue> references,
                                   const std::vector<std::string>& names,
                                   const std::function<Eigen::VectorXd(double)>& state,
                                   const Eigen::VectorXd& sizes);

/// error_against() of a solution by collocation.
[[nodiscard]] double error_of(std::span<const ReferenceValue> references, const bvp::TypedProblem& problem,
                              const bvp::Solution& solution);

}  // namespace nlmech::chapters::rbf_inverse
