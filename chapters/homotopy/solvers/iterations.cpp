#include "chapters/homotopy/solvers/iterations.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>

#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// Detects a cycle of an iteration in one unknown whose next iterate depends on the latest alone: an iterate
/// repeats bit by bit (R. P. Brent 1980, *An improved Monte Carlo factorization algorithm*).
class Round {
 public:
  /// Takes the next iterate. @returns length of the cycle; 0 while none is detected
  int see(double x) {
    if (steps_ > 0 && x == mark_) return steps_;
    if (steps_ == next_mark_) {
      mark_ = x;
      next_mark_ *= 2;
      steps_ = 0;
    }
    ++steps_;
    return 0;
  }

 private:
  double mark_ = std::numeric_limits<double>::quiet_NaN();
  int steps_ = 1, next_mark_ = 1;
};

/// Stops a cycling iteration early, at an iterate equal to that at the limit of iterations.
class Ending {
 public:
  explicit Ending(int limit) : limit_(limit) {}
  /// Is iterate number @p index the last, or equal to the last?
  bool is_last(std::int64_t index, double x) {
    if (const int round = last_ < 0 ? round_.see(x) : 0; round > 0) last_ = index + (limit_ - index) % round;
    return index >= limit_ || index == last_;
  }

 private:
  int limit_;
  Round round_;
  std::int64_t last_ = -1;
};

Count by_newton(LoadedToggle& toggle, const Iteration& i, std::vector<IterationRecord>* trace) {
  // The observer stops the iteration by the residual, as in the source; tolerance 0 disables Newton's own
  // test.
  const algebraic::Newton method{.tolerance = 0, .iterations = i.limit + 1};
  Eigen::VectorXd x = toggle.unknowns(i.start);
  Count count{false, 0, 0};
  Ending ending(i.limit);
  const auto look = [&](const algebraic::Iterate& at) {
    if (trace != nullptr) trace->push_back({toggle.deflection(at.x), at.norm});
    const bool is_last = trace != nullptr ? at.index >= i.limit : ending.is_last(at.index, at.x[0]);
    count = {at.norm <= i.tolerance, is_last ? i.limit : static_cast<int>(at.index), at.norm};
    return !count.converged && !is_last;
  };
  static_cast<void>(find_root(method, toggle.equations(), x, look));
  return count;
}

Count by_homotopy(LoadedToggle& toggle, const Iteration& i, std::vector<IterationRecord>* trace) {
  using Function = algebraic::ScalarHomotopy::Function;
  const algebraic::ScalarHomotopy method{
      .function = i.scheme == Scheme::fixed_point ? Function::fixed_point : Function::newton,
      .step = i.step,
      .tolerance = i.tolerance,
      .steps = i.limit};
  Eigen::VectorXd x = toggle.unknowns(i.start);
  // From this time on exp(-t) is below rounding, and the iteration does not depend on time.
  constexpr double timeless = 100;
  Ending ending(i.limit);
  bool is_last = false;
  const auto look = [&](const algebraic::Iterate& at) {
    if (trace != nullptr) {
      trace->push_back({toggle.deflection(at.x), at.norm});
    } else if (at.time > timeless) {
      is_last = ending.is_last(at.index, at.x[0]);
    }
    return !is_last || at.norm <= i.tolerance;
  };
  const algebraic::Report report = find_root(method, toggle.equations(), x, look);
  return {report.status.ok(), is_last ? i.limit : static_cast<int>(report.statistics.steps), report.last};
}

}  // namespace

Count iterate(LoadedToggle& toggle, const Iteration& iteration, std::vector<IterationRecord>* trace) {
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
