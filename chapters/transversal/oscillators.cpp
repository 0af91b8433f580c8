#include "chapters/transversal/oscillators.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/ivp/transversal/mtl.hpp"

namespace nlmech::chapters::transversal {

problems::TextProblem stand_in(double e2) {
  constexpr double turn = 2 * std::numbers::pi;
  return problems::TextProblem("driven-duffing", {{"damping", turn * 0.25},
                                                  {"stiffness", turn * turn * e2},
                                                  {"hardening", turn * turn * e2},
                                                  {"force", turn * turn * 0.5},
                                                  {"frequency", turn}});
}

Course course(const problems::TextProblem& problem, const ivp::State& x0, double end,
              const ivp::NamedIntegrator& method, const Reference* reference) {
  Course c;
  c.points.push_back({0, x0});
  const auto observe = [&c](const ivp::Step& step) {
    for (std::size_t i = 0; i < step.times.size(); ++i)
      c.points.push_back({step.times[i], step.states.col(static_cast<Eigen::Index>(i))});
    return true;
  };
  const auto solution = method(ivp::System(problem), x0, 0, end, observe, {});
  c.status = solution.status;
  c.work = solution.statistics;
  for (const Point& p : c.points) {
    c.largest = std::max(c.largest, std::abs(p.x[0]));
    // Rounding can put the last point an ulp beyond the end.
    if (reference != nullptr)
      c.error =
          std::max(c.error, std::abs(p.x[0] - static_cast<double>((*reference)(std::min(p.t, end))[0])));
  }
  if (!c.status.ok()) c.error = std::numeric_limits<double>::infinity();
  return c;
}

ivp::NamedIntegrator mtl(double step, int points) {
  // The procedure of the source has no error estimate and never stops at a large error.
  const ivp::Mtl method{.step = step, .points = points, .error_tolerance = 0};
  return [method](const ivp::System& system, const ivp::State& x0, double t0, double t1,
                  const ivp::Observer& observer, const ivp::Limits& limits) {
    return ivp::integrate(system, x0, t0, t1, method, observer, limits);
  };
}

ivp::NamedIntegrator classical(std::string_view name, double step) {
  return ivp::named_integrator(name, {.step = step});
}

}  // namespace nlmech::chapters::transversal
