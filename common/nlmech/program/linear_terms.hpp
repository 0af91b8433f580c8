/// @file
/// What of the slopes is linear with constant coefficients, and which loads are harmonic: read off the graph.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nlmech/program/graph.hpp"

namespace nlmech {

/// One harmonic of a load: it adds cosine cos(frequency t) + sine sin(frequency t) to one component of dx/dt.
/// Frequency 0 is a constant load, `cosine`.
struct Harmonic {
  int component = 0;     ///< of the state, from 0
  double frequency = 0;  ///< rad/time, finite
  double cosine = 0;     ///< amplitude of the cosine
  double sine = 0;       ///< amplitude of the sine
};

namespace program {

/// The terms A x + load(t) of dx/dt = A x + load(t) + g(t, x), as a transversal linearisation solves them
/// exactly (Viswanath and Roy, Multi-step transversal linearization methods, 2007).
struct LinearTerms {
  Eigen::MatrixXd a;           ///< constant
  std::vector<Harmonic> load;  ///< of all components, by frequency within each
};

/// Those of @p slopes, one a component of the state. Sums, multiples and products are multiplied out, so that
/// mu (1 - x^2) y has the linear term mu y; all other operations belong to g, but for sine and cosine of a
/// frequency times the time. A term that is not finite is left to g.
[[nodiscard]] LinearTerms linear_terms(const Graph& graph, const std::vector<NodeId>& slopes);

}  // namespace program
}  // namespace nlmech
