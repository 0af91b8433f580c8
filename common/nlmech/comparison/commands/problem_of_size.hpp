/// @file
/// What methods make of a problem of one size: everything but the equations themselves, compiled once a size.
#pragma once

#include <span>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// A problem as a System of the size @p m, one of those for which methods are compiled.
class ProblemOfSize : public OwnProblem {
 public:
  /// The equations, with the parameters as set.
  [[nodiscard]] virtual ivp::System system() const = 0;
  /// Computations in extended precision, for references; may be none.
  [[nodiscard]] virtual std::vector<Candidate> extended(const Effort& effort) const = 0;

  /// See OwnProblem.
  [[nodiscard]] std::string usual_method(const Request& request) const override;
  /// See OwnProblem.
  [[nodiscard]] Chosen chosen(const Request& request, double digits) const override;
  /// See OwnProblem.
  [[nodiscard]] std::vector<std::string> usual_methods(const Request& request) const override;
  /// See OwnProblem.
  [[nodiscard]] Trajectory trajectory(const Request& request, const ivp::MethodInfo& method) const override;
  /// See OwnProblem.
  [[nodiscard]] std::vector<Ended> trajectories(std::span<const Posed> posed, const ivp::MethodInfo& method,
                                                int threads) const override;
  /// See OwnProblem.
  [[nodiscard]] Comparison comparison(const Request& request, const std::vector<Choice>& methods,
                                      std::string_view program) const override;

 private:
  class Run;
  [[nodiscard]] Reference reference(const ivp::State& x0, double t0, const std::vector<double>& times,
                                    const Needed& needed, const Effort& effort) const;
};

}  // namespace nlmech::comparison
