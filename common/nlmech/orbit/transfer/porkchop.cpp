#include "nlmech/orbit/transfer/porkchop.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert_core.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::orbit {
namespace {

using detail::Arrived;
using detail::Chord;
using detail::Span;

void require(bool fine, const std::string& text) {
  if (!fine) throw std::invalid_argument("porkchop: " + text);
}

void check_window(const Window& w, const char* which) {
  require(std::isfinite(w.first) && std::isfinite(w.last) && w.first <= w.last,
          fmt::format("the window of {} must be two finite times in order, not {} to {}", which, w.first,
                      w.last));
  require(w.count >= 1, fmt::format("the number of {} must be at least 1, not {}", which, w.count));
}

void check_all(const PorkchopProblem& p, int threads) {
  check(Gravity{.mu = p.mu});
  check(p.from.state, "porkchop, the body left");
  check(p.to.state, "porkchop, the body reached");
  for (const double size : {p.mu, p.from.state.position.stableNorm(), p.to.state.position.stableNorm()})
    require(
        size >= 1e-100 && size <= 1e100,
        fmt::format("mu and distances must be from 1e-100 to 1e100, not {:.6g}; choose other units", size));
  require(std::isfinite(p.from.epoch) && std::isfinite(p.to.epoch), "the epochs must be finite");
  check_window(p.departures, "departures");
  check_window(p.arrivals, "arrivals");
  require(static_cast<std::int64_t>(p.departures.count) * p.arrivals.count <=
              std::numeric_limits<std::int32_t>::max(),
          fmt::format("{} x {} cells are too many", p.departures.count, p.arrivals.count));
  require(p.most_revolutions >= 0 && p.most_revolutions <= 1000,
          fmt::format("the number of revolutions must be from 0 to 1000, not {}", p.most_revolutions));
  require(threads >= 0 && threads <= 1024,
          fmt::format("the number of threads must be from 0 to 1024, not {}", threads));
}

/// States of a body at the times of a window.
[[nodiscard]] Status follow(const Ephemeris& body, double mu, const Window& window,
                            std::vector<double>& times, std::vector<State>& states) {
  for (int k = 0; k < window.count; ++k) {
    times.push_back(window.at(k));
    KeplerSolution at = propagate_kepler(body.state, times.back() - body.epoch, mu);
    if (!at.status.ok()) return at.status;
    states.push_back(at.state);
  }
  return {};
}

/// Counters of a thread.
struct Counts {
  std::int64_t arcs = 0, evaluations = 0, lost = 0;
};

/// The best transfer of one cell.
class Search {
 public:
  Search(double mu, int most_revolutions) : mu_(mu), most_revolutions_(most_revolutions) {}

  [[nodiscard]] PorkchopCell best(const State& from, const State& to, double time) {
    constexpr double none = std::numeric_limits<double>::infinity();
    cell_ = {none, none, -1, false, LambertBranch::low};
    least_ = none;
    if (!(time > 0)) return cell_;
    const Vector3<double> normal = angular_momentum(from);
    Chord chord;
    Span span = detail::make_chord(from.position, to.position, mu_, nullptr, chord);
    if (span == Span::opposite) span = detail::make_chord(from.position, to.position, mu_, &normal, chord);
    if (span == Span::same) try_whole_revolutions(from, to, time);
    if (span == Span::same || !chord.ahead1.allFinite()) return cell_;
    for (const bool long_way : {false, true}) {
      if (long_way) chord.turn();
      for (int m = 0; m <= most_revolutions_; ++m) {
        if (!try_arc(chord, from, to, time, {long_way, m, LambertBranch::low})) break;
        if (m > 0) (void)try_arc(chord, from, to, time, {long_way, m, LambertBranch::high});
      }
    }
    return cell_;
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool try_arc(const Chord& chord, const State& from, const State& to, double time,
                             const LambertArc& arc) {
    detail::Found found;
    const Arrived arrived = detail::find_x(chord, time * chord.rate, arc.revolutions, arc.branch, found);
    counts_.evaluations += found.iterations;
    if (arrived == Arrived::no_such_arc) return false;
    Vector3<double> v1, v2;
    detail::velocities(chord, found.x, v1, v2);
    const Vector3<double> d1 = v1 - from.velocity, d2 = v2 - to.velocity;
    const double departure = std::sqrt(d1.dot(d1)), arrival = std::sqrt(d2.dot(d2)),
                 sum = departure + arrival;
    ++counts_.arcs;
    if (arrived == Arrived::lost || !std::isfinite(sum)) {
      ++counts_.lost;
      return false;
    }
    keep({departure, arrival, arc.revolutions, arc.long_way, arc.branch});
    return true;
  }
  /// Return to the same position after whole revolutions: the period gives the speed, and any direction is
  /// possible. Uses that of the departure body.
  void try_whole_revolutions(const State& from, const State& to, double time) {
    constexpr double close = 64 * std::numeric_limits<double>::epsilon();
    const double r = from.position.norm(), speed = from.velocity.norm();
    if (!((to.position - from.position).norm() <= close * r) ||
        !(angular_momentum(from).norm() > close * r * speed))
      return;
    for (int m = 1; m <= most_revolutions_; ++m) {
      const double turn = time / m / (2 * std::numbers::pi), axis = std::cbrt(mu_ * turn * turn);
      const double square = mu_ * (2 / r - 1 / axis);
      if (!(square > 0)) return;
      ++counts_.arcs;
      const Vector3<double> v = std::sqrt(square) / speed * from.velocity;
      keep({(v - from.velocity).norm(), (v - to.velocity).norm(), m, false, LambertBranch::low});
    }
  }
  void keep(const PorkchopCell& cell) {
    if (!(cell.v_departure + cell.v_arrival < least_)) return;
    least_ = cell.v_departure + cell.v_arrival;
    cell_ = cell;
  }

  double mu_;
  int most_revolutions_;
  PorkchopCell cell_;
  double least_ = 0;
  Counts counts_;
};

/// Rows are distributed one by one; results do not depend on the thread.
[[nodiscard]] Counts fill(const PorkchopProblem& problem, int threads, const std::vector<State>& left,
                          const std::vector<State>& reached, Porkchop& grid) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Counts total;
  const auto work = [&] {
    Search search(problem.mu, problem.most_revolutions);
    for (std::size_t i = next++; i < left.size(); i = next++) {
      PorkchopCell* row = grid.cells.data() + i * reached.size();
      for (std::size_t j = 0; j < reached.size(); ++j)
        row[j] = search.best(left[i], reached[j], grid.arrivals[j] - grid.departures[i]);
    }
    const std::lock_guard lock(mutex);
    total.arcs += search.counts().arcs;
    total.evaluations += search.counts().evaluations;
    total.lost += search.counts().lost;
  };
  in_threads(threads_for(threads), work);
  return total;
}

}  // namespace

Porkchop porkchop(const PorkchopProblem& problem, int threads) {
  check_all(problem, threads);
  const Stopwatch watch;
  Porkchop grid;
  std::vector<State> left, reached;
  grid.status = follow(problem.from, problem.mu, problem.departures, grid.departures, left);
  if (grid.status.ok())
    grid.status = follow(problem.to, problem.mu, problem.arrivals, grid.arrivals, reached);
  if (!grid.status.ok()) return grid;
  grid.cells.resize(left.size() * reached.size());
  const Counts counts = fill(problem, threads, left, reached, grid);
  grid.statistics.steps = counts.arcs;
  grid.statistics.right_hand_sides = counts.evaluations;
  grid.statistics.seconds = watch.seconds();
  if (counts.lost > 0) {
    grid.status = failed_with(Outcome::outside_validity,
                              "porkchop: {} arcs have times of flight that velocities in double precision do "
                              "not determine; choose windows in proportion to the periods of the orbits",
                              counts.lost);
  }
  return grid;
}

}  // namespace nlmech::orbit
