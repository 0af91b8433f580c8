#include "chapters/two_body_series/series/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "chapters/two_body_series/orbits/propagators.hpp"
#include "chapters/two_body_series/series/accuracy.hpp"
#include "chapters/two_body_series/stm/sensitivities.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
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

/// Name of a passage through an event in the column `event`. @param direction of orbit::Hit
std::string label_of(const NamedEvent& event, int direction) {
  switch (event.event.kind) {
    case orbit::EventKind::node:
      return direction > 0 ? "ascending node" : direction < 0 ? "descending node" : "node touched";
    case orbit::EventKind::apsis:
      return direction > 0 ? "periapsis" : direction < 0 ? "apoapsis" : "apsis touched";
    case orbit::EventKind::distance: break;
  }
  return event.name + (direction > 0 ? " rising" : direction < 0 ? " falling" : " touched");
}

/// Message about the times between which an event has no rows.
std::string undetermined(const NamedEvent& event, const ivp::OpenEvent& part) {
  const char* const zero = event.event.kind == orbit::EventKind::node    ? "z is 0"
                           : event.event.kind == orbit::EventKind::apsis ? "the distance stays the same"
                                                                         : "the altitude stays the same";
  return fmt::format(
      "two_body_series: {}: {} to within rounding from t = {:.9g} to {:.9g}: no row is "
      "determined there",
      event.name, zero, part.t0, part.t1);
}

/// Collects the rows of a run and the worst accuracy.
class Rows {
 public:
  Rows(const OrbitRequest& request, std::string_view method)
      : request_(request), by_(computed_by(method, request.tolerance)), inner_(request.inner_times()) {
    text_ = "t,x,y,z,vx,vy,vz" + request.columns.names() + (request.events.empty() ? "\n" : ",event\n");
    if (!request.events.empty()) {
      std::vector<orbit::Event> events;
      for (const NamedEvent& event : request.events) events.push_back(event.event);
      // Steps round too, however small their tolerance is.
      finder_.emplace(std::move(events), request.gravity, std::max(by_.tolerance.value_or(0), 1e-15));
    }
    if (request.at.empty() || request.at.front() == 0)
      print(0, request.start, request.columns.cells(orbit::TransitionMatrix::Identity()));
  }

  /// Adds the rows of a step: requested times and events, in order. @returns false if a row has no digit, or
  /// an event function is NaN
  bool add_step(const orbit::Step& step) {
    const auto inside = [&step](double t) { return step.at(t); };
    if (finder_) {
      const std::size_t known = finder_->hits().size();
      if (!finder_->see(step) && status().ok()) accuracy_.status = finder_->status();
      for (std::size_t i = known; i < finder_->hits().size() && status().ok(); ++i) {
        const orbit::Hit& hit = finder_->hits()[i];
        add_up_to(hit.t, inside);
        add(hit.t, hit.state, label_of(request_.events[hit.event], hit.direction));
      }
    }
    return add_up_to(step.t1, inside);
  }
  /// Adds the rows at the requested times up to @p t1. @param state_at returns the state at a time
  /// @returns false if a row has no digit
  template <class StateAt>
  bool add_up_to(double t1, const StateAt& state_at) {
    for (; status().ok() && next_ < inner_.size() && std::abs(inner_[next_]) <= std::abs(t1); ++next_)
      add(inner_[next_], state_at(inner_[next_]));
    return status().ok();
  }
  /// Adds a row. @param more its event or cells of further columns @returns false if it has no digit
  bool add(double t, const orbit::State& s, const std::string& more = {}) {
    accuracy_.add(accuracy_of(s, request_.start, t, request_.gravity, by_));
    print(t, s, more);
    return status().ok();
  }
  /// Adds the last row @p s, prints low accuracy to standard error and returns all rows.
  /// @throws Failure if a row has no digit
  [[nodiscard]] std::string finish(const orbit::State& s, const std::string& more = {}) {
    if (request_.time != 0 && last_ != request_.time) add(request_.time, s, more);  // an event may be there
    if (!status().ok()) throw Failure(status());
    if (finder_) {
      for (const ivp::OpenEvent& part : finder_->open())
        scene::print_message(undetermined(request_.events[part.event], part));
    }
    if (const std::string& low = accuracy_.worst.sentence; !low.empty())
      scene::print_message(fmt::format("two_body_series: {}", low));
    return std::move(text_);
  }
  /// A failure if a row has no digit.
  [[nodiscard]] const Status& status() const { return accuracy_.status; }
  /// The inner times.
  [[nodiscard]] const std::vector<double>& inner() const { return inner_; }

 private:
  void print(double t, const orbit::State& s, const std::string& more) {
    last_ = t;
    append_state(text_, t, s);
    if (finder_) text_ += ',';
    text_.append(more) += '\n';
  }

  const OrbitRequest& request_;
  ComputedBy by_;
  std::string text_;
  std::vector<double> inner_;
  std::size_t next_ = 0;                                    // of inner_
  double last_ = std::numeric_limits<double>::quiet_NaN();  // time of the last row
  std::optional<orbit::EventFinder> finder_;
  OrbitAccuracy accuracy_;
};

/// Advice for long runs about a point mass.
const std::string without_steps =
    "about a point mass --method kepler needs no steps and is exact to rounding";

void say_steps_are_needless(const OrbitRequest& request, std::int64_t steps) {
  if (request.gravity.degree() == 0 && steps > 1'000'000)
    scene::print_message(fmt::format("two_body_series: {} steps; {}", steps, without_steps));
}

/// A state of an integration in own units, in those of the user.
orbit::State in_units_of_user(const ivp::State& x, const orbit::detail::PowerUnits& units) {
  return units.users(parted(x));
}

/// A step of an integration in own units, as one in those of the user.
class StepInUnits : public BasicDenseOutput<orbit::State> {
 public:
  StepInUnits(const orbit::detail::PowerUnits& units, const ivp::Step& step)
      : units_(units),
        step_(step),
        t1_(std::ldexp(step.t1, units.time)),
        x0_(in_units_of_user(step.x0, units)),
        x1_(in_units_of_user(step.x1, units)) {}
  /// Refers to this object.
  [[nodiscard]] orbit::Step users() const {
    return {step_.index, std::ldexp(step_.t0, units_.time), t1_, x0_, x1_, std::span(&t1_, 1), states_,
            *this};
  }
  void at(double t, orbit::State& x) const override {
    x = in_units_of_user(step_.at(std::ldexp(t, -units_.time)), units_);
  }

 private:
  const orbit::detail::PowerUnits& units_;
  const ivp::Step& step_;
  double t1_;
  orbit::State x0_, x1_;
  std::span<const orbit::State> states_{&x1_, 1};
};

/// Kepler's solution from the start, as dense output of steps of any length. @throws Failure where it fails
class KeplerMotion : public BasicDenseOutput<orbit::State> {
 public:
  explicit KeplerMotion(const OrbitRequest& request) : request_(request) {}
  orbit::State operator()(double t) const {
    const auto solution = orbit::propagate_kepler(request_.start, t, request_.gravity.mu);
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.state;
  }
  void at(double t, orbit::State& x) const override { x = (*this)(t); }

 private:
  const OrbitRequest& request_;
};

/// Passes Kepler's solution to @p rows in steps of half the time scale of the motion, for events.
void step_along(const KeplerMotion& motion, const OrbitRequest& request, Rows& rows) {
  double t = 0;
  orbit::State x = request.start;
  for (std::int64_t index = 1; t != request.time && rows.status().ok(); ++index) {
    const double r = x.position.stableNorm(), speed = x.velocity.stableNorm();
    const double h = 0.5 * std::min(r / speed, r * std::sqrt(r / request.gravity.mu));
    const double rest = std::abs(request.time - t);
    if (!(h > 4 * std::numeric_limits<double>::epsilon() * std::abs(t)))
      throw Failure(failed_with(Outcome::collision,
                                "kepler: the body passes so near the centre at t = {:.9g} that doubles do "
                                "not resolve events there; end the run before, or leave out --events",
                                t));
    if (request.watch.seconds() > request.seconds)
      throw Failure(failed_with(Outcome::time_limit,
                                "kepler: {} seconds were used up by the events up to t = {:.9g}; allow more, "
                                "or take a shorter time",
                                request.seconds, t));
    const double next = h >= rest ? request.time : t + std::copysign(h, request.time);
    const orbit::State there = motion(next);
    const std::span<const orbit::State> states(&there, 1);
    if (!rows.add_step({index, t, next, x, there, std::span(&next, 1), states, motion})) return;
    t = next;
    x = there;
  }
}

}  // namespace

std::vector<double> OrbitRequest::inner_times() const {
  std::vector<double> times = at;
  if (every) {
    // The final time has its own row; k DT equal to it up to rounding has no second one.
    for (std::int64_t k = 1; std::abs(time) - static_cast<double>(k) * *every > 1e-9 * *every; ++k)
      times.push_back(std::copysign(static_cast<double>(k) * *every, time));
  }
  std::erase_if(times, [this](double t) { return t == 0 || t == time; });
  return times;
}

orbit::detail::PowerUnits rkn1210_units(const OrbitRequest& request) {
  const double distance = request.start.position.stableNorm(), mu = request.gravity.mu;
  const orbit::detail::PowerUnits units(distance, mu);
  for (const int exponent : {units.length, units.time, units.length - units.time}) {
    if (!std::isnormal(std::ldexp(1.0, exponent)))
      throw Failure(
          failed_with(Outcome::outside_validity,
                      "rkn1210: the distance {:g} and mu = {:g} give units of length and time beyond the "
                      "range of doubles; give the data in other units, or use --method kepler",
                      distance, mu));
  }
  return units;
}

std::string rows_of_kepler(const OrbitRequest& request) {
  const KeplerMotion motion(request);
  const orbit::State end = motion(request.time);
  Rows rows(request, "kepler");
  if (request.events.empty())
    rows.add_up_to(request.time, motion);
  else
    step_along(motion, request, rows);
  return rows.finish(end);
}

std::string rows_of_series(const OrbitRequest& request) {
  Rows rows(request, "series");
  orbit::Observer observer;
  if (request.has_inner_rows()) observer = [&rows](const orbit::Step& step) { return rows.add_step(step); };
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
  Rows rows(request, "rkn1210");
  if (request.time == 0) return rows.finish(request.start);
  const orbit::detail::PowerUnits units = rkn1210_units(request);
  ivp::Observer observer;
  if (request.has_inner_rows())
    observer = [&](const ivp::Step& step) { return rows.add_step(StepInUnits(units, step).users()); };
  const auto end = ivp::integrate(
      ivp::System(ZonalField{units.own(request.gravity)}), joined(units.own(request.start)), 0,
      std::ldexp(request.time, -units.time),
      ivp::Rkn1210{.relative_tolerance = request.tolerance, .absolute_tolerance = request.tolerance},
      observer, {.seconds = request.seconds});
  if (!rows.status().ok()) throw Failure(rows.status());
  if (!end.status.ok()) {
    // The message of the status has scaled units; report time and distance in the user's units.
    throw Failure(failed_with(
        end.status.outcome(),
        "rkn1210: stopped at t = {:.17g}, at a distance of {:.6g} from the centre; loosen "
        "the tolerance {:g}, or "
        "use the method series{}",
        std::ldexp(end.t, units.time), in_units_of_user(end.x, units).position.norm(), request.tolerance,
        request.gravity.degree() == 0 ? fmt::format("; {}", without_steps) : ""));
  }
  say_steps_are_needless(request, end.statistics.steps);
  return rows.finish(in_units_of_user(end.x, units));
}

std::string rows_with_columns(const OrbitRequest& request, std::string_view method) {
  const Sensitivities& columns = request.columns;
  Rows rows(request, method);
  const auto add = [&](double t, const orbit::State& s, const orbit::TransitionMatrix& phi) {
    return rows.add(t, s, columns.cells(phi));
  };
  const auto run = propagate_with_transition(request, method, rows.inner(), add);
  if (!rows.status().ok()) throw Failure(rows.status());
  if (!run.end.status.ok()) throw Failure(run.end.status);
  return rows.finish(run.end.x, columns.cells(run.transition));
}

}  // namespace nlmech::chapters::two_body_series
