#include "nlmech/ivp/named/step_search.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp::detail {
namespace {

// Runs that differ by more have not begun to converge: nothing is concluded from them.
constexpr double converging = 1e-2;
constexpr int patience = 4;           // runs without a smaller difference
constexpr int stuck_patience = 6;     // failures at the same time
constexpr int start_patience = 40;    // failures in a row before any success
constexpr std::int64_t least = 16;    // steps of the first run
constexpr std::int64_t enough = 256;  // steps after which a frequency out of reach is believed; four times as
                                      // many, and another method is asked for the end of the solution

constexpr int spread = 48;       // times by the golden ratio
constexpr int after_begin = 16;  // times ever nearer to the begin
constexpr int after_jump = 8;    // and to a jump
constexpr std::size_t jumps_most = 16;

}  // namespace

std::vector<double> search_times(double t0, double t1, const std::vector<double>& jumps) {
  constexpr double golden = 0.6180339887498949;
  std::vector<double> times;
  for (int k = 1; k <= spread; ++k) times.push_back(t0 + (t1 - t0) * (k * golden - std::floor(k * golden)));
  const auto halve = [&](double begin, double end, int count) {
    for (int j = 1; j <= count; ++j) times.push_back(begin + std::ldexp(end - begin, -j));
  };
  const std::size_t count = std::min(jumps.size(), jumps_most);
  halve(t0, jumps.empty() ? t1 : jumps.front(), after_begin);
  for (std::size_t i = 0; i < count; ++i)
    halve(jumps[i], i + 1 < jumps.size() ? jumps[i + 1] : t1, after_jump);
  const double from = std::min(t0, t1), to = std::max(t0, t1);
  std::erase_if(times, [&](double t) { return !(t > from && t < to); });
  times.push_back(t1);
  std::sort(times.begin(), times.end());
  if (t1 < t0) std::reverse(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

SearchAccount::SearchAccount(StepSearch search, double interval)
    : search_(std::move(search)), radians_(interval * search_.frequency) {
  if (!(search_.tolerance > 0) || !std::isfinite(search_.tolerance))
    throw invalid_argument("{}: the tolerance must be positive and finite, not {}", search_.name,
                           search_.tolerance);
}

std::int64_t SearchAccount::first_count() const {
  const auto most = static_cast<double>(search_.most_steps / 4096);
  return radians_ > static_cast<double>(least) && radians_ <= most
             ? static_cast<std::int64_t>(std::ceil(radians_))
             : least;
}

bool SearchAccount::give_up(const std::string& reason) {
  status_ = failed_with(Outcome::not_converged,
                        "{}: no step was found for the tolerance {:.6g}: {}{}; take a larger tolerance, an "
                        "earlier end, or a step",
                        search_.name, search_.tolerance, reason, about_frequency());
  return true;
}

std::string SearchAccount::compared(const Finding& found) const {
  if (found.doubt > found.difference)
    return fmt::format("the run of {} steps differs from {} by {:.2g}", found.count, found.evidence,
                       2 * found.doubt);
  return fmt::format("runs of {} and {} steps differ by {:.2g}", found.before, found.count, found.difference);
}

std::string SearchAccount::about_frequency() const {
  if (!(radians_ > static_cast<double>(least))) return "";
  return fmt::format(" (the problem's frequency of {:.3g} rad a unit of time asks for {:.3g} steps and more)",
                     search_.frequency, radians_);
}

bool SearchAccount::succeeded(const Finding& found) {
  stuck_ = failures_ = 0;
  has_succeeded_ = true;
  const double difference = found.doubt > found.difference ? found.doubt : found.difference;
  if (difference <= search_.tolerance) return true;
  const auto most = static_cast<double>(search_.most_steps), steps = static_cast<double>(found.count);
  if (difference < smallest_) {
    smallest_ = difference;
    since_smallest_ = 0;
  } else if (smallest_ < converging && ++since_smallest_ >= patience) {
    return give_up(fmt::format("{}, a run of fewer steps had {:.2g}", compared(found), smallest_));
  }
  double needed = 2 * steps;
  if (search_.order && difference < converging)
    needed = steps * std::pow(difference / search_.tolerance, 1.0 / *search_.order);
  if (!(difference < converging) && found.count >= enough) needed = std::max(needed, radians_);
  if (needed <= most) return false;
  return give_up(
      fmt::format("{}, and more than {} steps would have to be taken", compared(found), search_.most_steps));
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

bool SearchAccount::wonders(const Finding& found) {
  return found.count >= 4 * enough && !(found.difference < converging);
}

bool SearchAccount::ended(const Status& why) {
  if (why.outcome() != Outcome::non_finite && why.outcome() != Outcome::step_underflow) return false;
  status_ = failed_with(why.outcome(), "{}: its runs do not agree, and another method finds why: {}",
                        search_.name, why.sentence());
  return true;
}

void SearchAccount::unconfirmed(const Finding& found, std::int64_t steps, const Status& why) {
  give_up(fmt::format("{}, but no other method confirms them within {} steps ({})", compared(found), steps,
                      why.text()));
}

Status search_limit(const StepSearch& search, Outcome outcome, double t0, const Limits& limits) {
  const std::string name = search.name + ", in search of a step";
  return outcome == Outcome::step_limit ? step_limit(name, t0, limits.steps)
                                        : time_limit(name, t0, limits.seconds);
}

}  // namespace nlmech::ivp::detail
