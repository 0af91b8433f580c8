#include "chapters/homotopy/iterations.hpp"

#include "nlmech/algebraic/scalar_homotopy.hpp"

namespace nlmech::chapters::homotopy {
namespace {

Count by_newton(LoadedToggle& toggle, const Iteration& i, std::vector<Trace>* trace) {
  // The iteration ends by the residual, as in the text: never by its own rule.
  const algebraic::Newton method{.tolerance = 0, .iterations = i.limit + 1};
  Eigen::VectorXd x = toggle.unknowns(i.start);
  Count count{false, 0, 0};
  const auto look = [&](const algebraic::Iterate& at) {
    if (trace != nullptr) trace->push_back({toggle.deflection(at.x), at.norm});
    count = {at.norm <= i.tolerance, static_cast<int>(at.index), at.norm};
    return !count.converged && at.index < i.limit;
  };
  static_cast<void>(find_root(method, toggle.equations(), x, look));
  return count;
}

Count by_homotopy(LoadedToggle& toggle, const Iteration& i, std::vector<Trace>* trace) {
  using Function = algebraic::ScalarHomotopy::Function;
  const algebraic::ScalarHomotopy method{
      .function = i.scheme == Scheme::fixed_point ? Function::fixed_point : Function::newton,
      .step = i.step,
      .tolerance = i.tolerance,
      .steps = i.limit};
  Eigen::VectorXd x = toggle.unknowns(i.start);
  algebraic::Observer look;
  if (trace != nullptr) {
    look = [&](const algebraic::Iterate& at) {
      trace->push_back({toggle.deflection(at.x), at.norm});
      return true;
    };
  }
  const algebraic::Report report = find_root(method, toggle.equations(), x, look);
  return {report.status.ok(), static_cast<int>(report.statistics.steps), report.last};
}

}  // namespace

Count iterate(LoadedToggle& toggle, const Iteration& iteration, std::vector<Trace>* trace) {
  return iteration.scheme == Scheme::newton ? by_newton(toggle, iteration, trace)
                                            : by_homotopy(toggle, iteration, trace);
}

double relative_tolerance(double load, double tolerance) { return tolerance * load / 2; }

std::vector<PrintedRow> printed_rows() {
  const char *by_newton = "Newton", *by_fixed = "Scalar fixed-point homotopy",
             *by_homotopy = "Scalar Newton homotopy";
  const auto absolute = [](Scheme scheme) { return Iteration{.scheme = scheme, .step = example_step}; };
  const auto relative = [](Scheme scheme, double load, double tolerance) {
    return Iteration{
        .scheme = scheme, .step = example_step, .tolerance = relative_tolerance(load, tolerance)};
  };
  using enum Scheme;
  return {
      {"table-2.2", by_newton, 0.32, low_load, Model::williams, absolute(newton), 9, 6.4e-7, false},
      {"table-2.2", by_fixed, 0.32, low_load, Model::williams, absolute(fixed_point), 30, 8.9e-7, false},
      {"table-2.3", by_newton, 0.44, near_load, Model::williams, absolute(newton), 1000, 0.044, false},
      {"table-2.3", by_fixed, 0.44, near_load, Model::williams, absolute(fixed_point), 345, 7.6e-7, false},
      {"table-2.4", by_newton, 0.44, near_load, Model::element, relative(newton, near_load, 1e-6), 1000,
       4.2894, true},
      {"table-2.4", by_fixed, 0.44, near_load, Model::element, relative(fixed_point, near_load, 1e-6), 160,
       6.7e-8, true},
      {"table-2.4", by_homotopy, 0.44, near_load, Model::element, relative(newton_homotopy, near_load, 1e-6),
       500, 2.4e-8, true},
      {"table-2.5", by_newton, 0.44, last_load, Model::element, relative(newton, last_load, 1e-3), 1000,
       0.3042, true},
      {"table-2.5", by_fixed, 0.44, last_load, Model::element, relative(fixed_point, last_load, 1e-3), 14,
       3.9e-4, true},
      {"table-2.5", by_homotopy, 0.44, last_load, Model::element, relative(newton_homotopy, last_load, 1e-3),
       14, 4.02e-4, true}};
}

}  // namespace nlmech::chapters::homotopy
