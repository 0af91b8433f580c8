/// @file
/// OwnProblem for a problem of the library. Included where own_problem<Problem>() is instantiated, once a
/// problem.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/commands/problem_of_size.hpp"
#include "nlmech/comparison/reference/reference_of.hpp"

namespace nlmech::comparison {

/// A problem of the library with its parameters.
template <class Problem>
class OwnProblemOf final : public ProblemOfSize {
 public:
  /// With the parameters as set.
  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] ivp::System system() const override { return ivp::System(problem_); }
  [[nodiscard]] std::vector<Candidate> extended(const Effort& effort) const override {
    return taylor_candidates(problem_, static_cast<int>(problem_.initial_state().size()), effort);
  }
  [[nodiscard]] std::string_view name() const override { return Problem::name; }
  [[nodiscard]] std::vector<std::pair<std::string, double>> parameters() const override {
    std::vector<std::pair<std::string, double>> all;
    for (const auto& parameter : Problem::parameters)
      all.emplace_back(parameter.name, problem_.*(parameter.member));
    return all;
  }
  void set_parameter(std::string_view parameter, double value) override {
    problems::set_parameter(problem_, parameter, value);
  }
  [[nodiscard]] std::vector<std::string> state_names() const override {
    return problems::state_names(problem_);
  }
  using OwnProblem::initial_state;
  [[nodiscard]] std::vector<double> initial_state() const override {
    const auto x = problem_.initial_state();
    return {x.begin(), x.end()};
  }
  [[nodiscard]] double initial_time() const override { return Problem::initial_time; }

  [[nodiscard]] std::string_view equation() const override { return Problem::equation; }

 private:
  Problem problem_;
};

template <class Problem>
std::unique_ptr<OwnProblem> own_problem() {
  return std::make_unique<OwnProblemOf<Problem>>();
}

}  // namespace nlmech::comparison
