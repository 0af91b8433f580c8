#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "chapters/two_body_series/series/accuracy.hpp"
#include "common/python/module.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/orbit/transition.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::python {
namespace {

using chapters::two_body_series::accuracy_of;
using orbit::Gravity;
using orbit::State;
using orbit::TransitionMatrix;

using Vector = orbit::Vector3<double>;

State state_at(const double* p) { return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}}; }

Gravity gravity_of(double mu, double radius, const std::vector<double>& zonal) {
  Gravity gravity{.mu = mu, .radius = radius};
  if (zonal.size() > gravity.zonal.size())
    throw invalid_argument("zonal: {} numbers; J2 to J6 at most", zonal.size());
  std::ranges::copy(zonal, gravity.zonal.begin());
  return gravity;
}

/// Outcomes and sentences of orbits that are no plain success, by index.
struct Faults {
  std::map<std::size_t, std::pair<std::string, std::string>> all;
  std::mutex mutex;

  void fail(std::size_t i, const Status& status) {
    const std::lock_guard lock(mutex);
    all[i] = {std::string(to_string(status.outcome())), status.sentence()};
  }
  /// Of several remarks on an orbit the first stays.
  void remark(std::size_t i, std::string_view outcome, const std::string& sentence) {
    const std::lock_guard lock(mutex);
    all.try_emplace(i, outcome, sentence);
  }
};

/// Where propagated orbits are written.
struct Orbits {
  const orbit::TaylorEnsemble& method;
  bool verify;       ///< whether states are compared with Kepler's solution
  std::size_t rows;  ///< of each orbit: start, inner times, end; or the end alone
  double* state;     ///< orbit, row, component
  double* time;      ///< of each orbit's last state
  double* matrix;    ///< orbit, row, d(state)/d(initial state); not written without matrices
  Faults& faults;

  void put(std::size_t i, std::size_t row, const State& s, const TransitionMatrix* transition) {
    const std::size_t at = i * rows + row;
    std::copy_n(s.position.data(), 3, state + 6 * at);
    std::copy_n(s.velocity.data(), 3, state + 6 * at + 3);
    if (transition != nullptr) Eigen::Map<TransitionMatrix>(matrix + 36 * at) = transition->transpose();
  }
  /// Compares a state with Kepler's solution, as the command does. False if no digit is right.
  bool check(std::size_t i, double at, const State& s, const orbit::PropagationRequest& orbit) {
    if (!verify || at == 0) return true;
    const auto accuracy = accuracy_of(s, orbit.start, at, orbit.gravity, {"series", method.tolerance});
    if (!accuracy.status.ok())
      faults.fail(i, accuracy.status);
    else if (accuracy.off > 0)
      faults.remark(i, chapters::two_body_series::low_accuracy, accuracy.sentence);
    return accuracy.status.ok();
  }
  void end(std::size_t i, const orbit::Solution& solution, const orbit::PropagationRequest& orbit,
           const TransitionMatrix* transition) {
    time[i] = solution.t;
    put(i, rows - 1, solution.x, transition);
    if (solution.status.ok())
      check(i, solution.t, solution.x, orbit);
    else if (solution.status.outcome() != Outcome::interrupted)  // by a row without a right digit
      faults.fail(i, solution.status);
  }
};

/// Propagates orbits and writes their rows. @param first index of the first one
void propagate(std::span<const orbit::PropagationRequest> orbits, std::size_t first, double every,
               double seconds, Orbits& all) {
  orbit::InnerRows inner;
  if (all.rows > 1) {
    inner = {every, [&](std::size_t i, double t, const State& s) {
               all.put(first + i, static_cast<std::size_t>(std::lround(std::abs(t) / every)), s, nullptr);
               all.check(first + i, t, s, orbits[i]);
             }};
  }
  const auto ends = propagate_all(orbits, all.method, inner, {.seconds = seconds});
  share_out(orbits.size(), 64, all.method.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      all.put(first + i, 0, orbits[i].start, nullptr);
      all.end(first + i, ends[i], orbits[i], nullptr);
    }
  });
}

/// The same one by one, with state-transition matrices. @param inner times of rows between start and end
void propagate_with_transition(std::span<const orbit::PropagationRequest> orbits, std::size_t first,
                               std::span<const double> inner, double seconds, Orbits& all) {
  const Stopwatch watch;
  share_out(orbits.size(), 4, all.method.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const orbit::PropagationRequest& orbit = orbits[i];
      orbit::TransitionSolution run{{0, orbit.start, {}, {}}};
      all.put(first + i, 0, orbit.start, &run.transition);
      const auto add = [&, row = std::size_t{0}](double t, const State& s,
                                                 const TransitionMatrix& phi) mutable {
        all.put(first + i, ++row, s, &phi);
        return all.check(first + i, t, s, orbit);
      };
      if (!orbit.start.position.allFinite() || !orbit.start.velocity.allFinite() ||
          !std::isfinite(orbit.until))
        run.end.status =
            failed_with(Outcome::non_finite, "states, row {}: a number is not finite", first + i);
      else if (orbit.until != 0)
        run = propagate_transition(orbit.start, 0, orbit.until, orbit.gravity,
                                   {.tolerance = all.method.tolerance}, inner, add,
                                   {.seconds = std::max(0.0, seconds - watch.seconds())});
      all.end(first + i, run.end, orbit, &run.transition);
    }
  });
}

/// Propagates rows of states, each with its end and mu, NaN for the Earth's.
/// @param times of rows from start to end; or none, and the end alone makes a row
py::tuple propagate(const Doubles& states, const Doubles& until, const Doubles& mu, Gravity field,
                    double every, const std::vector<double>& times, const orbit::TaylorEnsemble& method,
                    double seconds, bool verify, bool stm, const py::object& progress) {
  const auto count = static_cast<std::size_t>(states.shape(0));
  const double *const from = states.data(), *const end = until.data(), *const own_mu = mu.data();
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isnan(own_mu[i])) continue;
    if (const std::string why = chapters::two_body_series::inside_the_earth(state_at(from + 6 * i));
        !why.empty())
      throw input_error("states, row {}: {}", i, why);
  }
  const std::size_t rows = std::max<std::size_t>(times.size(), 1);
  const std::span inner = std::span(times).subspan(rows > 1 ? 1 : 0, rows > 1 ? rows - 2 : 0);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // where an orbit does not come
  py::array_t<double> x({count, rows, std::size_t{6}}), t(static_cast<py::ssize_t>(count)),
      phi({stm ? count : 0, rows, std::size_t{6}, std::size_t{6}});
  std::fill_n(x.mutable_data(), x.size(), unknown);
  std::fill_n(phi.mutable_data(), phi.size(), unknown);
  Faults faults;
  Orbits all{method, verify, rows, x.mutable_data(), t.mutable_data(), phi.mutable_data(), faults};
  unlocked(progress, [&](Job& job) {
    const Stopwatch watch;
    std::vector<orbit::PropagationRequest> some;
    // Results do not depend on the portions. Larger ones would take their memory anew from the system.
    constexpr std::size_t largest = 1024;
    for (std::size_t i = 0, portion = stm ? 16 : largest; i < count;) {
      some.clear();
      for (std::size_t k = i; k < std::min(i + portion, count); ++k) {
        field.mu = std::isnan(own_mu[k]) ? orbit::earth().mu : own_mu[k];
        some.push_back({state_at(from + 6 * k), end[k], field});
      }
      const double begin = watch.seconds(), rest = std::max(0.0, seconds - begin);
      if (stm)
        propagate_with_transition(some, i, inner, rest, all);
      else
        propagate(some, i, every, rest, all);
      i += some.size();
      if (!job.reached(static_cast<double>(i) / static_cast<double>(count))) break;
      if (watch.seconds() - begin < 0.05) portion = std::min(4 * portion, largest);
    }
    return true;
  });
  return py::make_tuple(x, t, stm ? py::object(phi) : py::none(), faults.all);
}

/// Lambert arcs between rows of positions: velocities, misses and faults.
py::tuple lambert(const Doubles& from, const Doubles& to, const Doubles& time, const Gravity& gravity,
                  const orbit::LambertArc& arc, const std::optional<std::array<double, 3>>& normal,
                  int threads) {
  const auto count = static_cast<std::size_t>(from.shape(0));
  py::array_t<double> v1({from.shape(0), py::ssize_t{3}}), v2({from.shape(0), py::ssize_t{3}}),
      miss(from.shape(0));
  double *const a = v1.mutable_data(), *const b = v2.mutable_data(), *const off = miss.mutable_data();
  Faults faults;
  const auto vector_at = [](const double* p) { return Vector(p[0], p[1], p[2]); };
  unlocked([&] {
    share_out(count, 16, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        orbit::TransferProblem problem{
            vector_at(from.data() + 3 * i), vector_at(to.data() + 3 * i), time.data()[i], gravity, {}};
        if (normal) problem.normal = vector_at(normal->data());
        const orbit::Transfer transfer = corrected_transfer(problem, arc);
        std::copy_n(transfer.v1.data(), 3, a + 3 * i);
        std::copy_n(transfer.v2.data(), 3, b + 3 * i);
        off[i] = transfer.miss;
        if (!transfer.status.ok()) faults.fail(i, transfer.status);
      }
    });
    return true;
  });
  return py::make_tuple(v1, v2, miss, faults.all);
}

using WindowTuple = std::tuple<double, double, int>;

py::tuple porkchop(const std::pair<Doubles, Doubles>& states, const std::pair<double, double>& epochs,
                   double mu, const WindowTuple& departures, const WindowTuple& arrivals, int revolutions,
                   int threads) {
  const auto window = [](const WindowTuple& w) {
    return orbit::Window{std::get<0>(w), std::get<1>(w), std::get<2>(w)};
  };
  const orbit::PorkchopProblem problem{.mu = mu,
                                       .from = {state_at(states.first.data()), epochs.first},
                                       .to = {state_at(states.second.data()), epochs.second},
                                       .departures = window(departures),
                                       .arrivals = window(arrivals),
                                       .most_revolutions = revolutions};
  const orbit::Porkchop grid = unlocked([&] { return orbit::porkchop(problem, threads); });
  if (!grid.status.ok()) raise(grid.status, py::none());
  const auto rows = static_cast<py::ssize_t>(grid.departures.size()),
             columns = static_cast<py::ssize_t>(grid.arrivals.size());
  py::array_t<double> leave({rows, columns}), arrive({rows, columns});
  py::array_t<std::int32_t> turns({rows, columns});
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const orbit::PorkchopCell& cell = grid.cells[i];
    leave.mutable_data()[i] = cell.exists() ? cell.v_departure : std::numeric_limits<double>::quiet_NaN();
    arrive.mutable_data()[i] = cell.exists() ? cell.v_arrival : std::numeric_limits<double>::quiet_NaN();
    turns.mutable_data()[i] = cell.revolutions;
  }
  return py::make_tuple(grid.departures, grid.arrivals, leave, arrive, turns);
}

}  // namespace

void add_orbit(py::module_& module) {
  module.attr("EARTH_MU") = orbit::earth().mu;
  module.def("propagate", [](const Doubles& states, const Doubles& until, const Doubles& mu, double radius,
                             const std::vector<double>& zonal, double every, const std::vector<double>& times,
                             double tolerance, int threads, double seconds, bool verify, bool stm,
                             const py::object& progress) {
    return propagate(states, until, mu, gravity_of(1, radius, zonal), every, times,
                     {.tolerance = tolerance, .threads = threads}, seconds, verify, stm, progress);
  });
  module.def("lambert", [](const Doubles& from, const Doubles& to, const Doubles& time, double mu,
                           double radius, const std::vector<double>& zonal, bool long_way, int revolutions,
                           bool high, const std::optional<std::array<double, 3>>& normal, int threads) {
    return lambert(from, to, time, gravity_of(mu, radius, zonal),
                   {long_way, revolutions, high ? orbit::LambertBranch::high : orbit::LambertBranch::low},
                   normal, threads);
  });
  module.def("porkchop", &porkchop);
}

}  // namespace nlmech::python
