#include "nlmech/ivp/step_search.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "nlmech/ivp/failures.hpp"

namespace nlmech::ivp::detail {
namespace {

// Runs that differ by more have not begun to converge: nothing is concluded from them.
constexpr double converging = 1e-2;
constexpr int patience = 4;         // halvings without a smaller difference
constexpr int stuck_patience = 6;   // failures at the same time
constexpr int start_patience = 40;  // failures in a row before any success

}  // namespace

SearchAccount::SearchAccount(StepSearch search) : search_(std::move(search)) {
  if (!(search_.tolerance > 0) || !std::isfinite(search_.tolerance))
    throw std::invalid_argument(fmt::format("{}: the tolerance must be positive and finite, not {}",
                                            search_.name, search_.tolerance));
}

bool SearchAccount::give_up(const std::string& reason) {
  status_ = Status::failure(
      Outcome::not_converged,
      fmt::format("{}: no step was found for the tolerance {:.6g}: {}; take a larger tolerance, or a step",
                  search_.name, search_.tolerance, reason));
  return true;
}

bool SearchAccount::succeeded(double step, std::int64_t steps, double difference) {
  stuck_ = failures_ = 0;
  has_succeeded_ = true;
  if (difference <= search_.tolerance) return true;
  const auto most = static_cast<double>(search_.most_steps);
  if (difference < smallest_) {
    smallest_ = difference;
    since_smallest_ = 0;
  } else if (smallest_ < converging && ++since_smallest_ >= patience) {
    return give_up(
        fmt::format("runs with the steps {:.6g} and {:.6g} differ by {:.2g}, runs with larger "
                    "steps differed by {:.2g}",
                    2 * step, step, difference, smallest_));
  }
  double needed = 2 * static_cast<double>(steps);
  if (search_.order && difference < converging)
    needed = static_cast<double>(steps) * std::pow(difference / search_.tolerance, 1.0 / *search_.order);
  if (needed <= most) return false;
  return give_up(
      fmt::format("runs with the steps {:.6g} and {:.6g} differ by {:.2g}, and more than {} steps "
                  "would have to be taken",
                  2 * step, step, difference, search_.most_steps));
}

bool SearchAccount::failed(double t0, double t, std::int64_t steps, const Status& why) {
  if (why.outcome() == Outcome::step_underflow) {
    if (failure_.ok()) failure_ = why;
    status_ = failure_;
    return true;
  }
  failure_ = why;
  // A solution that ends, ends at the same time for all steps; steps that are too long fail early.
  const bool same_time = steps >= 64 && std::abs(t - failed_at_) <= 1e-3 * std::abs(t - t0);
  stuck_ = same_time ? stuck_ + 1 : 0;
  failed_at_ = t;
  const bool tired = ++failures_ >= (has_succeeded_ ? patience : start_patience);
  if (!tired && stuck_ < stuck_patience && 2 * steps <= search_.most_steps) return false;
  status_ = why;
  return true;
}

Status search_limit(const StepSearch& search, Outcome outcome, double t0, const Limits& limits) {
  const std::string name = search.name + ", in search of a step";
  return outcome == Outcome::step_limit ? step_limit(name, t0, limits.steps)
                                        : time_limit(name, t0, limits.seconds);
}

}  // namespace nlmech::ivp::detail
