#include <cstdio>

// [example]
#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/optimal_control/dual_control.hpp"

// A cart moves by 1 from rest to rest in one second, with the least integral of f^2/2.
struct Cart {
  static constexpr int states = 2, controls = 1;
  template <class T>
  void dynamics(const T&, const nlmech::Vector<T, 2>& x, const nlmech::Vector<T, 1>& f, const T&,
                nlmech::Vector<T, 2>& g) const {
    g[0] = x[1];
    g[1] = f[0];
  }
  template <class T>
  T running_cost(const T&, const nlmech::Vector<T, 2>&, const nlmech::Vector<T, 1>& f, const T&) const {
    return f[0] * f[0] / 2.0;
  }
  template <class T>
  T end_cost(const nlmech::Vector<T, 2>&, const nlmech::Vector<T, 2>&, const T&) const {
    return T(0);
  }
};

int main() {
  using namespace nlmech::bvp;
  const ExtremalProblem problem(std::make_shared<DualControl<Cart>>(Cart{}),
                                {.final_time = 1, .begin = {0., 0.}, .end = {1., 0.}});
  const ControlGuess guess{Eigen::VectorXd::Zero(2), [](double, Eigen::VectorXd& f) { f[0] = 0; }};
  const Extremal e = solve_extremal(problem, direct_start(problem, guess).start);
  std::printf("%s: cost %.9f, first force %.9f, miss %.1e\n", e.solution.status.text().c_str(), e.cost,
              control_at(problem, e.solution, 0)[0], e.miss);
  return e.solution.status.ok() ? 0 : 1;
}
// [example]
