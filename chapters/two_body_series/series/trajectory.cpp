#include "chapters/two_body_series/series/trajectory.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "chapters/two_body_series/series/accuracy.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// q'' = mu [(-q^3 + q sum_k J_k w_k P'_{k+1}(s)) r - z^ sum_k J_k w_k P'_k(s)] with q = 1/|r|, s = z q and
/// w_k = R^k q^(k+2), see orbit::Expansion. State (x1, x2, x3, v1, v2, v3).
struct ZonalField {
  static constexpr int dimension = 6;  ///< three positions, then three velocities
  orbit::Gravity gravity;              ///< gravity field of the centre

  /// The acceleration at @p r.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3>& r, const Vector<T, 3>& /*v*/, Vector<T, 3>& a) const {
    using std::sqrt;
    const T q = 1 / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]), s = r[2] * q;
    T radial = -(q * q * q), axial = 0 * q;
    // P'_1 = 1, P'_2 = 3 s; k P'_{k+1} = (2 k + 1) s P'_k - (k + 1) P'_{k-1}.
    T below = 1 + 0 * q, slope = 3 * s, w = q * q * q * gravity.radius;  // P'_{k-1}, P'_k and w_{k-1}
    for (int k = 2; k <= gravity.degree(); ++k) {
      const T above = ((2 * k + 1) * s * slope - (k + 1) * below) / k;  // P'_{k+1}
      w = w * q * gravity.radius;
      const double j = gravity.zonal[static_cast<std::size_t>(k - 2)];
      radial = radial + j * w * q * above;
      axial = axial + j * w * slope;
      below = slope;
      slope = above;
    }
    for (int i = 0; i < 3; ++i) a[i] = gravity.mu * radial * r[i];
    a[2] = a[2] - gravity.mu * axial;
  }
  /// The equation in first-order form.
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

/// Collects the rows of a run and the worst accuracy.
class Rows {
 public:
  Rows(const OrbitRequest& request, const ComputedBy& by) : request_(request), by_(by) {
    print(0, request.start);
  }

  /// Adds the rows at the requested times up to @p t1. @param state_at returns the state at a time
  /// @returns false if a row has no digit
  template <class StateAt>
  bool add_up_to(double t1, const StateAt& state_at) {
    if (!request_.every) return true;
    double t = next();
    while (status_.ok() && is_inner(t) && std::abs(t) <= std::abs(t1)) {
      add(t, state_at(t));
      ++count_;
      t = next();
    }
    return status_.ok();
  }
  /// Adds the last row @p s, prints low accuracy to standard error and returns all rows.
  /// @throws Failure if a row has no digit
  [[nodiscard]] std::string finish(const orbit::State& s) {
    if (request_.time != 0) add(request_.time, s);
    if (!status_.ok()) throw Failure(status_);
    if (!worst_.sentence.empty()) scene::print_message(fmt::format("two_body_series: {}", worst_.sentence));
    return std::move(text_);
  }
  /// A failure if a row has no digit.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  void add(double t, const orbit::State& s) {
    Accuracy accuracy = accuracy_of(s, request_.start, t, request_.gravity, by_);
    if (!accuracy.status.ok() && status_.ok()) status_ = accuracy.status;
    if (accuracy.off > worst_.off) worst_ = std::move(accuracy);
    print(t, s);
  }
  void print(double t, const orbit::State& s) {
    auto out = std::back_inserter(text_);
    fmt::format_to(out, "{:.17g}", t);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, ",{:.17g}", s.position[i]);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, ",{:.17g}", s.velocity[i]);
    text_ += '\n';
  }
  [[nodiscard]] double next() const {
    return std::copysign(static_cast<double>(count_) * *request_.every, request_.time);
  }
  // The final time has its own row; k DT equal to it up to rounding has no second one.
  [[nodiscard]] bool is_inner(double t) const {
    return std::abs(request_.time) - std::abs(t) > 1e-9 * *request_.every;
  }

  const OrbitRequest& request_;
  ComputedBy by_;
  std::string text_ = "t,x,y,z,vx,vy,vz\n";
  std::int64_t count_ = 1;
  Accuracy worst_;
  Status status_;
};

/// Advice for long runs about a point mass.
const std::string without_steps =
    "about a point mass --method kepler needs no steps and is exact to rounding";

void say_steps_are_needless(const OrbitRequest& request, std::int64_t steps) {
  if (request.gravity.degree() == 0 && steps > 1'000'000)
    scene::print_message(fmt::format("two_body_series: {} steps; {}", steps, without_steps));
}

/// Units of length and time for initial distance and circular speed near 1. They are powers of two, so that
/// scaling causes no rounding.
struct Units {
  explicit Units(const OrbitRequest& r) {
    const int a = std::ilogb(r.start.position.stableNorm());
    const int b = (3 * a - std::ilogb(r.gravity.mu)) / 2;
    length = std::ldexp(1.0, a);
    time = std::ldexp(1.0, b);
    if (!std::isnormal(length) || !std::isnormal(time) || !std::isnormal(length / time))
      throw Failure(
          failed_with(Outcome::outside_validity,
                      "rkn1210: the distance {:g} and mu = {:g} give units of length and time beyond the "
                      "range of doubles; give the data in other units, or use --method kepler",
                      r.start.position.stableNorm(), r.gravity.mu));
    gravity = r.gravity;
    gravity.radius = std::ldexp(r.gravity.radius, -a);
    gravity.mu = std::ldexp(r.gravity.mu, 2 * b - 3 * a);
  }
  [[nodiscard]] ivp::State own(const orbit::State& s) const {
    ivp::State x(6);
    x << s.position / length, s.velocity * (time / length);
    return x;
  }
  [[nodiscard]] orbit::State users(const ivp::State& x) const {
    return {x.head<3>() * length, x.tail<3>() * (length / time)};
  }
  double length, time;
  orbit::Gravity gravity;
};

}  // namespace

std::string rows_of_kepler(const OrbitRequest& request) {
  const auto at = [&request](double t) {
    const auto solution = orbit::propagate_kepler(request.start, t, request.gravity.mu);
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.state;
  };
  const orbit::State end = at(request.time);
  Rows rows(request, {"kepler", std::nullopt});
  rows.add_up_to(request.time, at);
  return rows.finish(end);
}

std::string rows_of_series(const OrbitRequest& request) {
  Rows rows(request, {"series", request.tolerance});
  orbit::Observer observer;
  if (request.every) {
    observer = [&rows](const orbit::Step& step) {
      return rows.add_up_to(step.t1, [&step](double t) { return step.at(t); });
    };
  }
  const auto end = orbit::propagate(request.start, 0, request.time, request.gravity,
                                    orbit::AnalyticContinuation{.tolerance = request.tolerance}, observer,
                                    {.seconds = request.seconds});
  if (!rows.status().ok()) throw Failure(rows.status());
  if (end.status.outcome() == Outcome::time_limit && request.gravity.degree() == 0)
    throw Failure(failed_with(Outcome::time_limit, "{}; {}", end.status.sentence(), without_steps));
  if (!end.status.ok()) throw Failure(end.status);
  say_steps_are_needless(request, end.statistics.steps);
  return rows.finish(end.x);
}

std::string rows_of_rkn1210(const OrbitRequest& request) {
  Rows rows(request, {"rkn1210", request.tolerance});
  if (request.time == 0) return rows.finish(request.start);
  const Units units(request);
  ivp::Observer observer;
  if (request.every) {
    observer = [&](const ivp::Step& step) {
      return rows.add_up_to(step.t1 * units.time,
                            [&](double t) { return units.users(step.at(t / units.time)); });
    };
  }
  const auto end = ivp::integrate(
      ivp::System(ZonalField{units.gravity}), units.own(request.start), 0, request.time / units.time,
      ivp::Rkn1210{.relative_tolerance = request.tolerance, .absolute_tolerance = request.tolerance},
      observer, {.seconds = request.seconds});
  if (!rows.status().ok()) throw Failure(rows.status());
  if (!end.status.ok()) {
    // The message of the status has scaled units; report time and distance in the user's units.
    throw Failure(
        failed_with(end.status.outcome(),
                    "rkn1210: stopped at t = {:.17g}, at a distance of {:.6g} from the centre; loosen "
                    "the tolerance {:g}, or "
                    "use the method series{}",
                    end.t * units.time, units.users(end.x).position.norm(), request.tolerance,
                    request.gravity.degree() == 0 ? fmt::format("; {}", without_steps) : ""));
  }
  say_steps_are_needless(request, end.statistics.steps);
  return rows.finish(units.users(end.x));
}

}  // namespace nlmech::chapters::two_body_series
