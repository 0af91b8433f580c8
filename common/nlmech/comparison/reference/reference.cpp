#include "nlmech/comparison/reference/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

/// Relative difference of two computations above which they are no reference.
constexpr double largest_disagreement = 1e-2;

/// A computation that reached the end.
struct Arrived {
  Candidate by;
  StatesAt states;
};

Eigen::VectorXd size_of(const StatesAt& states) {
  return states.cwiseAbs().rowwise().maxCoeff().cast<double>();
}

/// |x|, or a thousandth of the component's size if that is greater; 1 for a component that is always zero.
double magnitude(double x, double size) {
  const double most = std::max(std::abs(x), 1e-3 * size);
  return most > 0 ? most : 1;
}

/// Difference of two computations.
struct Distance {
  double in_needs =
      std::numeric_limits<double>::infinity();  ///< greatest difference over the needed accuracy
  double relative =
      std::numeric_limits<double>::infinity();  ///< greatest difference over the component's size
  std::size_t first = 0, second = 0;            ///< indices of the two computations
};

Distance distance(const std::vector<Arrived>& arrived, std::size_t first, std::size_t second,
                  const Tolerance& needed) {
  const StatesAt &a = arrived[first].states, &b = arrived[second].states;
  const Eigen::VectorXd size = size_of(a);
  Distance most{0, 0, first, second};
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const auto difference = static_cast<double>(std::abs(a(i, k) - b(i, k)));
      const double scale = magnitude(static_cast<double>(a(i, k)), size[i]);
      most.in_needs = std::max(most.in_needs, difference / (needed.absolute + needed.relative * scale));
      most.relative = std::max(most.relative, difference / std::max(size[i], needed.absolute));
    }
  }
  return most;
}

/// A computation that failed.
struct Failed {
  std::string name;
  bool extended;
  Outcome outcome;
};

/// The failure if no two computations agree, with its reason.
Reference none_of(const std::vector<Arrived>& arrived, const Distance& best,
                  const std::vector<Failed>& failed) {
  std::string why = "no two methods reached the end within the work limit";
  if (arrived.size() >= 2 && std::isfinite(best.in_needs))
    why = fmt::format("the two methods that agree best, {} and {}, differ by {:.2g} of the solution",
                      arrived[best.first].by.name, arrived[best.second].by.name, best.relative);
  std::string separator = "; failed: ";
  for (const Failed& f : failed) {
    why += fmt::format("{}{} ({})", separator, f.name, to_string(f.outcome));
    separator = ", ";
  }
  // In extended precision step sizes shrink to zero because of a singularity and not because of rounding.
  const auto shrinks = [](const Failed& f) { return f.outcome == Outcome::step_underflow; };
  Reference none;
  none.status = Status::failure(Outcome::not_converged, why);
  none.undetermined = std::ranges::count_if(arrived, [](const Arrived& x) { return x.by.extended; }) >= 2;
  none.ends = std::ranges::any_of(failed, [&](const Failed& f) { return f.extended && shrinks(f); }) &&
              std::ranges::count_if(failed, shrinks) >= 2;
  return none;
}

/// A method for references in double precision.
struct ReferenceMethod {
  std::string_view name;
  double least_tolerance;   ///< smaller tolerances do not reduce the error
  std::int64_t most_steps;  ///< number of steps that take about 0.2 s
};

constexpr std::array reference_methods = {ReferenceMethod{"series", 1e-16, 50'000},
                                          ReferenceMethod{"adaptive-collocation", 1e-13, 20'000},
                                          ReferenceMethod{"odeint-rosenbrock4", 1e-12, 60'000},
                                          ReferenceMethod{"odeint-fehlberg78", 1e-13, 150'000},
                                          ReferenceMethod{"cvode-bdf", 1e-12, 100'000},
                                          ReferenceMethod{"gsl-rk8pd", 1e-13, 150'000},
                                          ReferenceMethod{"laier", 1e-12, 60'000}};

/// Runs @p by with an absolute tolerance for components that decay; if that fails, with the needed one.
Status by_reference_method(const ReferenceMethod& by, const ivp::System& system, const Tolerance& needed,
                           const WorkLimit& effort, const ReferenceRequest& request, double seconds,
                           StatesAt& states) {
  const Stopwatch watch;
  const ivp::MethodInfo& method = any_method(by.name);
  if (method.estimate_misses_time && depends_on_time(system, request.t0, request.x0.template cast<double>()))
    return Status::failure(Outcome::outside_validity, "its error estimate ignores terms that depend on t");
  const double relative = std::clamp(needed.relative / 10, by.least_tolerance, 1e-4);
  const double loose = std::max(needed.absolute / 10, relative * 1e-2);
  const auto steps = static_cast<std::int64_t>(effort.work * static_cast<double>(by.most_steps));
  Status status;
  for (const double absolute : {std::min(relative, loose) * 1e-6, loose}) {
    try {
      const ivp::Settings settings{.tolerance = relative, .absolute_tolerance = absolute};
      StepBudget budget(request.t0, request.times.back(), static_cast<double>(steps), effort.continues);
      ivp::Observer observer = effort.observer();  // implicit methods: their steps may grow late
      if (method.family == ivp::Family::series || method.family == ivp::Family::runge_kutta)
        observer = [&budget](const ivp::Step& step) { return budget.suffices(step.t1); };
      const ivp::Limits limits{
          .steps = steps, .seconds = seconds - watch.seconds(), .largest_step = effort.largest_step};
      const ivp::StateAccuracy accuracy{relative, absolute};
      const auto run = ivp::with_changes(ivp::within_domain(method.with(settings), effort.domain, accuracy),
                                         effort.changes, accuracy);
      status = states_by(run, system, request, observer, limits, states);
    } catch (const std::invalid_argument& error) {  // the method rejects the problem or the tolerance
      status = Status::failure(Outcome::outside_validity, error.what());
    }
    if (status.ok() || status.outcome() == Outcome::time_limit) break;
  }
  return status;
}

}  // namespace

double Reference::uncertainty() const {
  double worst = 0;
  const Eigen::Index last = states.cols() - 1;
  for (Eigen::Index i = 0; i < states.rows(); ++i)
    worst = std::max(worst, difference(i, last) / magnitude(static_cast<double>(states(i, last)), size[i]));
  return worst;
}

std::string Reference::text() const {
  if (!status.ok()) return status.sentence();
  const double digits = std::min(18.0, -std::log10(std::max(uncertainty(), 1e-19)));
  return fmt::format("{} and {} agree to {:.1f} digits", first.name, second.name, digits);
}

Reference agree(const std::vector<Candidate>& candidates, const ReferenceRequest& request,
                const Tolerance& needed, double seconds) {
  const Stopwatch watch;
  std::vector<Arrived> arrived;
  std::vector<Failed> failed;
  Distance best;
  for (const Candidate& c : candidates) {
    if (c.extended && std::ranges::any_of(failed, &Failed::extended)) continue;
    if (watch.seconds() >= seconds) break;
    StatesAt states;
    const Status status = c.compute(request, seconds - watch.seconds(), states);
    if (!status.ok()) {
      failed.push_back({c.name, c.extended, status.outcome()});
      continue;
    }
    arrived.push_back({c, std::move(states)});
    for (std::size_t i = 0; i + 1 < arrived.size(); ++i) {
      const Distance d = distance(arrived, i, arrived.size() - 1, needed);
      if (d.in_needs < best.in_needs) best = d;
    }
    if (best.in_needs <= 1) break;
    // If computations in extended precision disagree, double precision cannot be more accurate.
    if (c.extended && arrived.size() >= 2 && best.relative > largest_disagreement) break;
  }
  if (best.in_needs > 1 && !(best.relative <= largest_disagreement)) return none_of(arrived, best, failed);
  const Arrived &a = arrived[best.first], &b = arrived[best.second];
  Reference r;
  r.first = a.by;
  r.second = b.by;
  r.states = a.states;
  r.difference = (a.states - b.states).cwiseAbs().cast<double>();
  r.size = size_of(a.states);
  return r;
}

Status states_by(const ivp::NamedIntegrator& run, const ivp::System& system, const ReferenceRequest& request,
                 const ivp::Observer& observer, const ivp::Limits& limits, StatesAt& states) {
  const Stopwatch watch;
  states.resize(request.x0.size(), static_cast<Eigen::Index>(request.times.size()));
  ivp::Limits left = limits;
  ivp::State x = request.x0.cast<double>();
  double t = request.t0;
  for (std::size_t k = 0; k < request.times.size(); ++k) {
    left.seconds = limits.seconds - watch.seconds();
    ivp::Solution end = run(system, x, t, request.times[k], observer, left);
    if (end.status.outcome() == Outcome::interrupted)
      return Status::failure(Outcome::step_limit, "an explicit method takes too many steps");
    if (!end.status.ok()) return end.status;
    left.steps -= end.statistics.steps + end.statistics.rejected;
    x = end.x;
    t = request.times[k];
    states.col(static_cast<Eigen::Index>(k)) = x.cast<long double>();
  }
  return {};
}

Reference reference_of(std::vector<Candidate> all, const ivp::System& system, const ivp::State& x0, double t0,
                       const std::vector<double>& times, const Tolerance& needed, const WorkLimit& effort) {
  for (const ReferenceMethod& by : reference_methods) {
    const ivp::MethodInfo& method = any_method(by.name);
    if (!method.is_available() || (method.second_order_only && !system.second_order())) continue;
    all.push_back(
        {std::string(by.name), false, [=](const ReferenceRequest& request, double seconds, StatesAt& states) {
           return by_reference_method(by, system, needed, effort, request, seconds, states);
         }});
  }
  return agree(all, {x0.cast<long double>(), t0, times}, needed, effort.seconds);
}

std::vector<double> times_to_check(double t0, double t1, int count) {
  std::vector<double> times;
  for (int k = 1; k < count; ++k) {
    const double t = t0 + (t1 - t0) * (static_cast<double>(k) / count);
    const bool is_new = t != t0 && t != t1 && (times.empty() || t != times.back());
    if (is_new && std::isfinite(t)) times.push_back(t);
  }
  times.push_back(t1);
  return times;
}

}  // namespace nlmech::comparison
