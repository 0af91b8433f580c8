#include "nlmech/comparison/reference/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/features.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

/// One of the methods that references are made of.
struct Judge {
  std::string_view name;
  double least_tolerance;    ///< below which it gains nothing
  std::int64_t most_steps;   ///< in some fifth of a second
  bool is_explicit = false;  ///< its steps do not grow once a problem has shown its stiffness
  bool second_order_only = false;
};

constexpr std::array judges = {
    Judge{"series", 1e-16, 50'000, true},       Judge{"adaptive-collocation", 1e-13, 20'000},
    Judge{"odeint-rosenbrock4", 1e-12, 60'000}, Judge{"odeint-fehlberg78", 1e-13, 150'000, true},
    Judge{"cvode-bdf", 1e-12, 100'000},         Judge{"gsl-rk8pd", 1e-13, 150'000, true},
    Judge{"laier", 1e-12, 60'000, false, true}};

bool is_here(const Judge& judge, bool second_order) {
  if (judge.second_order_only && !second_order) return false;
  return any_method(judge.name).is_available();
}

/// By absolute tolerances for components that decay, then by those needed.
Status by_judge(const Judge& judge, const ivp::System& system, const Needed& needed, const Effort& effort,
                const Way& way, double seconds, StatesAt& states) {
  const Stopwatch watch;
  const ivp::MethodInfo& method = any_method(judge.name);
  if (method.estimate_misses_time && depends_on_time(system, way.t0, way.x0.template cast<double>()))
    return Status::failure(Outcome::outside_validity, "its error estimate does not see what depends on t");
  const double relative = std::clamp(needed.relative / 10, judge.least_tolerance, 1e-4);
  const double loose = std::max(needed.absolute / 10, relative * 1e-2);
  const auto steps = static_cast<std::int64_t>(effort.work * static_cast<double>(judge.most_steps));
  Status status;
  for (const double absolute : {std::min(relative, loose) * 1e-6, loose}) {
    try {
      const ivp::Settings settings{.tolerance = relative, .absolute_tolerance = absolute};
      Pace pace(way.t0, way.times.back(), static_cast<double>(steps));
      ivp::Observer observer;  // empty for methods whose steps may yet grow
      if (judge.is_explicit) observer = [&pace](const ivp::Step& step) { return pace.suffices(step.t1); };
      const ivp::Limits limits{
          .steps = steps, .seconds = seconds - watch.seconds(), .largest_step = effort.largest_step};
      status = states_by(method.with(settings), system, way, observer, limits, states);
    } catch (const std::invalid_argument& error) {  // the problem is not for it, or the tolerance
      status = Status::failure(Outcome::outside_validity, error.what());
    }
    if (status.ok() || status.outcome() == Outcome::time_limit) break;
  }
  return status;
}

Candidate candidate_of(const Judge& judge, const ivp::System& system, const Needed& needed,
                       const Effort& effort) {
  return {std::string(judge.name), "", false, [=](const Way& way, double seconds, StatesAt& states) {
            return by_judge(judge, system, needed, effort, way, seconds, states);
          }};
}

}  // namespace

Status states_by(const ivp::NamedIntegrator& run, const ivp::System& system, const Way& way,
                 const ivp::Observer& observer, const ivp::Limits& limits, StatesAt& states) {
  const Stopwatch watch;
  states.resize(way.x0.size(), static_cast<Eigen::Index>(way.times.size()));
  ivp::Limits left = limits;
  ivp::State x = way.x0.template cast<double>();
  double t = way.t0;
  for (std::size_t k = 0; k < way.times.size(); ++k) {
    left.seconds = limits.seconds - watch.seconds();
    ivp::Solution end = run(system, x, t, way.times[k], observer, left);
    if (end.status.outcome() == Outcome::interrupted)
      return Status::failure(Outcome::step_limit, "an explicit method takes too many steps");
    if (!end.status.ok()) return end.status;
    left.steps -= end.statistics.steps + end.statistics.rejected;
    x = end.x;
    t = way.times[k];
    for (Eigen::Index i = 0; i < x.size(); ++i) states(i, static_cast<Eigen::Index>(k)) = x[i];
  }
  return {};
}

Reference reference_of(std::vector<Candidate> extended, const ivp::System& system, const ivp::State& x0,
                       double t0, const std::vector<double>& times, const Needed& needed,
                       const Effort& effort) {
  for (const Judge& judge : judges) {
    if (is_here(judge, system.second_order()))
      extended.push_back(candidate_of(judge, system, needed, effort));
  }
  return agree(extended, {x0.cast<long double>(), t0, times}, needed, effort.seconds);
}

}  // namespace nlmech::comparison
