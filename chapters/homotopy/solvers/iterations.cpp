#include "chapters/homotopy/solvers/iterations.hpp"

#include <fmt/format.h>

#include <string>

#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/scene/evidence/printed.hpp"

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
  const scene::Printed printed;
  const auto row = [&](const std::string& table, Scheme scheme, double height, double load, Model model,
                       double tolerance = 0) {
    const std::string method = scheme == Scheme::newton        ? "Newton"
                               : scheme == Scheme::fixed_point ? "Scalar fixed-point homotopy"
                                                               : "Scalar Newton homotopy";
    const std::string name = fmt::format("elgohary/{}/{}/", table, method);
    const bool converges = scheme != Scheme::newton || table == "table-2.2", relative = tolerance > 0;
    Iteration iteration{.scheme = scheme, .step = example_step};
    if (relative) iteration.tolerance = relative_tolerance(load, tolerance);
    const double count = printed[name + (converges ? "iterations" : "iterations (no convergence)")];
    return PrintedRow{table,
                      method,
                      height,
                      load,
                      model,
                      iteration,
                      static_cast<int>(count),
                      printed[name + "achieved accuracy"],
                      relative};
  };
  using enum Scheme;
  return {row("table-2.2", newton, 0.32, low_load, Model::williams),
          row("table-2.2", fixed_point, 0.32, low_load, Model::williams),
          row("table-2.3", newton, 0.44, near_load, Model::williams),
          row("table-2.3", fixed_point, 0.44, near_load, Model::williams),
          row("table-2.4", newton, 0.44, near_load, Model::element, 1e-6),
          row("table-2.4", fixed_point, 0.44, near_load, Model::element, 1e-6),
          row("table-2.4", newton_homotopy, 0.44, near_load, Model::element, 1e-6),
          row("table-2.5", newton, 0.44, last_load, Model::element, 1e-3),
          row("table-2.5", fixed_point, 0.44, last_load, Model::element, 1e-3),
          row("table-2.5", newton_homotopy, 0.44, last_load, Model::element, 1e-3)};
}

}  // namespace nlmech::chapters::homotopy
