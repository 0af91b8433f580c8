/// @file
/// Modified Chebyshev-Picard iteration with fixed steps.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// MCPI (Bai & Junkins 2011; Elgohary 2015, Fig. 4.1): the right-hand side at Chebyshev-Gauss-Lobatto nodes
/// of the step is expanded in Chebyshev polynomials up to the degree order - 1, integrated term by term, and
/// this is repeated until the states converge. It needs no Jacobian and no linear solve; the iteration
/// contracts only for short steps (free Duffing oscillator of the dissertation: about half a period).
///
/// Tests assert 1e-12 for Duffing's oscillator at t = 5, with order 14 in steps of 0.5 and order 20 in steps
/// of 1.
struct Mcpi {
  static constexpr std::string_view name = "mcpi";  ///< on command lines and in tables
  double step = 0.1;                                ///< step size, positive
  int order = 8;                                    ///< degree N of the state in time, from 2 to 199
  int intervals = 0;                                ///< M, sample points less one; 0 for M = N
  double tolerance = 1e-13;  ///< converged if no |x_i| changes by more than this times 1 + |x_i|
  int sweeps = 1000;         ///< largest number of sweeps per step
};

/// The matrices of Mcpi, on the unit interval.
struct PicardTables {
  Eigen::VectorXd nodes;     ///< M + 1 times from 0 to 1
  Eigen::MatrixXd integral;  ///< from right-hand sides at all nodes to increments at nodes 2..M+1
  Eigen::VectorXd weights;   ///< barycentric weights for dense output
};

/// @throws std::invalid_argument for options out of range
[[nodiscard]] PicardTables picard_tables(const Mcpi& method);

/// Failure status of a step whose iteration does not converge.
[[nodiscard]] Status picard_failure(Outcome outcome, double t, double step, int sweeps);

/// See integrate().
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Mcpi& method);

}  // namespace nlmech::ivp
