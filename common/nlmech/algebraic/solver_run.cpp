#include "nlmech/algebraic/solver_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

std::string_view advice_for(Outcome outcome) {
  switch (outcome) {
    case Outcome::step_limit: return "the allowed steps are used up; allow more, or start closer to a root";
    case Outcome::singular_matrix: return "the matrix dF/dx is singular; start elsewhere";
    case Outcome::non_finite:
      return "F or its derivative is not finite; take shorter steps or start elsewhere";
    case Outcome::not_converged:
      return "|F| cannot be made smaller from here: a minimum that is no root, or rounding; start elsewhere "
             "or loosen the tolerance";
    case Outcome::step_underflow: return "no step is short enough; start elsewhere";
    default: return "stopped by the observer";
  }
}

}  // namespace

void require_option(std::string_view method, bool good, std::string_view option, double value,
                    std::string_view range) {
  if (!good) throw invalid_argument("{}: {} = {}; it must be {}", method, option, value, range);
}

SolverRun::SolverRun(std::string_view name, Equations& equations, const Eigen::VectorXd& start,
                     const Observer& observer, double tolerance, std::int64_t limit)
    : x(start),
      f(start.size()),
      trial(start.size()),
      trial_f(start.size()),
      name_(name),
      equations_(equations),
      observer_(observer),
      tolerance_(tolerance),
      limit_(limit) {
  require_size(name_.c_str(), equations, start);
  require_option(name, tolerance >= 0, "tolerance", tolerance, "0 or positive");
  require_option(name, limit >= 0, "iterations", static_cast<double>(limit), "0 or positive");
}

double SolverRun::evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& out) {
  equations_.residual(at, out);
  ++statistics().right_hand_sides;
  const double length = length_of(out);
  return std::isfinite(length) ? length : HUGE_VAL;
}

Outcome SolverRun::begin() {
  norm = evaluate(x, f);
  report.first = report.least = report.last = norm;
  return std::isfinite(norm) ? show({}) : Outcome::non_finite;
}

bool SolverRun::go_on(Outcome& outcome) const {
  if (outcome != Outcome::success || is_done()) return false;
  if (is_spent()) outcome = Outcome::step_limit;
  return outcome == Outcome::success;
}

Outcome SolverRun::accept(std::optional<double> time) {
  x.swap(trial);
  f.swap(trial_f);
  std::swap(norm, trial_norm);
  ++statistics().steps;
  report.least = std::min(report.least, norm);
  report.last = norm;
  if (time) report.time = *time;
  return show(time);
}

Outcome SolverRun::show(std::optional<double> time) {
  const std::int64_t index = statistics().steps;
  if (!observer_) return Outcome::success;
  const Iterate point = {index, time ? *time : static_cast<double>(index), x, f, norm};
  return observer_(point) ? Outcome::success : Outcome::interrupted;
}

Report SolverRun::finish(Outcome outcome, Eigen::VectorXd& start, std::string_view advice) {
  start = x;
  if (outcome == Outcome::success) return std::move(report);
  const Status reason = equations_.status();
  std::string place = fmt::format("{}: at iteration {}", name_, statistics().steps);
  if (statistics().rejected > 0) place += fmt::format(" ({} more rejected)", statistics().rejected);
  if (report.time != 0) place += fmt::format(", fictitious time {:.6g}", report.time);
  std::string sentence =
      fmt::format("{}, with |F| = {:.3g}: {}", place, norm, advice.empty() ? advice_for(outcome) : advice);
  if (outcome == Outcome::non_finite && !reason.ok()) sentence += " (" + reason.sentence() + ")";
  report.status = Status::failure(outcome, std::move(sentence));
  return std::move(report);
}

}  // namespace nlmech::algebraic
