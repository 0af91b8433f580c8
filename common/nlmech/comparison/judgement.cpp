#include "nlmech/comparison/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// "take --tolerance 1e-12 or another method": a tolerance that should suffice, if there is one.
std::string advice(const Verification& found, double tolerance) {
  const double excess = std::max(1.0, found.tolerances / found.allowed);
  const double smaller = std::pow(10, std::floor(std::log10(tolerance / excess / 3)));
  return smaller >= 1e-13 ? fmt::format("take --tolerance {:.0e} or another method", smaller)
                          : "take another method";
}

}  // namespace

Tolerance tolerance_of(const ivp::Settings& settings) {
  const double relative = settings.tolerance.value_or(ivp::default_tolerance);
  return {relative, settings.absolute_tolerance.value_or(relative)};
}

Needed needed_for(const Tolerance& tolerance) { return {tolerance.relative / 10, tolerance.absolute / 10}; }

Effort effort_after(const Statistics& work, int components, double left) {
  // 1e7 numbers of right-hand sides take a second or so.
  const double done =
      static_cast<double>(work.right_hand_sides + work.jacobians * components) * components / 1e7;
  // The clock ends it only on a machine that is far slower than that, or busy.
  return {std::min(1 + 4 * done, 100.0), std::min(left, 10 + 20 * work.seconds)};
}

std::string remark(const Verification& found, const Reference& reference, const ivp::MethodInfo& method,
                   const ivp::Settings& settings, const std::vector<std::string>& names) {
  using Verdict = Verification::Verdict;
  if (found.verdict == Verdict::unknown) return "not verified: " + found.reason;
  const double tolerance = tolerance_of(settings).relative;
  if (found.verdict == Verdict::ended)
    throw Failure(
        failed_with(Outcome::step_underflow,
                    "{}: the solution seems to end on the way, and this run at the tolerance {:.6g} to have "
                    "leapt across: {}; take an earlier end or a smaller tolerance (--no-verify prints "
                    "the run as it is)",
                    method.name, tolerance, found.reason));
  const std::string place =
      fmt::format("{} at t = {:.9g}", names.at(static_cast<std::size_t>(found.component)), found.t);
  if (found.verdict == Verdict::undetermined)
    throw Failure(failed_with(
        Outcome::outside_validity,
        "{}: nothing determines {}: up to there the problem multiplies an error of the tolerance {:.6g} by "
        "{:.2g}; take a smaller tolerance or an earlier end (--no-verify prints the run as it is)",
        method.name, place, tolerance, found.growth));
  if (found.verdict == Verdict::wrong)
    throw Failure(failed_with(Outcome::not_converged,
                              "{}: verified by integration, {} is off by {:.2g}: {:.3g} times the tolerance "
                              "{:.6g}, where the number of steps and the problem's condition explain {:.3g}; "
                              "the tolerance {}: {} (--no-verify prints the run as it is; reference: {})",
                              method.name, place, found.error, found.tolerances, tolerance, found.allowed,
                              what_a_tolerance_holds, advice(found, tolerance), reference.text()));
  if (found.tolerances <= most_tolerances) return "";
  return fmt::format(
      "verified: {} is off by {:.2g}, {:.3g} tolerances, since the problem multiplies errors by up to {:.3g}",
      place, found.error, found.tolerances, found.growth);
}

}  // namespace nlmech::comparison
