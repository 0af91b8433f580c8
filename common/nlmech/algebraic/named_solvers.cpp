#include "nlmech/algebraic/named_solvers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/algebraic/homotopies/continuous_newton.hpp"
#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/algebraic/homotopies/vector_homotopy.hpp"
#include "nlmech/algebraic/newton/broyden.hpp"
#include "nlmech/algebraic/newton/descent.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/newton/least_squares.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/algebraic/solver_run.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

/// Arguments of one call of a solver.
struct Call {
  double tolerance;  // of |F|
  std::int64_t iterations;
  Equations& equations;
  Eigen::VectorXd& x;
  const Observer& observer;

  template <class Method>
  [[nodiscard]] Report operator()(const Method& method) const {
    return find_root(method, equations, x, observer);
  }
  [[nodiscard]] int count() const {
    return static_cast<int>(std::min<std::int64_t>(iterations, std::numeric_limits<int>::max()));
  }
};

// Tolerance 0: the named Newton stops on the residual, or at an update of length 0.
Report newton(const Call& c) {
  return c(Newton{.tolerance = 0, .iterations = c.count(), .residual = c.tolerance});
}
Report damped_newton(const Call& c) {
  return c(DampedNewton{.tolerance = 0, .iterations = c.count(), .residual = c.tolerance});
}
Report scalar(const Call& c, ScalarHomotopy::Function function) {
  return c(ScalarHomotopy{.function = function, .tolerance = c.tolerance, .steps = c.iterations});
}
Report fixed_point(const Call& c) { return scalar(c, ScalarHomotopy::Function::fixed_point); }
Report newton_homotopy(const Call& c) { return scalar(c, ScalarHomotopy::Function::newton); }
Report vector_homotopy(const Call& c) {
  return c(VectorHomotopy{.tolerance = c.tolerance, .limit = c.iterations});
}

// The trust-region and path methods iterate to rounding; the tolerance is checked afterwards.
Report energy_trust_region(const Call& c) {
  auto* const potential = dynamic_cast<Potential*>(&c.equations);
  if (!potential)
    throw std::logic_error("energy-trust-region: these equations are not the gradient of a potential");
  return find_root(EnergyTrustRegion{.iterations = c.count()}, *potential, c.x, c.observer);
}
template <PathMethod::Kind kind>
Report arc_length(const Call& c) {
  return c(ArcLength{.path = {.kind = kind}, .steps = c.iterations});
}

/// The default options of a method, with the call's tolerance and limit.
template <class Method>
Report plain(const Call& c) {
  Method method;
  method.tolerance = c.tolerance;
  method.iterations = c.iterations;
  return c(method);
}

/// |F| counts as rounding up to this factor times its change under two perturbations of x.
constexpr double above_rounding = 4;

struct Entry {
  std::string_view name;
  Report (*solve)(const Call&);
};

// One line per solver; add new solvers here.
constexpr Entry entries[] = {
    {"newton", newton},
    {"damped-newton", damped_newton},
    {"continuous-newton", plain<ContinuousNewton>},
    {"broyden", plain<Broyden>},
    {"least-squares", plain<LeastSquares>},
    {"steepest-descent", plain<SteepestDescent>},
    {"fictitious-time", plain<FictitiousTime>},
    {"vector-homotopy", vector_homotopy},
    {"chow-yorke", plain<ChowYorke>},
    {"scalar-homotopy", plain<FirstScalarHomotopy>},
    {"fixed-point", fixed_point},
    {"newton-homotopy", newton_homotopy},
    {"optimal-iterative", plain<OptimalIterative>},
    {"levenberg-marquardt", plain<LevenbergMarquardt>},
    {"dogleg", plain<Dogleg>},
    {"energy-trust-region", energy_trust_region},
    {"riks", arc_length<PathMethod::Kind::riks>},
    {"crisfield", arc_length<PathMethod::Kind::crisfield>},
    {"gdc", arc_length<PathMethod::Kind::gdc>},
};

}  // namespace

std::vector<std::string_view> solver_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

Report find_root(const NamedSolver& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  const auto* const entry = std::find_if(std::begin(entries), std::end(entries),
                                         [&](const Entry& e) { return e.name == method.name; });
  if (entry == std::end(entries))
    throw invalid_argument("there is no solver '{}'; choose one of {}", method.name,
                           fmt::join(solver_names(), ", "));
  const std::string_view name = method.name;
  require_option(name, method.tolerance > 0 && std::isfinite(method.tolerance), "tolerance", method.tolerance,
                 "positive");
  require_option(name, method.scale > 0 && std::isfinite(method.scale), "scale", method.scale, "positive");
  require_option(name, method.iterations >= 1, "iterations", static_cast<double>(method.iterations),
                 "at least 1");
  require_option(name, std::isfinite(method.tolerance * method.scale), "tolerance times scale",
                 method.tolerance * method.scale, "finite");
  Report report = entry->solve({method.tolerance * method.scale, method.iterations, equations, x, observer});
  return checked_against_tolerance(method, equations, x, std::move(report));
}

namespace {

/// Did the iteration end regularly, so that its residual can be judged? False after singular or non-finite
/// values, or an interruption.
bool has_ended(Outcome outcome) {
  return outcome == Outcome::success || outcome == Outcome::not_converged || outcome == Outcome::step_limit ||
         outcome == Outcome::step_underflow || outcome == Outcome::newton_diverged;
}

/// Status of a solve that ended with F(x) = @p f and |f| above the tolerance.
Status missed(const NamedSolver& method, Equations& equations, const Eigen::VectorXd& x,
              const Eigen::VectorXd& f, Report& report) {
  const double rounding =
      rounding_of_residual(equations, x, f, [](const Eigen::VectorXd& v) { return length_of(v); });
  const double floor = above_rounding * (rounding + std::numeric_limits<double>::epsilon() * method.scale);
  const bool is_success = report.status.ok();
  if (!(report.last <= floor)) {
    if (!is_success) return report.status;
    return failed_with(Outcome::not_converged,
                       "{}: the iteration ends with |F| = {:.3g}, above the tolerance, {:.3g}; start "
                       "elsewhere, or take another solver",
                       method.name, report.last, report.bound);
  }
  if (method.to_rounding && floor <= method.scale) {
    report.bound = floor;
    ++report.statistics.fallbacks;
    return {};
  }
  return failed_with(is_success ? Outcome::not_converged : report.status.outcome(),
                     "{}: |F| = {:.3g} at the end is above the tolerance, {:.3g}, but at the level of "
                     "rounding: changes of x in its last digits alone make |F| = {:.3g}; take a tolerance of "
                     "{:.1g} or more, or coarser equations",
                     method.name, report.last, report.bound, rounding, 2 * report.last / method.scale);
}

}  // namespace

//! [held to the tolerance]
Report checked_against_tolerance(const NamedSolver& method, Equations& equations, const Eigen::VectorXd& x,
                                 Report report) {
  Eigen::VectorXd f(equations.size());
  equations.residual(x, f);
  const Status of_equations = equations.status();
  const double norm = length_of(f);
  report.bound = method.tolerance * method.scale;
  if (!std::isfinite(norm) || !x.allFinite()) {
    if (report.status.ok())
      report.status =
          failed_with(Outcome::non_finite, "{}: F is not finite at the end; start elsewhere", method.name);
    return report;
  }
  report.last = norm;
  report.least = std::min(report.least, norm);
  if (!(norm <= report.bound) && has_ended(report.status.outcome()))
    report.status = missed(method, equations, x, f, report);
  if (report.status.ok() && of_equations.outcome() == Outcome::wrong_branch) report.status = of_equations;
  return report;
}
//! [held to the tolerance]

}  // namespace nlmech::algebraic
