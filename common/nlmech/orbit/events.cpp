#include "nlmech/orbit/events.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {

/// The functions of all events, then their rates, along a step: in units of the distance and speed at its
/// start, so that they are near 1 and rounding is near eps.
class EventFinder::Functions : public BasicDenseOutput<ivp::State> {
 public:
  Functions(std::vector<Event> events, const Gravity& gravity, double tolerance)
      : events_(std::move(events)), gravity_(gravity), own_(gravity), tolerance_(tolerance) {
    for (const Event& event : events_) {
      if (event.kind == EventKind::distance && !(event.distance > 0 && std::isfinite(event.distance)))
        throw invalid_argument("events: a distance must be positive and finite, not {}", event.distance);
    }
  }
  /// Events of components; they refer to this object.
  [[nodiscard]] std::vector<ivp::Event> components() const {
    std::vector<ivp::Event> all(events_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].value = [i](double, const ivp::State& f) { return f[static_cast<Eigen::Index>(i)]; };
      all[i].bounds = [i](const program::Interval&, std::span<const program::Interval> f) { return f[i]; };
      all[i].rate_bounds = [this, i](const program::Interval&, std::span<const program::Interval> f) {
        return speed_ / length_ * f[events_.size() + i];
      };
    }
    return all;
  }
  void begin(const Step& step) {
    step_ = &step;
    noise_ = tolerance_ * (20 + static_cast<double>(step.index) / 16);
    length_ = step.x0.position.stableNorm();
    speed_ = std::max(step.x0.velocity.stableNorm(), std::sqrt(gravity_.mu / length_));
    own_.mu = gravity_.mu / length_ / speed_ / speed_;
    own_.radius = gravity_.radius / length_;
  }
  void evaluate(const State& s, ivp::State& f) const {
    const Vector3<double> r = s.position / length_, v = s.velocity / speed_;
    const double distance = r.norm(), along = r.dot(v);
    const auto n = static_cast<Eigen::Index>(events_.size());
    f.resize(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Event& event = events_[static_cast<std::size_t>(i)];
      switch (event.kind) {
        case EventKind::node:
          f[i] = r[2];
          f[n + i] = v[2];
          break;
        case EventKind::apsis:
          f[i] = along;
          f[n + i] = v.dot(v) + r.dot(acceleration(r, own_));
          break;
        case EventKind::distance:
          f[i] = distance - event.distance / length_;
          f[n + i] = along / distance;
          break;
      }
      if (std::abs(f[i]) <= noise_ && std::abs(f[n + i]) <= noise_) f[i] = f[n + i] = 0;
    }
  }
  void at(double t, ivp::State& f) const override { evaluate(step_->at(t), f); }

 private:
  std::vector<Event> events_;
  Gravity gravity_, own_;  ///< in units of the user, and of the step
  const Step* step_ = nullptr;
  double tolerance_, length_ = 1, speed_ = 1;
  double noise_ = 0;  ///< function and rate below this are zero: errors of the steps so far
};

EventFinder::EventFinder(std::vector<Event> events, const Gravity& gravity, double tolerance)
    : functions_(std::make_unique<Functions>(std::move(events), gravity, tolerance)),
      finder_(functions_->components(), {.absolute = tolerance}),
      system_(program::Problem(program::Equations(program::SourceText("events", "x' = 0")))) {}

EventFinder::~EventFinder() = default;

bool EventFinder::see(const Step& step) {
  functions_->begin(step);
  functions_->evaluate(step.x0, before_);
  functions_->evaluate(step.x1, after_);
  const std::size_t known = finder_.hits().size();
  const ivp::Step own{step.index, step.t0, step.t1, before_, after_, step.times, {}, *functions_};
  const bool fine = finder_.see(system_, own);
  for (std::size_t i = known; i < finder_.hits().size(); ++i) {
    const ivp::Hit& hit = finder_.hits()[i];
    hits_.push_back({hit.event, step.t1 < step.t0 ? -hit.direction : hit.direction, hit.t, step.at(hit.t)});
  }
  return fine;
}

}  // namespace nlmech::orbit
