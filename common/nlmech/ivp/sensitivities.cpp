#include "nlmech/ivp/sensitivities.hpp"

#include <utility>

namespace nlmech::ivp {
namespace {

/// Dense output with sensitivities of scale 1.
class Unscaled final : public DenseOutput {
 public:
  Unscaled(const DenseOutput& dense, const State& factors) : dense_(dense), factors_(factors) {}
  void at(double t, State& x) const override {
    dense_.at(t, x);
    x = x.cwiseProduct(factors_);
  }

 private:
  const DenseOutput& dense_;
  const State& factors_;
};

}  // namespace

SmoothRun controlled_by_solution(SmoothRun run, System scaled) {
  State factors = State::Ones(scaled.size());
  const program::VariationalLayout layout = scaled.layout();
  for (int k = 1; k <= layout.columns; ++k) {
    for (int i = 0; i < layout.size; ++i) factors[layout.place(i, k)] = 1 / unseen_scale;
  }
  return [run = std::move(run), scaled = std::move(scaled), factors](
             const System& /*system*/, const State& x0, double t0, double t1, const Observer& observer,
             const Limits& limits) {
    Observer unscaled;
    if (observer) {
      unscaled = [&](const Step& step) {
        const State from = step.x0.cwiseProduct(factors), to = step.x1.cwiseProduct(factors);
        const Nodes states = step.states.array().colwise() * factors.array();
        const Unscaled dense(step.dense, factors);
        return observer({step.index, step.t0, step.t1, from, to, step.times, states, dense});
      };
    }
    Solution end = run(scaled, x0.cwiseQuotient(factors), t0, t1, unscaled, limits);
    end.x = end.x.cwiseProduct(factors);
    return end;
  };
}

}  // namespace nlmech::ivp
