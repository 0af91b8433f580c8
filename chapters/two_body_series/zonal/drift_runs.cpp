#include "chapters/two_body_series/zonal/drift_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

using Wide = orbit::BasicState<long double>;

Wide widened(const orbit::State& s) {
  return {s.position.cast<long double>(), s.velocity.cast<long double>()};
}

/// 10, 18, 32, 56, 100, ... and the last.
std::vector<int> checkpoints(int orbits) {
  std::vector<int> all;
  for (int i = 4; std::pow(10, i / 4.0) < 0.99 * orbits; ++i)
    all.push_back(static_cast<int>(std::lround(std::pow(10, i / 4.0))));
  all.push_back(orbits);
  return all;
}

/// Squares of the errors of one start, added up.
class Track {
 public:
  Track(const orbit::State& start, Drift& sums)
      : start_(widened(start)), energy_(orbit::energy(start_, 1.0L)), sums_(sums) {}

  /// When the next checkpoint is, in orbits; none left: false.
  [[nodiscard]] bool waits() const { return next_ < sums_.orbits.size(); }
  [[nodiscard]] int orbits() const { return sums_.orbits[next_]; }
  /// The state at a checkpoint.
  void add(double t, const orbit::State& state) {
    const Wide s = widened(state);
    const long double energy = orbit::energy(s, 1.0L) / energy_ - 1;
    const orbit::Vector3<long double> miss =
        s.position - orbit::kepler_state<long double>(start_, t, 1).position;
    sums_.energy[next_] += static_cast<double>(energy * energy);
    sums_.position[next_] += static_cast<double>(miss.dot(miss));
    ++next_;
  }

 private:
  Wide start_;
  long double energy_;
  Drift& sums_;
  std::size_t next_ = 0;
};

/// The step of a share of an orbit, rounded to 30 bits so that multiples of it are exact.
double step_of(int steps) { return std::round(revolution / steps * 0x1p30) * 0x1p-30; }

Status run_fixed(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const double step = step_of(task.steps);
  const orbit::FixedContinuation method{.step = step,
                                        .order = task.order,
                                        .compensated = task.compensated,
                                        .true_division = task.true_division};
  const auto observe = [&](const orbit::Step& s) {
    if (track.waits() && s.index == std::int64_t{task.steps} * track.orbits()) track.add(s.t1, s.x1);
    return true;
  };
  return orbit::propagate(start, 0, step * task.steps * orbits, orbit::Gravity{}, method, observe).status;
}

Status run_adaptive(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const orbit::AnalyticContinuation method{.tolerance = task.tolerance, .compensated = task.compensated};
  const auto observe = [&](const orbit::Step& s) {
    while (track.waits() && s.t1 >= revolution * track.orbits()) {
      const double t = revolution * track.orbits();
      orbit::State x;
      s.dense.at(t, x);
      track.add(t, x);
    }
    return true;
  };
  return orbit::propagate(start, 0, revolution * orbits, orbit::Gravity{}, method, observe).status;
}

}  // namespace

double Drift::slope(const std::vector<int>& orbits, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    if (orbits[i] < 100) continue;
    const double a = std::log(orbits[i]), b = std::log(errors[i]);
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

Drift drift_of(const DriftTask& task, int orbits) {
  Drift d{checkpoints(orbits), {}, {}};
  d.energy.assign(d.orbits.size(), 0);
  d.position = d.energy;
  for (int phase = 0; phase < task.phases; ++phase) {
    const orbit::State start = on_ellipse(task.eccentricity, revolution * (phase + 0.3) / task.phases);
    Track track(start, d);
    const Status status =
        task.order > 0 ? run_fixed(task, start, track, orbits) : run_adaptive(task, start, track, orbits);
    if (!status.ok()) throw Failure(status);
  }
  for (auto* errors : {&d.energy, &d.position}) {
    for (double& error : *errors) error = std::sqrt(error / task.phases);
  }
  return d;
}

}  // namespace nlmech::chapters::two_body_series
