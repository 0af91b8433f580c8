/// @file
/// Conversion of an initial value problem to a run on arrays, and of its result to a solution.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/peers/ivp/peer_stepper.hpp"

namespace nlmech::peers {

/// Passes the steps of a peer to an observer of states.
template <ivp::SystemLike S>
class StateObserver final : public ArrayObserver {
 public:
  /// @param observer must outlive this object; if it is empty, step() must not be called
  StateObserver(const ivp::ObserverOf<S>& observer, int size)
      : observer_(observer), x0_(size), x1_(size), states_(size, 1) {}

  bool step(std::int64_t index, double t0, double t1, const double* x0, const double* x1,
            PeerStepper& stepper) override {
    std::copy_n(x0, x0_.size(), x0_.data());
    std::copy_n(x1, x1_.size(), x1_.data());
    states_.col(0) = x1_;
    times_[0] = t1;
    const Dense dense(stepper, x0_.size());
    return observer_({index, t0, t1, x0_, x1_, times_, states_, dense});
  }

 private:
  using State = typename S::State;
  class Dense final : public ivp::DenseOutputOf<S> {
   public:
    Dense(PeerStepper& stepper, Eigen::Index size) : stepper_(stepper), size_(size) {}
    void at(double t, State& x) const override {
      x.resize(size_);
      stepper_.at(t, x.data());
    }

   private:
    PeerStepper& stepper_;
    Eigen::Index size_;
  };

  const ivp::ObserverOf<S>& observer_;
  State x0_, x1_;
  typename S::Nodes states_;
  std::array<double, 1> times_{};
};

/// Solves the problem by @p integrate, a callable `Status(EquationsOf<S>&, Run&)`.
template <ivp::SystemLike S, class Integrate>
[[nodiscard]] ivp::SolutionOf<S> run_peer(const ivp::InitialValueProblemOf<S>& problem,
                                          Integrate&& integrate) {
  EquationsOf<S> equations(problem.system);
  StateObserver<S> observer(problem.observer, problem.system.size());
  ivp::SolutionOf<S> solution{problem.t0, problem.x0, {}, {}};
  Run run{equations,         problem.t0,     problem.t1,
          solution.x.data(), problem.limits, problem.observer ? &observer : nullptr,
          Statistics{}};
  solution.status = integrate(equations, run);
  solution.t = run.t;
  solution.statistics = run.statistics;
  return solution;
}

/// A method of a library that works on arrays.
template <class Method>
concept RunsOnArrays = requires(Run& run, const Method& method) {
  { integrate_by(run, method) } -> std::same_as<Status>;
};

/// Makes such a method available to integrate().
template <RunsOnArrays Method>
[[nodiscard]] ivp::Solution run(const ivp::InitialValueProblem& problem, const Method& method) {
  return run_peer(problem, [&](auto& /*equations*/, Run& run) { return integrate_by(run, method); });
}

}  // namespace nlmech::peers
