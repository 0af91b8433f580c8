#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

namespace nlmech::ivp {

Solution run(const InitialValueProblem& problem, const Euler& method) {
  return run<System, Euler>(problem, method);
}

Solution run(const InitialValueProblem& problem, const Rk4& method) {
  return run<System, Rk4>(problem, method);
}

Solution run(const InitialValueProblem& problem, const Rk6& method) {
  return run<System, Rk6>(problem, method);
}

}  // namespace nlmech::ivp
