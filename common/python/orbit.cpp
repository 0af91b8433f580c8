#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "chapters/two_body_series/series/accuracy.hpp"
#include "common/python/module.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/orbit/transition.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::python {
namespace {

using orbit::State;
using orbit::TransitionMatrix;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

State state_of(const Eigen::VectorXd& x) { return {x.head<3>(), x.tail<3>()}; }

/// Reference radius, and zonal coefficients from J2.
using Zonal = std::pair<double, std::vector<double>>;

orbit::Gravity gravity_of(double mu, const Zonal& field) {
  const auto& [radius, zonal] = field;
  orbit::Gravity gravity{.mu = mu, .radius = radius};
  if (zonal.size() > gravity.zonal.size())
    throw invalid_argument("zonal: {} numbers; J2 to J6 at most", zonal.size());
  std::ranges::copy(zonal, gravity.zonal.begin());
  return gravity;
}

/// Statuses of orbits that are no plain success, by index.
std::map<std::size_t, StatusText> faults_in(const std::vector<StatusText>& all) {
  std::map<std::size_t, StatusText> faults;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].first.empty()) faults.emplace(i, all[i]);
  }
  return faults;
}

/// Propagated orbits. Each is written by one thread at a time.
struct Orbits {
  std::vector<orbit::PropagationRequest> requests;
  std::vector<double> times;  ///< of rows from start to end; or none, and the end alone makes a row
  double every;               ///< time between them
  orbit::TaylorEnsemble method;
  bool verify;           ///< whether states are compared with Kepler's solution
  Rows<double, 6> x;     ///< a row for each orbit and time; NaN where an orbit does not come
  Rows<double, 36> phi;  ///< d(state)/d(initial state), row by row; without rows no matrices are wanted
  Eigen::VectorXd t;     ///< of each orbit's last state
  std::vector<StatusText> status;  ///< empty: success

  /// Number of rows of an orbit.
  [[nodiscard]] std::size_t rows() const { return std::max<std::size_t>(times.size(), 1); }

  void put(std::size_t i, std::size_t row, const State& s, const TransitionMatrix& transition) {
    const auto at = static_cast<Eigen::Index>(i * rows() + row);
    x.row(at) << s.position.transpose(), s.velocity.transpose();
    if (phi.rows() > 0) Eigen::Map<TransitionMatrix>(phi.row(at).data()) = transition.transpose();
  }
  /// Compares a state with Kepler's solution, as the command does. False if no digit is right.
  bool check(std::size_t i, double at, const State& s) {
    if (!verify || at == 0) return true;
    const auto accuracy = chapters::two_body_series::accuracy_of(
        s, requests[i].start, at, requests[i].gravity, {"series", method.tolerance});
    if (!accuracy.status.ok())
      status[i] = text_of(accuracy.status);
    else if (accuracy.off > 0 && status[i].first.empty())  // of several remarks the first stays
      status[i] = StatusText(chapters::two_body_series::low_accuracy, accuracy.sentence);
    return accuracy.status.ok();
  }
  /// Row of the last state.
  void end(std::size_t i, const orbit::Solution& solution, const TransitionMatrix& transition) {
    t[static_cast<Eigen::Index>(i)] = solution.t;
    put(i, rows() - 1, solution.x, transition);
    if (solution.status.ok())
      check(i, solution.t, solution.x);
    else if (solution.status.outcome() != Outcome::interrupted)  // by a row without a right digit
      status[i] = text_of(solution.status);
  }
  void propagate(std::size_t first, std::size_t count, double seconds);
  void propagate_with_transition(std::size_t first, std::size_t count, double seconds);
};

/// Propagates @p count orbits from the one with the index @p first.
void Orbits::propagate(std::size_t first, std::size_t count, double seconds) {
  const TransitionMatrix none = TransitionMatrix::Identity();
  orbit::InnerRows inner;
  if (rows() > 1) {
    inner = {every, [&](std::size_t i, double at, const State& s) {
               put(first + i, static_cast<std::size_t>(std::lround(std::abs(at) / every)), s, none);
               check(first + i, at, s);
             }};
  }
  const auto ends =
      propagate_all(std::span(requests).subspan(first, count), method, inner, {.seconds = seconds});
  share_out(count, 64, method.threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      put(first + i, 0, requests[first + i].start, none);
      end(first + i, ends[i], none);
    }
  });
}

/// The same one by one, with state-transition matrices.
void Orbits::propagate_with_transition(std::size_t first, std::size_t count, double seconds) {
  const Stopwatch watch;
  const std::span inner = std::span(times).subspan(rows() > 1 ? 1 : 0, rows() > 1 ? rows() - 2 : 0);
  share_out(count, 4, method.threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = first + from; i < first + to; ++i) {
      const auto& [start, until, gravity] = requests[i];
      orbit::TransitionSolution run{{0, start, {}, {}}};
      put(i, 0, start, run.transition);
      const auto add = [this, i, row = std::size_t{0}](double at, const State& s,
                                                       const TransitionMatrix& transition) mutable {
        put(i, ++row, s, transition);
        return check(i, at, s);
      };
      if (!start.position.allFinite() || !start.velocity.allFinite() || !std::isfinite(until))
        run.end.status = failed_with(Outcome::non_finite, "states, row {}: a number is not finite", i);
      else if (until != 0)
        run = propagate_transition(start, 0, until, gravity, {.tolerance = method.tolerance}, inner, add,
                                   {.seconds = std::max(0.0, seconds - watch.seconds())});
      end(i, run.end, run.transition);
    }
  });
}

/// Orbits of rows of states, each with its end and mu, NaN for the Earth's.
std::vector<orbit::PropagationRequest> requests_of(const Rows<double, 6>& states,
                                                   const Eigen::VectorXd& until, const Eigen::VectorXd& mu,
                                                   const Zonal& field) {
  std::vector<orbit::PropagationRequest> all;
  for (Eigen::Index i = 0; i < states.rows(); ++i) {
    const bool is_earth = std::isnan(mu[i]);
    all.push_back(
        {state_of(states.row(i)), until[i], gravity_of(is_earth ? orbit::earth().mu : mu[i], field)});
    const std::string why = is_earth ? chapters::two_body_series::inside_the_earth(all.back().start) : "";
    if (!why.empty()) throw input_error("states, row {}: {}", i, why);
  }
  return all;
}

/// States, end times, matrices, faults. @param times, every see Orbits
py::tuple propagate(const Rows<double, 6>& states, const Eigen::VectorXd& until, const Eigen::VectorXd& mu,
                    const Zonal& field, double every, const std::vector<double>& times, double tolerance,
                    int threads, double seconds, bool verify, bool stm, const py::object& progress) {
  const Eigen::Index rows = states.rows() * std::max<Eigen::Index>(std::ssize(times), 1);
  Orbits all{.requests = requests_of(states, until, mu, field),
             .times = times,
             .every = every,
             .method = {.tolerance = tolerance, .threads = threads},
             .verify = verify,
             .x = Rows<double, 6>::Constant(rows, 6, unknown),
             .phi = Rows<double, 36>::Constant(stm ? rows : 0, 36, unknown),
             .t = Eigen::VectorXd(states.rows()),
             .status = std::vector<StatusText>(static_cast<std::size_t>(states.rows()))};
  unlocked(progress, [&](Job& job) {
    const Stopwatch watch;
    // Results do not depend on the portions. Larger ones would take their memory anew from the system.
    constexpr std::size_t largest = 1024;
    const std::size_t count = all.requests.size();
    for (std::size_t i = 0, portion = stm ? 16 : largest; i < count;) {
      const std::size_t some = std::min(portion, count - i);
      const double begin = watch.seconds(), rest = std::max(0.0, seconds - begin);
      if (stm)
        all.propagate_with_transition(i, some, rest);
      else
        all.propagate(i, some, rest);
      i += some;
      if (!job.reached(static_cast<double>(i) / static_cast<double>(count))) break;
      if (watch.seconds() - begin < 0.05) portion = std::min(4 * portion, largest);
    }
  });
  return py::make_tuple(std::move(all.x), std::move(all.t), std::move(all.phi), faults_in(all.status));
}

/// Lambert arcs between rows of positions: velocities, misses, faults.
auto lambert(const Rows<double, 3>& from, const Rows<double, 3>& to, const Eigen::VectorXd& time, double mu,
             const Zonal& field, bool long_way, int revolutions, bool high,
             const std::optional<std::array<double, 3>>& normal, int threads) {
  Rows<double, 3> v1(from.rows(), 3), v2(from.rows(), 3);
  Eigen::VectorXd miss(from.rows());
  std::vector<StatusText> status(static_cast<std::size_t>(from.rows()));
  const orbit::LambertArc arc{long_way, revolutions,
                              high ? orbit::LambertBranch::high : orbit::LambertBranch::low};
  const orbit::Gravity gravity = gravity_of(mu, field);
  std::optional<orbit::Vector3<double>> plane;
  if (normal) plane.emplace(normal->data());
  share_out(status.size(), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
      const orbit::Transfer found =
          corrected_transfer({from.row(i), to.row(i), time[i], gravity, plane}, arc);
      v1.row(i) = found.v1;
      v2.row(i) = found.v2;
      miss[i] = found.miss;
      if (!found.status.ok()) status[static_cast<std::size_t>(i)] = text_of(found.status);
    }
  });
  return std::tuple(std::move(v1), std::move(v2), std::move(miss), faults_in(status));
}

/// First and last time, and number of times.
using Window = std::tuple<double, double, int>;

/// Times of departure and arrival; speeds there and revolutions, a row for each departure.
auto porkchop(const std::pair<Eigen::VectorXd, Eigen::VectorXd>& states,
              const std::pair<double, double>& epochs, double mu, const Window& departures,
              const Window& arrivals, int revolutions, int threads) {
  const auto window = [](const Window& w) {
    return orbit::Window{std::get<0>(w), std::get<1>(w), std::get<2>(w)};
  };
  const orbit::Porkchop grid = orbit::porkchop({.mu = mu,
                                                .from = {state_of(states.first), epochs.first},
                                                .to = {state_of(states.second), epochs.second},
                                                .departures = window(departures),
                                                .arrivals = window(arrivals),
                                                .most_revolutions = revolutions},
                                               threads);
  if (!grid.status.ok()) throw Failure(grid.status);
  const auto rows = std::ssize(grid.departures), columns = std::ssize(grid.arrivals);
  Rows<> leave(rows, columns), arrive(rows, columns);
  Rows<std::int32_t> turns(rows, columns);
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const orbit::PorkchopCell& cell = grid.cells[i];
    leave.data()[i] = cell.exists() ? cell.v_departure : unknown;
    arrive.data()[i] = cell.exists() ? cell.v_arrival : unknown;
    turns.data()[i] = cell.revolutions;
  }
  return std::tuple(grid.departures, grid.arrivals, std::move(leave), std::move(arrive), std::move(turns));
}

}  // namespace

void add_orbit(py::module_& module) {
  module.attr("EARTH_MU") = orbit::earth().mu;
  module.def("propagate", &propagate);
  module.def("lambert", &lambert, Unlocked());
  module.def("porkchop", &porkchop, Unlocked());
}

}  // namespace nlmech::python
