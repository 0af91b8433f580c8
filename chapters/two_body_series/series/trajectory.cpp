#include "chapters/two_body_series/series/trajectory.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "chapters/two_body_series/zonal/zonal_field.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// Collects the rows of a run.
class Rows {
 public:
  explicit Rows(const OrbitRequest& request) : request_(request) { add(0, request.start); }

  /// The asked times up to @p t1, the end of a step or of all. @p state_at gives the state at any of them.
  template <class StateAt>
  void add_up_to(double t1, const StateAt& state_at) {
    if (!request_.every) return;
    double t = next();
    while (is_inner(t) && std::abs(t) <= std::abs(t1)) {
      add(t, state_at(t));
      ++count_;
      t = next();
    }
  }
  /// The last one.
  void finish(const orbit::State& s) {
    if (request_.time != 0) add(request_.time, s);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add(double t, const orbit::State& s) {
    auto out = std::back_inserter(text_);
    fmt::format_to(out, "{:.17g}", t);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, ",{:.17g}", s.position[i]);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, ",{:.17g}", s.velocity[i]);
    text_ += '\n';
  }
  [[nodiscard]] double next() const {
    return std::copysign(static_cast<double>(count_) * *request_.every, request_.time);
  }
  // The end has its own row; rounding of k DT makes no second one.
  [[nodiscard]] bool is_inner(double t) const {
    return std::abs(request_.time) - std::abs(t) > 1e-9 * *request_.every;
  }

  const OrbitRequest& request_;
  std::string text_ = "t,x,y,z,vx,vy,vz\n";
  std::int64_t count_ = 1;
};

/// Units of length and time that are powers of two, in which the start has distance and circular speed near
/// 1: they change no digit.
struct Units {
  explicit Units(const OrbitRequest& r) {
    const int a = std::ilogb(r.start.position.stableNorm());
    const int b = (3 * a - std::ilogb(r.gravity.mu)) / 2;
    length = std::ldexp(1.0, a);
    time = std::ldexp(1.0, b);
    gravity = r.gravity;
    gravity.radius = std::ldexp(r.gravity.radius, -a);
    gravity.mu = std::ldexp(r.gravity.mu, 2 * b - 3 * a);
  }
  [[nodiscard]] ivp::State<6> own(const orbit::State& s) const {
    ivp::State<6> x;
    x << s.position / length, s.velocity * (time / length);
    return x;
  }
  [[nodiscard]] orbit::State users(const ivp::State<6>& x) const {
    return {x.head<3>() * length, x.tail<3>() * (length / time)};
  }
  double length, time;
  orbit::Gravity gravity;
};

}  // namespace

namespace {

/// The data, rounded, determine the end to so many digits; fewer than six are worth a word.
void say_lost_digits(const OrbitRequest& request) {
  const double lost = orbit::kepler_condition(request.start, request.time, request.gravity.mu).position *
                      std::numeric_limits<double>::epsilon();
  if (lost < 1e-6) return;
  scene::tell(fmt::format(
      "two_body_series: the data, rounded to doubles, determine the position at t = {:.6g} to {:.1g} of "
      "the distance",
      request.time, lost));
}

}  // namespace

std::string rows_of_kepler(const OrbitRequest& request) {
  const auto at = [&request](double t) {
    const auto solution = orbit::propagate_kepler(request.start, t, request.gravity.mu);
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.state;
  };
  const orbit::State end = at(request.time);
  Rows rows(request);
  rows.add_up_to(request.time, at);
  rows.finish(end);
  say_lost_digits(request);
  return rows.text();
}

std::string rows_of_series(const OrbitRequest& request) {
  Rows rows(request);
  orbit::Observer observer;
  if (request.every) {
    observer = [&rows](const orbit::Step& step) {
      rows.add_up_to(step.t1, [&step](double t) { return step.at(t); });
      return true;
    };
  }
  const auto end = orbit::propagate(request.start, 0, request.time, request.gravity,
                                    orbit::AnalyticContinuation{.tolerance = request.tolerance}, observer,
                                    {.seconds = request.seconds});
  if (!end.status.ok()) throw Failure(end.status);
  rows.finish(end.x);
  return rows.text();
}

std::string rows_of_rkn1210(const OrbitRequest& request) {
  Rows rows(request);
  if (request.time == 0) return rows.text();
  const Units units(request);
  ivp::Observer<6> observer;
  if (request.every) {
    observer = [&](const ivp::Step<6>& step) {
      rows.add_up_to(step.t1 * units.time, [&](double t) { return units.users(step.at(t / units.time)); });
      return true;
    };
  }
  const auto end = ivp::integrate(
      ivp::System<6>(ZonalField{units.gravity}), units.own(request.start), 0, request.time / units.time,
      ivp::Rkn1210{.relative_tolerance = request.tolerance, .absolute_tolerance = request.tolerance},
      observer, {.seconds = request.seconds});
  if (!end.status.ok()) {
    // The sentence has the time in our units: one with the user's.
    throw Failure(Status::failure(
        end.status.outcome(),
        fmt::format(
            "rkn1210: it ends at t = {:.17g}, a distance of {:.6g} from the centre; loosen the tolerance "
            "{:g}, or use the method series",
            end.t * units.time, units.users(end.x).position.norm(), request.tolerance)));
  }
  rows.finish(units.users(end.x));
  return rows.text();
}

}  // namespace nlmech::chapters::two_body_series
