#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "chapters/two_body_series/series/accuracy.hpp"
#include "common/python/module.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::python {
namespace {

using chapters::two_body_series::accuracy_of;
using orbit::Gravity;
using orbit::State;

using Vector = orbit::Vector3<double>;

State state_at(const double* p) { return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}}; }

Gravity gravity_of(double mu, double radius, const std::vector<double>& zonal) {
  Gravity gravity{.mu = mu, .radius = radius};
  if (zonal.size() > gravity.zonal.size())
    throw invalid_argument("zonal: {} numbers; J2 to J6 at most", zonal.size());
  std::ranges::copy(zonal, gravity.zonal.begin());
  return gravity;
}

/// Texts, which share one object for the empty ones.
py::list list_of(const std::vector<std::string>& texts, const char* empty) {
  const py::str shared(empty);
  py::list all(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) all[i] = texts[i].empty() ? shared : py::str(texts[i]);
  return all;
}

/// Propagated orbits.
struct Orbits {
  bool verify;            ///< whether states are compared with Kepler's solution
  py::ssize_t rows;       ///< of each orbit: start, inner times, end
  py::array_t<double> x;  ///< orbit, row, component; NaN where an orbit did not come
  py::array_t<double> t;  ///< time of each orbit's last state
  std::vector<std::string> names = {}, sentences = {};  ///< outcome and what is wrong; empty after success

  /// Writes a state and compares it with Kepler's solution, as the command does.
  void add(std::size_t i, py::ssize_t row, double time, const State& s,
           const orbit::PropagationRequest& orbit, double tolerance) {
    double* const p = x.mutable_data() + 6 * (static_cast<py::ssize_t>(i) * rows + row);
    std::copy_n(s.position.data(), 3, p);
    std::copy_n(s.velocity.data(), 3, p + 3);
    if (!verify || time == 0) return;
    const auto accuracy = accuracy_of(s, orbit.start, time, orbit.gravity, {"series", tolerance});
    if (!accuracy.status.ok()) {
      fail(i, accuracy.status);
    } else if (accuracy.off > 0 && names[i].empty()) {
      names[i] = chapters::two_body_series::low_accuracy;
      sentences[i] = accuracy.sentence;
    }
  }
  void fail(std::size_t i, const Status& status) {
    names[i] = to_string(status.outcome());
    sentences[i] = status.sentence();
  }
};

/// Propagates orbits and writes their rows. @param first index of the first one
void propagate(std::span<const orbit::PropagationRequest> orbits, std::size_t first, double every,
               const orbit::TaylorEnsemble& method, double seconds, Orbits& all) {
  orbit::InnerRows inner;
  if (std::isfinite(every)) {
    inner = {every, [&](std::size_t i, double t, const State& s) {
               all.add(first + i, std::lround(std::abs(t) / every), t, s, orbits[i], method.tolerance);
             }};
  }
  const auto ends = propagate_all(orbits, method, inner, {.seconds = seconds});
  share_out(orbits.size(), 64, method.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      all.t.mutable_data()[first + i] = ends[i].t;
      all.add(first + i, 0, 0, orbits[i].start, orbits[i], method.tolerance);
      all.add(first + i, all.rows - 1, ends[i].t, ends[i].x, orbits[i], method.tolerance);
      if (!ends[i].status.ok()) all.fail(first + i, ends[i].status);
    }
  });
}

/// Propagates rows of states, each with its end and mu, NaN for the Earth's.
py::tuple propagate(const Doubles& states, const Doubles& until, const Doubles& mu, Gravity field,
                    double every, py::ssize_t rows, const orbit::TaylorEnsemble& method, double seconds,
                    bool verify, const py::object& progress) {
  const auto count = static_cast<std::size_t>(states.shape(0));
  std::vector<orbit::PropagationRequest> orbits;
  for (std::size_t i = 0; i < count; ++i) {
    const State start = state_at(states.data() + 6 * i);
    const bool is_earth = std::isnan(mu.data()[i]);
    if (const std::string why = is_earth ? chapters::two_body_series::inside_the_earth(start) : "";
        !why.empty())
      throw input_error("states, row {}: {}", i, why);
    field.mu = is_earth ? orbit::earth().mu : mu.data()[i];
    orbits.push_back({start, until.data()[i], field});
  }
  Orbits all{verify, rows, py::array_t<double>({states.shape(0), rows, py::ssize_t{6}}),
             py::array_t<double>(states.shape(0))};
  all.names.resize(count);
  all.sentences.resize(count);
  std::fill_n(all.x.mutable_data(), all.x.size(), std::numeric_limits<double>::quiet_NaN());
  unlocked(progress, [&](Job& job) {
    const Stopwatch watch;
    const std::span<const orbit::PropagationRequest> left(orbits);
    // Results do not depend on the portions, which grow until one takes a twentieth of a second.
    for (std::size_t i = 0, portion = 1024; i < count;) {
      const auto some = left.subspan(i, std::min(portion, count - i));
      const double begin = watch.seconds();
      propagate(some, i, every, method, std::max(0.0, seconds - begin), all);
      i += some.size();
      if (!job.reached(static_cast<double>(i) / static_cast<double>(count))) break;
      if (watch.seconds() - begin < 0.05) portion *= 2;
    }
    return true;
  });
  return py::make_tuple(all.x, all.t, list_of(all.names, "success"), list_of(all.sentences, ""));
}

/// Lambert arcs between rows of positions: velocities, misses, outcomes and sentences.
py::tuple lambert(const Doubles& from, const Doubles& to, const Doubles& time, const Gravity& gravity,
                  const orbit::LambertArc& arc, const std::optional<std::array<double, 3>>& normal,
                  int threads) {
  const auto count = static_cast<std::size_t>(from.shape(0));
  py::array_t<double> v1({from.shape(0), py::ssize_t{3}}), v2({from.shape(0), py::ssize_t{3}}),
      miss(from.shape(0));
  double *const a = v1.mutable_data(), *const b = v2.mutable_data(), *const off = miss.mutable_data();
  std::vector<std::string> names(count), sentences(count);
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
        names[i] = to_string(transfer.status.outcome());
        sentences[i] = transfer.status.sentence();
      }
    });
    return true;
  });
  return py::make_tuple(v1, v2, miss, names, sentences);
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
  module.def("propagate",
             [](const Doubles& states, const Doubles& until, const Doubles& mu, double radius,
                const std::vector<double>& zonal, double every, py::ssize_t rows, double tolerance,
                int threads, double seconds, bool verify, const py::object& progress) {
               return propagate(states, until, mu, gravity_of(1, radius, zonal), every, rows,
                                {.tolerance = tolerance, .threads = threads}, seconds, verify, progress);
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
