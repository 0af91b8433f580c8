#include "nlmech/ivp/events.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {
namespace {

using program::Interval;

constexpr int nodes = 8;                // of the Chebyshev polynomial of a part of a step
constexpr double many_tolerances = 10;  // allowance for the accumulated errors of all steps

int sign_of(double value) { return (value > 0) - (value < 0); }

/// Chebyshev's extreme points cos(pi j/7), j = 0, 1, ...
const std::array<double, nodes>& extreme_points() {
  static const std::array<double, nodes> points = [] {
    std::array<double, nodes> p{};
    for (int j = 0; j < nodes; ++j)
      p[static_cast<std::size_t>(j)] = std::cos(std::numbers::pi * j / (nodes - 1));
    return p;
  }();
  return points;
}

/// The values at the extreme points, as columns, times this matrix are the coefficients of the polynomial
/// through them.
const Eigen::MatrixXd& coefficients_of_values() {
  static const Eigen::MatrixXd matrix = [] {
    constexpr int last = nodes - 1;
    Eigen::MatrixXd m(nodes, nodes);
    for (int j = 0; j < nodes; ++j) {
      for (int k = 0; k < nodes; ++k) {
        const double ends = (j == 0 || j == last ? 0.5 : 1) * (k == 0 || k == last ? 0.5 : 1);
        m(j, k) = 2. / last * ends * std::cos(std::numbers::pi * j * k / last);
      }
    }
    return m;
  }();
  return matrix;
}

/// The undecided part of an event, or the end. Undecided parts, at most one for each event, stand before the
/// rests, of which there may be very many.
std::vector<OpenEvent>::iterator undecided_part(std::vector<OpenEvent>& open, std::size_t event) {
  const auto found =
      std::ranges::find_if(open, [event](const OpenEvent& o) { return o.rests || o.event == event; });
  return found == open.end() || found->rests ? open.end() : found;
}

}  // namespace

/// The zeros of one function within one step.
class EventFinder::Scan {
 public:
  Scan(EventFinder& finder, const System& system, const Step& step, const Limits& limits)
      : f_(finder),
        system_(system),
        step_(step),
        limits_(limits),
        x_(finder.x_),
        direction_(step.t1 > step.t0 ? 1 : -1) {}

  /// Finds all zeros of event @p i; sets its sign at the end of the step.
  void run(std::size_t i) {
    event_ = i;
    left_ = work;
    in_open_ = false;
    if (is_excluded() || decide_by_bounds()) return;
    between(step_.t0, step_.t1, 0);
    if (f_.status_.ok()) close_open();
    if (f_.status_.ok() && f_.signs_[i] == 0) f_.signs_[i] = sign_at(step_.t1);
  }

 private:
  static constexpr int most_halvings = 60;  // limit of halvings
  static constexpr int resolving = 12;  // limit of halvings until the polynomial must represent the states
  static constexpr int work = 256;      // parts of a step to check, and as many more after every hit
  static constexpr int places = 3;      // halvings of a step whose function has no bounds

  [[nodiscard]] const Event& event() const { return f_.events_[event_]; }
  const State& state(double t) {
    if (t == step_.t0) return step_.x0;
    if (t == step_.t1) return step_.x1;
    step_.dense.at(t, x_);
    return x_;
  }
  double value_at(double t) {
    const double value = event().value(t, state(t));
    if (std::isnan(value) && f_.status_.ok()) f_.status_ = event_undefined(t);
    return value;
  }
  int sign_at(double t) { return sign_of(value_at(t)); }

  // Error bound of a state component of @p size.
  [[nodiscard]] double error_of(double size) const {
    return many_tolerances * (f_.accuracy_.absolute + f_.accuracy_.relative * size);
  }
  // Does the step stay in the safe box, where the event has no zero? Then no dense output is needed.
  bool is_excluded() {
    if (!event().slopes || !event().bounds || f_.signs_[event_] == 0) return false;
    SafeBox& safe = f_.safe_[event_];
    const bool stays = stays_in(safe);
    if (stays) ++safe.uses;
    if (stays || --safe.wait > 0) return stays;
    constexpr int longest_pause = 512, worthwhile = 64;  // a search takes as long as some tens of steps
    safe.pause = safe.uses >= worthwhile ? 1 : std::min(2 * safe.pause, longest_pause);
    safe.wait = safe.pause;
    safe.uses = 0;
    return look_for(safe) && stays_in(safe);
  }
  // Does a box around all states of the step exclude a zero, or all but one, which is then searched for? It
  // takes less than the polynomial of a part.
  bool decide_by_bounds() {
    State &least = f_.least_, &most = f_.most_;
    if (!event().bounds || !step_.dense.bound_change(step_.t1, least, most)) return false;
    for (Eigen::Index i = 0; i < most.size(); ++i) {
      const Interval x(step_.x0[i] + least[i], step_.x0[i] + most[i]);
      f_.box_[static_cast<std::size_t>(i)] = x.inflated(error_of(x.magnitude()));
    }
    const Interval t(std::min(step_.t0, step_.t1), std::max(step_.t0, step_.t1));
    const Interval values = event().bounds(t, f_.box_);
    if (!values.has(0))
      without(step_.t0, values);
    else if (!search_if_monotone(step_.t0, step_.t1, values))
      return false;
    return true;
  }
  // Is the function, with these @p values in the box, monotone from a to b? Then searches for its zero.
  bool search_if_monotone(double a, double b, const Interval& values) {
    rate_ = event().rate_bounds(Interval(std::min(a, b), std::max(a, b)), f_.box_);
    const bool has_pole = !std::isfinite(values.width());  // then it is not
    if (rate_.has(0) || has_pole) return false;
    monotone(a, b, sign_of(rate_.low) * direction_);
    return true;
  }
  [[nodiscard]] bool stays_in(const SafeBox& safe) const {
    if (safe.x.empty() || !(safe.t.has(step_.t0) && safe.t.has(step_.t1))) return false;
    const double half = (step_.t1 - step_.t0) / 2;
    for (std::size_t i = 0; i < safe.x.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double a = half * safe.slopes[i].low, b = half * safe.slopes[i].high, x0 = step_.x0[k],
                   x1 = step_.x1[k];
      const double least = std::min({a, b, 0.}), most = std::max({a, b, 0.});
      if (!(std::min(x0 + least, x1 - most) >= safe.x[i].low &&
            std::max(x0 + most, x1 - least) <= safe.x[i].high))
        return false;
    }
    return true;
  }
  // Searches for a box around all states so far, or around those of this step, that holds a step 1.5 times as
  // large.
  bool look_for(SafeBox& safe) {
    const auto size = static_cast<std::size_t>(step_.x0.size());
    const auto ends = [&](std::size_t i) {
      const auto k = static_cast<Eigen::Index>(i);
      return Interval(std::min(step_.x0[k], step_.x1[k]), std::max(step_.x0[k], step_.x1[k]));
    };
    if (safe.seen.size() != size) safe.seen.assign(size, Interval(0));
    for (const bool all : {true, false}) {
      for (std::size_t i = 0; i < size; ++i) {
        const bool is_known = all && safe.slopes.size() == size;
        safe.seen[i] = is_known ? hull(safe.seen[i], ends(i)) : ends(i);
      }
      safe.slopes.resize(size);
      const double span = step_.t1 - step_.t0, later = step_.t1 + 64 * span;
      for (const Interval& t : {Interval(), Interval(std::min(step_.t0, later), std::max(step_.t0, later))}) {
        safe.t = t;
        if (is_closed(safe, 0.75 * std::abs(span)) && has_no_zero(safe)) return true;
      }
    }
    safe.x.clear();
    return false;
  }
  // Sets the box and its slopes. Does it hold all solutions from the states `seen` over the time @p h?
  bool is_closed(SafeBox& safe, double h) {
    safe.x = safe.seen;
    constexpr int most = 5;
    for (int k = 0; k < most; ++k) {
      event().slopes(safe.t, safe.x, safe.slopes);
      bool inside = true;
      for (std::size_t i = 0; i < safe.x.size(); ++i) {
        const Interval need = safe.seen[i] + safe.slopes[i] * Interval(-h, h);
        if (!std::isfinite(need.width())) return false;
        if (safe.x[i].low <= need.low && need.high <= safe.x[i].high) continue;
        inside = false;
        safe.x[i] = hull(safe.x[i], need.inflated(0.1 * need.width()));
      }
      if (inside) return true;
    }
    return false;
  }
  bool has_no_zero(const SafeBox& safe) {
    for (std::size_t i = 0; i < safe.x.size(); ++i)
      f_.box_[i] = safe.x[i].inflated(error_of(safe.x[i].magnitude()) + 1e-14 * safe.x[i].magnitude());
    return !event().bounds(safe.t, f_.box_).has(0);
  }
  // Sets the box of the states from a to b. Does the Chebyshev polynomial resolve them?
  bool bound_states(double a, double b) {
    const double middle = a + (b - a) / 2, half = (b - a) / 2;
    Nodes &x = f_.samples_, &c = f_.coefficients_;
    for (int j = 0; j < nodes; ++j) {
      const double t = j == 0           ? b
                       : j == nodes - 1 ? a
                                        : middle + half * extreme_points()[static_cast<std::size_t>(j)];
      x.col(j) = state(t);
    }
    c.noalias() = x * coefficients_of_values();
    bool resolved = true;
    for (Eigen::Index i = 0; i < c.rows(); ++i) {
      const double tail = std::abs(c(i, nodes - 2)) + std::abs(c(i, nodes - 1));
      const double all = c.row(i).tail(nodes - 1).cwiseAbs().sum(), size = std::abs(c(i, 0)) + all;
      const double error = error_of(size);
      resolved = resolved && tail <= 0.02 * all + error + 64 * std::numeric_limits<double>::epsilon() * size;
      f_.box_[static_cast<std::size_t>(i)] = Interval(c(i, 0)).inflated(all + 2 * tail + error);
    }
    return resolved;
  }
  // Bounds at one time, for states with an error of up to @p errors times error_of().
  Interval at_point(const BoundsOver& bounds, double t, double errors) {
    const State& x = state(t);
    for (Eigen::Index i = 0; i < x.size(); ++i)
      f_.box_[static_cast<std::size_t>(i)] = Interval(x[i]).inflated(errors * error_of(std::abs(x[i])));
    return bounds(Interval(t), f_.box_);
  }

  void between(double a, double b, int depth) {
    if (!f_.status_.ok()) return;
    const double middle = a + (b - a) / 2;
    const bool last = depth >= most_halvings || middle == a || middle == b;
    if (--left_ < 0) return undecided(a, b);
    if (!event().bounds) {
      if (depth == places || last) return monotone(a, b, 0);
    } else if (bound_states(a, b) || depth >= resolving || last) {
      const Interval values = event().bounds(Interval(std::min(a, b), std::max(a, b)), f_.box_);
      if (!values.has(0)) return without(a, values);
      if (search_if_monotone(a, b, values)) return;
      if (rate_.magnitude() == 0 && value_at(b) == 0) return rest(a, b);
      const Interval there = at_point(event().bounds, middle, 1);
      const double half = std::abs(b - a) / 2;
      const Interval tight = there + rate_ * Interval(-half, half);
      if (!tight.has(0)) return without(a, tight);
      const double size = std::min(values.magnitude(), tight.magnitude());
      if (last || size <= 2 * there.width()) return extend_open(a, b);
    }
    between(a, middle, depth + 1);
    between(middle, b, depth + 1);
  }
  // A part that is left undecided at the work limit.
  void undecided(double a, double b) {
    f_.add_open(event_, a, b);
    monotone(a, b, 0);
  }
  // A part without a zero, from a on. A sign that errors of the states had hidden before is seen here.
  void without(double a, const Interval& values) {
    close_open(true);
    int& sign = f_.signs_[event_];
    const int before = std::exchange(sign, sign_of(values.low));
    if (!(has_consequences() && before == -sign && sign_at(a) == sign && is_noise(a) && counts(sign))) return;
    const bool is_here = sign_at(step_.t0) == before;
    add(is_here ? first_of(step_.t0, a, [&](double t) { return sign_at(t) != before; }) : step_.t0, sign);
  }
  // A part in which the function rises (1), falls (-1), or is assumed monotone (0).
  void monotone(double a, double b, int slope) {
    close_open();
    int& sign = f_.signs_[event_];
    double from = a;
    if (sign == 0 && slope != 0 && stays_zero(a, b)) return f_.add_open(event_, a, b);
    if (sign == 0) sign = slope;
    if (sign == 0) {
      // The sign of a function that leaves zero is evaluated shortly after: the change there exceeds
      // rounding, and the function has not returned yet.
      from = a + (b - a) * 0x1p-26;
      sign = from == a ? 0 : sign_at(from);
    }
    passage(from, b);
  }
  // Sets the sign at b; adds a hit if it differs from the sign at a.
  void passage(double a, double b) {
    int& sign = f_.signs_[event_];
    const double at_b = value_at(b);
    const int before = sign, after = sign_of(at_b);
    sign = after;
    if (before == 0 || after == before || !f_.status_.ok()) return;
    const double at_a = value_at(a), t = change_of_sign(a, b, at_a, at_b, before);
    if (!f_.status_.ok()) return;
    if (!is_zero(t, a, std::abs(at_a) + std::abs(at_b))) {
      if (value_at(t) != 0) return;
      // It jumps to zero and stays there for some time.
      come_to_rest(-before, false, t, first_of(t, b, [&](double at) { return sign_at(at) == after; }));
      sign = after;
    } else {
      if (counts(-before)) add(t, -before);
      if (at_b == 0 && stays_zero(t, b)) f_.add_open(event_, t, b);
    }
  }
  // Is a function that tends to zero, as 1 - erf(t) does, zero by rounding from a to b?
  bool stays_zero(double a, double b) {
    const bool is_part = std::abs(b - a) > 0x1p-20 * std::abs(step_.t1 - step_.t0);
    return is_part && value_at(b) == 0 && value_at(a + (b - a) / 2) == 0 && value_at(a) == 0;
  }
  // The first double at which a condition holds that holds at b.
  template <class Condition>
  static double first_of(double a, double b, const Condition& holds) {
    for (;;) {
      const double middle = a + (b - a) / 2;
      if (middle == a || middle == b) return b;
      (holds(middle) ? b : a) = middle;
    }
  }
  // The first double without the sign @p before, which b does not have: by the method of Alefeld, Potra and
  // Shi (1995), which takes fewer evaluations than bisection.
  double change_of_sign(double a, double b, double at_a, double at_b, int before) {
    if (sign_of(at_a) == before && sign_of(at_b) == -before) {
      // Divided differences of values up to 1e150 do not overflow.
      const auto limited = [](double value) { return std::clamp(value, -1e150, 1e150); };
      const auto value = [&](double t) { return limited(value_at(t)); };
      const auto enough = [](double low, double high) {
        return high - low <= 4 * std::numeric_limits<double>::epsilon() * std::abs(high);
      };
      std::uintmax_t most = 40;
      const auto [low, high] = boost::math::tools::toms748_solve(value, std::min(a, b), std::max(a, b),
                                                                 limited(a < b ? at_a : at_b),
                                                                 limited(a < b ? at_b : at_a), enough, most);
      b = sign_at(low) == before ? high : low;
      for (double by = std::nextafter(b, a) - b; std::abs(by) < std::abs(b - a); by *= 2) {
        if (sign_at(b + by) == before) a = b + by;
      }
    }
    return first_of(a, b, [&](double at) { return sign_at(at) != before; });
  }
  [[nodiscard]] bool counts(int direction) const {
    const Crossing crossing = event().crossing;
    return crossing == Crossing::either || (crossing == Crossing::rising) == (direction > 0);
  }
  // Excludes poles and jumps, which change the sign too: a continuous function changes less between
  // neighbouring doubles than from a on, where it changes by @p change.
  bool is_zero(double t, double a, double change) {
    return !(std::abs(value_at(t) - value_at(std::nextafter(t, a))) > change / 4);
  }

  // Adds a part in which a zero is undecided.
  void extend_open(double a, double b) {
    if (!in_open_) open_from_ = a;
    in_open_ = true;
    open_to_ = b;
  }
  // Classifies the undecided parts once the next part is decided.
  // @param leaves has the next part no zero?
  void close_open(bool leaves = false) {
    if (!in_open_) return;
    in_open_ = false;
    int& sign = f_.signs_[event_];
    const bool starts_at_zero = sign == 0;
    if (starts_at_zero) {
      leave_rest();
      sign = slope_at(open_from_) * direction_;
    }
    const int before = sign;
    if (before == 0 || sign_at(open_to_) == -before) {
      if (is_hidden()) return f_.add_open(event_, open_from_, open_to_);
      passage(open_from_, open_to_);
      if (sign == 0 && before == 0) f_.add_open(event_, open_from_, open_to_, true);  // zero throughout
      return;
    }
    if (!f_.status_.ok()) return;
    if (is_at_rest(open_from_)) {
      if (is_at_rest(open_to_)) return come_to_rest(-before, starts_at_zero, open_from_, open_to_);
      if (starts_at_zero) return;  // it leaves its rest
    } else if (const double t = rest_from(); t != open_to_) {
      return come_to_rest(-before, false, t, open_to_);
    }
    if (is_hidden()) return f_.add_open(event_, open_from_, open_to_);
    const int first = slope_at(open_from_), last = slope_at(open_to_);
    const bool turns = first != 0 && last == -first;
    if (event().crossing == Crossing::either && turns) {
      const double t = first_of(open_from_, open_to_, [&](double at) { return slope_at(at) == last; });
      if (!is_far_from_zero(t)) add(t, 0);
    } else if (!leaves || !touch()) {
      f_.add_open(event_, open_from_, open_to_);
    }
  }
  [[nodiscard]] bool has_consequences() const {
    return event().must_leave && (event().ends > 0 || event().change);
  }
  bool is_hidden() { return has_consequences() && is_noise(open_from_) && is_noise(open_to_); }
  // May both the value and the slope be zero, to within the errors of the states?
  bool is_noise(double t) {
    if (!event().bounds) return false;
    return at_point(event().bounds, t, 1).has(0) && at_point(event().rate_bounds, t, 1).has(0);
  }
  // Is the function far from zero in the undecided part, whose bounds are wide near a point where it is not
  // defined, as those of sin(x)/x at 0?
  bool is_far_from_zero(double t) {
    const double g = std::abs(value_at(t));
    const double ends = std::max(std::abs(value_at(open_from_)), std::abs(value_at(open_to_)));
    if (g > ends / 4 && (may_jump(open_from_) || may_jump(t) || may_jump(open_to_))) return true;
    if (!event().bounds) return false;
    double change =
        4 * at_point(event().bounds, t, 0).width();  // by rounding, and by the errors of t and of the states
    State x = state(t);
    const double near = 8 * std::numeric_limits<double>::epsilon() * std::abs(t) +
                        1e-12 * std::abs(open_to_ - open_from_);  // the precision of lowest()
    for (const double late : {-near, near}) change += std::abs(std::abs(event().value(t + late, x)) - g);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double before = x[i];
      for (const double error : {-error_of(std::abs(before)), error_of(std::abs(before))}) {
        x[i] = before + error;
        change += std::abs(std::abs(event().value(t, x)) - g);
      }
      x[i] = before;
    }
    return g > 2 * change;
  }
  bool is_at_rest(double t) {
    if (value_at(t) != 0) return false;
    return event().bounds ? at_point(event().rate_bounds, t, 0).has(0) : slope_near(t) == 0;
  }
  // The time in the undecided part from which on the function stays at zero, as max(x, 0) and floor(x) do;
  // the end if it does not. A function that only tends to zero, as 1 - tanh(t) does, is zero by rounding, and
  // the bounds on its rate are not.
  double rest_from() {
    const auto stays = [this](double t) {
      return value_at(t) == 0 && at_point(event().rate_bounds, t, 0).magnitude() == 0;
    };
    if (!event().bounds || !stays(open_to_)) return open_to_;
    const double t = first_of(open_from_, open_to_, [&](double at) { return value_at(at) == 0; });
    return stays(t + (open_to_ - t) / 2) ? t : open_to_;
  }
  // A function that is zero in this part.
  void come_to_rest(int direction, bool is_there, double t, double to) {
    if (!is_there) arrive(direction, t);
    f_.signs_[event_] = 0;
    f_.add_open(event_, t, to, true);
  }
  // A function that was not zero comes to rest. The part before in which it could not be distinguished from
  // zero belongs to its way there.
  void arrive(int direction, double t) {
    if (const auto known = undecided_part(f_.open_, event_);
        known != f_.open_.end() && known->t1 == open_from_)
      f_.open_.erase(known);
    if (counts(direction)) add(t, direction);
    left_ = work;
  }
  // A part in which the function is zero and, by the bounds on its rate, constant.
  void rest(double a, double b) {
    if (!in_open_) open_from_ = a;
    in_open_ = false;
    const double from = first_of(open_from_, a, [this](double at) { return value_at(at) == 0; });
    if (const int before = std::exchange(f_.signs_[event_], 0); before != 0) arrive(-before, from);
    f_.add_rest(event_, from, b);
  }
  // Moves the end of a rest that ended with the undecided part to the time at which the function leaves zero.
  void leave_rest() {
    if (OpenEvent* const last = f_.last_rest(event_); last && last->t1 == open_from_)
      last->t1 = first_of(open_from_, open_to_, [this](double at) { return value_at(at) != 0; });
  }
  // The function comes close to zero in the open part and leaves it again: it jumps onto zero, as mod(x, 1)
  // does, or past it, or touches it. False if this is undecided.
  bool touch() {
    const double from = std::abs(value_at(open_from_)), to = std::abs(value_at(open_to_));
    const bool rises = to > from;
    const double t = first_of(open_from_, open_to_,
                              [&](double at) { return (std::abs(value_at(at)) > (from + to) / 2) == rises; });
    const double jump = std::abs(std::abs(value_at(t)) - std::abs(value_at(std::nextafter(t, open_from_))));
    if (std::min(from, to) < jump / 4 && jump > std::max(from, to) / 2) {
      const int direction = slope_at(rises ? open_from_ : open_to_) * direction_;
      if (counts(direction)) add(t, direction);
      return true;
    }
    const double least = lowest(open_from_, open_to_);
    if (is_far_from_zero(least)) return true;
    if (event().crossing != Crossing::either) return false;
    add(least, 0);
    return true;
  }
  bool may_jump(double t) {
    return event().bounds && !std::isfinite(at_point(event().rate_bounds, t, 1).width());
  }
  // Time of the minimum of |g|, by golden section.
  double lowest(double a, double b) {
    constexpr double part = 0.381966011250105;
    double left = a + part * (b - a), right = b - part * (b - a);
    double at_left = std::abs(value_at(left)), at_right = std::abs(value_at(right));
    constexpr int most = 60;
    for (int k = 0; k < most && left != right; ++k) {
      if (at_left <= at_right) {
        b = std::exchange(right, left);
        left = a + part * (b - a);
        at_right = std::exchange(at_left, std::abs(value_at(left)));
      } else {
        a = std::exchange(left, right);
        right = b - part * (b - a);
        at_left = std::exchange(at_right, std::abs(value_at(right)));
      }
    }
    return left;
  }
  int slope_at(double t) { return sign_of(slope_near(t)); }

  void add(double t, int direction) {
    Hit hit{event_, t, state(t), direction};
    if (f_.run_ && !step_.dense.is_as_accurate_as_step()) refine(hit);
    f_.hits_.push_back(std::move(hit));
    left_ = work;
  }
  // dg/dt
  double slope_near(double t) {
    if (event().bounds) {
      const Interval rate = at_point(event().rate_bounds, t, 0);
      return (rate.low + rate.high) / 2;
    }
    const double span = step_.t1 - step_.t0, near = 1e-5 * span;
    const double from = std::abs(t - step_.t0) < std::abs(span) / 2 ? t : t - near;
    return (value_at(from + near) - value_at(from)) / near;
  }
  // Refines a hit by integrating from the start of the step: the state, and the time of a crossing by
  // Newton's iteration. For a small change of time the dense output tells the change of the state.
  void refine(Hit& hit) {
    const double span = step_.t1 - step_.t0, slope = slope_near(hit.t), small = 0x1p-28 * std::abs(span);
    Limits limits = limits_;
    constexpr int most = 3;
    for (int k = 0; k < most && hit.t != step_.t0; ++k) {
      limits.first_step = std::abs(hit.t - step_.t0);  // a shorter step than one that was accepted
      const Solution there = f_.run_(system_, step_.x0, step_.t0, hit.t, {}, limits);
      if (!there.status.ok()) break;
      hit.x = there.x;
      if (hit.direction == 0) break;
      const double change = -event().value(hit.t, hit.x) / slope, next = hit.t + change;
      const bool inside = (next - step_.t0) / span > 0 && (next - step_.t0) / span <= 1;
      if (!inside || next == hit.t) break;
      const bool is_small = std::abs(change) <= small;
      if (is_small) {
        hit.x -= state(hit.t);
        hit.x += state(next);
      }
      hit.t = next;
      if (is_small) break;
    }
  }

  EventFinder& f_;
  const System& system_;
  const Step& step_;
  const Limits& limits_;
  State& x_;
  int direction_;
  std::size_t event_ = 0;
  int left_ = 0;  // parts of the step that may still be checked
  bool in_open_ = false;
  double open_from_ = 0, open_to_ = 0;
  Interval rate_;  // bounds of search_if_monotone()
};

EventFinder::EventFinder(std::vector<Event> events, StateAccuracy accuracy, SmoothRun run)
    : events_(std::move(events)),
      accuracy_(accuracy),
      run_(std::move(run)),
      signs_(events_.size(), 0),
      counts_(events_.size(), 0) {
  for (const Event& event : events_) {
    if (!event.value) throw std::invalid_argument("event: there is no function to watch");
    if (!event.bounds != !event.rate_bounds)
      throw std::invalid_argument("event: bounds and rate_bounds are given together or not at all");
  }
}

void EventFinder::begin(double t, const State& x) {
  const auto size = static_cast<std::size_t>(x.size());
  box_.resize(size);
  x_ = x;
  samples_.resize(x.size(), nodes);
  coefficients_.resize(x.size(), nodes);
  safe_.resize(events_.size());
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const double value = events_[i].value(t, x);
    if (std::isnan(value) && status_.ok()) status_ = event_undefined(t);
    // A function that an earlier part has brought to zero keeps its sign: its zero is still to be counted.
    const bool has_arrived = value == 0 && signs_[i] != 0 && !has_hit_before(i, t);
    if (!has_arrived) signs_[i] = sign_of(value);
  }
  for (std::size_t k = changed_at_; goes_on_ && k < hits_.size(); ++k) {
    const Hit& last = hits_[k];
    const auto& value = events_[last.event].value;
    const bool is_there = std::abs(value(t, x)) <= 2 * std::abs(value(last.t, hits_[changed_at_].x));
    if (is_there) signs_[last.event] = 0;
  }
  goes_on_ = false;
}

bool EventFinder::has_hit_before(std::size_t i, double t) const {
  return std::ranges::any_of(hits_, [&](const Hit& h) {
    return h.event == i && (t > last_from_ ? h.t > last_from_ : h.t < last_from_);
  });
}

void EventFinder::go_on() {
  goes_on_ = changed_;
  changed_ = false;
}

bool EventFinder::see(const System& system, const Step& step, const Limits& limits) {
  if (events_.empty()) return true;
  if (step.index == 1) begin(step.t0, step.x0);
  last_from_ = step.t0;
  const auto first = static_cast<std::ptrdiff_t>(hits_.size());
  Scan scan(*this, system, step, limits);
  for (std::size_t i = 0; i < events_.size() && status_.ok(); ++i) scan.run(i);
  const auto begin = hits_.begin() + first;
  const bool forwards = step.t1 > step.t0;
  std::stable_sort(begin, hits_.end(),
                   [forwards](const Hit& a, const Hit& b) { return forwards ? a.t < b.t : a.t > b.t; });
  for (auto hit = begin; hit != hits_.end(); ++hit) {
    if (!stops_at(*hit)) continue;
    hits_.erase(with_others_at_its_time(hit), hits_.end());
    break;
  }
  return status_.ok() && !ended_ && !changed_;
}

/// Lets the events at the time of @p hit, which changes the state, follow it in their order: each sees the
/// state that the one before left. @return the first later hit
std::vector<Hit>::iterator EventFinder::with_others_at_its_time(std::vector<Hit>::iterator hit) {
  changed_at_ = static_cast<std::size_t>(hit - hits_.begin());
  for (; !ended_ && hit + 1 != hits_.end(); ++hit) {
    constexpr double same = 4 * std::numeric_limits<double>::epsilon();
    Hit& next = *(hit + 1);
    if (std::abs(next.t - hit->t) > same * std::abs(hit->t)) break;
    next.t = hit->t;
    next.x = after_;
    static_cast<void>(stops_at(next));
    changed_ = !ended_;
  }
  return hit + 1;
}

bool EventFinder::stops_at(Hit& hit) {
  const Event& event = events_[hit.event];
  ended_ = ++counts_[hit.event] == event.ends;
  after_ = hit.x;
  if (event.change) {
    event.change(hit.t, after_);
    hit.after = after_;
    changed_ = !ended_;
    if (!hit.after.allFinite())
      status_ =
          failed_with(Outcome::non_finite,
                      "event: the state after its change at t = {:.17g} is not finite; give a change that "
                      "is defined there",
                      hit.t);
  }
  return ended_ || changed_;
}

void EventFinder::add_open(std::size_t event, double t0, double t1, bool is_zero) {
  if (is_zero && std::ranges::find(hits_, event, &Hit::event) != hits_.end()) return add_rest(event, t0, t1);
  if (const auto known = undecided_part(open_, event); known == open_.end())
    open_.insert(std::ranges::find(open_, true, &OpenEvent::rests), {event, t0, t1});
  else
    known->t1 = t1;
}

void EventFinder::add_rest(std::size_t event, double t0, double t1) {
  if (OpenEvent* const last = last_rest(event); last && last->t1 == t0)
    last->t1 = t1;
  else
    open_.push_back({event, t0, t1, true});
}

OpenEvent* EventFinder::last_rest(std::size_t event) {
  const auto is_it = [&](const OpenEvent& open) { return open.event == event && open.rests; };
  const auto last = std::find_if(open_.rbegin(), open_.rend(), is_it);
  return last == open_.rend() ? nullptr : &*last;
}

Solution integrate_past_changes(const SmoothRun& run, const System& system, const State& x0, double t0,
                                double t1, EventFinder& finder, const Observer& observer,
                                const Limits& limits) {
  constexpr int most_repeated = 4;   // limit of successive events, each sooner than the one before,
  constexpr double at_once = 1e-11;  // and within this fraction of the interval of integration
  const Stopwatch watch;
  Solution all{t0, x0, {}, {}};
  int repeated = 0;
  double last = std::numeric_limits<double>::infinity();
  for (double from = t0;; from = all.t) {
    Limits left = limits;
    if (from != t0) {
      left.steps = std::max<std::int64_t>(limits.steps - all.statistics.steps - all.statistics.rejected, 1);
      left.seconds = std::max(limits.seconds - watch.seconds(), 1e-6);
    }
    const Solution part = run(system, all.x, from, t1, observer, left);
    all.statistics += part.statistics;
    all.t = part.t;
    all.x = part.x;
    all.status = part.status;
    if (!finder.status().ok()) all.status = finder.status();
    if (!finder.status().ok() || !(finder.ended() || finder.changed())) break;
    const Hit& hit = finder.hits().back();
    all.t = hit.t;
    all.x = finder.changed() ? finder.after() : hit.x;
    all.status = {};
    if (finder.ended() || all.t == t1) break;
    finder.go_on();
    const double since = std::abs(hit.t - from);
    repeated = since <= at_once * std::abs(t1 - t0) && since <= last ? repeated + 1 : 0;
    last = since;
    if (repeated > most_repeated) {
      all.status = failed_with(
          Outcome::outside_validity,
          "events that change the state accumulate at t = {:.17g}; end the run before, or at one of them",
          hit.t);
      break;
    }
  }
  all.statistics.seconds = watch.seconds();
  return all;
}

SmoothRun with_changes(const SmoothRun& run, const std::vector<Event>& events, StateAccuracy accuracy) {
  std::vector<Event> changing;
  std::ranges::copy_if(events, std::back_inserter(changing),
                       [](const Event& e) { return static_cast<bool>(e.change); });
  if (changing.empty()) return run;
  return [run, changing, accuracy](const System& system, const State& x0, double t0, double t1,
                                   const Observer& observer, const Limits& limits) {
    return integrate_with_events(run, system, x0, t0, t1, changing, accuracy, observer, limits).solution;
  };
}

EventSolution integrate_with_events(const SmoothRun& run, const System& system, const State& x0, double t0,
                                    double t1, std::vector<Event> events, StateAccuracy accuracy,
                                    const Observer& observer, const Limits& limits) {
  EventFinder finder(std::move(events), accuracy, run);
  const Observer observe = [&](const Step& step) {
    const bool goes_on = finder.see(system, step, limits);
    if (!observer || observer(step)) return goes_on;
    finder.go_on();  // discards the change: the observer ends the run
    return false;
  };
  Solution solution = integrate_past_changes(run, system, x0, t0, t1, finder, observe, limits);
  return {std::move(solution), finder.hits(), finder.open()};
}

}  // namespace nlmech::ivp
