/// @file
/// From a task on a system to a run on arrays, and back to a solution.
#pragma once

#include <array>
#include <concepts>

#include "nlmech/peers/ivp/peer_stepper.hpp"

namespace nlmech::peers {

/// Shows the steps of a peer to an observer of states.
template <int n>
class ObserverOf final : public ArrayObserver {
 public:
  /// @param observer outlives this object; may be empty, then step() must not be called
  ObserverOf(const ivp::Observer<n>& observer, int size)
      : observer_(observer), x0_(size), x1_(size), states_(size, 1) {}

  bool step(std::int64_t index, double t0, double t1, const double* x0, const double* x1,
            PeerStepper& stepper) override {
    x0_ = Eigen::Map<const ivp::State<n>>(x0, x0_.size());
    x1_ = Eigen::Map<const ivp::State<n>>(x1, x1_.size());
    states_.col(0) = x1_;
    times_[0] = t1;
    const Dense dense(stepper, x0_.size());
    return observer_({index, t0, t1, x0_, x1_, times_, states_, dense});
  }

 private:
  class Dense final : public ivp::DenseOutput<n> {
   public:
    Dense(PeerStepper& stepper, Eigen::Index size) : stepper_(stepper), size_(size) {}
    void at(double t, ivp::State<n>& x) const override {
      x.resize(size_);
      stepper_.at(t, x.data());
    }

   private:
    PeerStepper& stepper_;
    Eigen::Index size_;
  };

  const ivp::Observer<n>& observer_;
  ivp::State<n> x0_, x1_;
  ivp::Nodes<n> states_;
  std::array<double, 1> times_{};
};

/// Lets @p integrate, a callable `Status(EquationsOf<S>&, Run&)`, do the task.
template <ivp::SystemLike S, class Integrate>
[[nodiscard]] ivp::Solution<S::dimension> run_peer(const ivp::Task<S>& task, Integrate&& integrate) {
  EquationsOf<S> equations(task.system);
  ObserverOf<S::dimension> observer(task.observer, task.system.size());
  ivp::Solution<S::dimension> solution{task.t0, task.x0, {}, {}};
  Run run{equations,   task.t0, task.t1, solution.x.data(), task.limits, task.observer ? &observer : nullptr,
          Statistics{}};
  solution.status = integrate(equations, run);
  solution.t = run.t;
  solution.statistics = run.statistics;
  return solution;
}

/// A method that a library runs on arrays, whatever the system is; on some systems perhaps without them.
template <class Method>
concept RunsOnArrays = requires(Run& run, const Method& method) {
  { integrate_by(run, method) } -> std::same_as<Status>;
};

}  // namespace nlmech::peers

/// Such a method as one of integrate().
template <nlmech::ivp::SystemLike S, nlmech::peers::RunsOnArrays Method>
struct nlmech::ivp::Integrator<S, Method> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const Method& method) {
    return peers::run_peer(task, [&](auto& equations, peers::Run& run) {
      if constexpr (requires { integrate_by(equations, run, method); }) {
        return integrate_by(equations, run, method);
      } else {
        return integrate_by(run, method);
      }
    });
  }
};
