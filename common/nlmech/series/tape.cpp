#include "nlmech/series/tape.hpp"

#include <algorithm>
#include <numbers>

#include "nlmech/series/expansion_errors.hpp"

namespace nlmech {

using Step = TapeRecorder::Step;

namespace {

/// The value of an operation.
double evaluate(Step step, double a, double b, double constant) {
  switch (step) {
    case Step::variable: return constant;
    case Step::sum: return a + b;
    case Step::difference: return a - b;
    case Step::scaled: return constant * a;
    case Step::divided: return a / constant;
    case Step::shifted: return a + constant;
    case Step::product: return a * b;
    case Step::quotient: return a / b;
    case Step::reciprocal: return constant / a;
    case Step::root: return std::sqrt(a);
    case Step::exponential: return std::exp(a);
    case Step::logarithm: return std::log(a);
    case Step::sine: return std::sin(a);
    case Step::cosine: return std::cos(a);
    case Step::hyperbolic_sine: return std::sinh(a);
    case Step::hyperbolic_cosine: return std::cosh(a);
    case Step::tangent: return std::tan(a);
    case Step::hyperbolic_tangent: return std::tanh(a);
    case Step::power: return std::pow(a, constant);
    case Step::arc_sine: return std::asin(a);
    case Step::arc_cosine: return std::acos(a);
    case Step::arc_tangent: return std::atan(a);
    case Step::error_function: return std::erf(a);
    case Step::angle: return std::atan2(a, b);
  }
  return 0;
}

/// The degree of a result as a polynomial of the time.
int degree(Step step, int a, int b) {
  switch (step) {
    case Step::sum:
    case Step::difference: return std::max(a, b);
    case Step::scaled:
    case Step::divided:
    case Step::shifted: return a;
    case Step::product: return std::min(TapeRecorder::endless, a + b);
    default: return TapeRecorder::endless;
  }
}

/// Is 1/x exact?
bool has_exact_reciprocal(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5 && std::abs(exponent) < 1000;
}

}  // namespace

int TapeRecorder::add_variable(double value) {
  const bool is_time = nodes_.empty();
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({Step::variable, node, node, value, value, is_time ? 1 : endless, is_time});
  return node;
}

int TapeRecorder::add(Step step, int a, int b, double constant) {
  if ((step == Step::sum || step == Step::product) && b < a) std::swap(a, b);
  const auto [place, is_new] =
      known_.try_emplace(std::tuple(step, a, b, constant), static_cast<int>(nodes_.size()));
  if (is_new) {
    const Node x = nodes_[static_cast<std::size_t>(a)], y = nodes_[static_cast<std::size_t>(b)];
    nodes_.push_back({step, a, b, constant, evaluate(step, x.value, y.value, constant),
                      degree(step, x.degree, y.degree), x.timed && y.timed});
  }
  return place->second;
}

double TapeRecorder::branch_value(int node) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  if (!n.timed || !announced_) throw_unannounced_branch(n.timed);
  return n.value;
}

Recorded Recorded::step(Step step, double constant) const {
  if (is_constant()) return evaluate(step, constant_, constant_, constant);
  return {*recorder_, recorder_->add(step, node_, node_, constant)};
}

Recorded Recorded::step(Step step, const Recorded& a, const Recorded& b) {
  return {*a.recorder_, a.recorder_->add(step, a.node_, b.node_, 0)};
}

Recorded Recorded::operator-() const { return is_constant() ? Recorded(-constant_) : step(Step::scaled, -1); }

Recorded operator+(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return a.constant_ + b.constant_;
  if (a.is_constant()) return a.constant_ == 0 ? b : b.step(Step::shifted, a.constant_);
  if (b.is_constant()) return b.constant_ == 0 ? a : a.step(Step::shifted, b.constant_);
  return Recorded::step(Step::sum, a, b);
}

Recorded operator-(const Recorded& a, const Recorded& b) {
  if (a.is_constant()) return a + -b;
  if (b.is_constant()) return a + Recorded(-b.constant_);
  return Recorded::step(Step::difference, a, b);
}

Recorded operator*(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return a.constant_ * b.constant_;
  if (b.is_constant()) return b * a;
  if (!a.is_constant()) return Recorded::step(Step::product, a, b);
  if (a.constant_ == 0) return 0;
  return a.constant_ == 1 ? b : b.step(Step::scaled, a.constant_);
}

Recorded operator/(const Recorded& a, const Recorded& b) {
  if (a.is_constant()) {
    return b.is_constant() ? Recorded(a.constant_ / b.constant_) : b.step(Step::reciprocal, a.constant_);
  }
  if (!b.is_constant()) return Recorded::step(Step::quotient, a, b);
  if (has_exact_reciprocal(b.constant_)) return Recorded(1 / b.constant_) * a;
  return a.step(Step::divided, b.constant_);
}

Recorded sqrt(const Recorded& a) { return a.step(Step::root); }
Recorded exp(const Recorded& a) { return a.step(Step::exponential); }
Recorded log(const Recorded& a) { return a.step(Step::logarithm); }
Recorded sin(const Recorded& a) { return a.step(Step::sine); }
Recorded cos(const Recorded& a) { return a.step(Step::cosine); }
Recorded tan(const Recorded& a) { return a.step(Step::tangent); }
Recorded sinh(const Recorded& a) { return a.step(Step::hyperbolic_sine); }
Recorded cosh(const Recorded& a) { return a.step(Step::hyperbolic_cosine); }
Recorded tanh(const Recorded& a) { return a.step(Step::hyperbolic_tangent); }

template <class Slope>
Recorded Recorded::by_slope(Step step, Slope slope) const {
  return is_constant() ? Recorded(evaluate(step, constant_, 0, 0))
                       : Recorded::step(step, *this, slope(*this));
}
Recorded asin(const Recorded& a) {
  return a.by_slope(Step::arc_sine, [](const Recorded& x) { return ((1 - x) * (1 + x)).power(-0.5); });
}
Recorded acos(const Recorded& a) {
  return a.by_slope(Step::arc_cosine, [](const Recorded& x) { return -((1 - x) * (1 + x)).power(-0.5); });
}
Recorded atan(const Recorded& a) {
  return a.by_slope(Step::arc_tangent, [](const Recorded& x) { return 1 / (1 + x * x); });
}
Recorded erf(const Recorded& a) {
  return a.by_slope(Step::error_function,
                    [](const Recorded& x) { return 2 * std::numbers::inv_sqrtpi * exp(-(x * x)); });
}
Recorded atan2(const Recorded& y, const Recorded& x) {
  if (y.is_constant() && x.is_constant()) return std::atan2(y.constant_, x.constant_);
  // A constant coordinate becomes a node: 0 times the other one plus it.
  const auto node = [](const Recorded& c, const Recorded& other) {
    return c.is_constant() ? other.step(Step::scaled, 0).step(Step::shifted, c.constant_) : c;
  };
  return Recorded::step(Step::angle, node(y, x), node(x, y));
}

Recorded Recorded::power(double p) const {
  if (is_constant()) return std::pow(constant_, p);
  if (p == 0.5) return step(Step::root);
  if (p == std::floor(p) && std::abs(p) <= 1024) return whole_power(p);
  return step(Step::power, p);
}

// Repeated squaring: right also where the quantity vanishes.
Recorded Recorded::whole_power(double p) const {
  Recorded result = 1, square = *this;
  for (int rest = static_cast<int>(std::abs(p)); rest > 0; rest /= 2) {
    if (rest % 2 == 1) result = result * square;
    if (rest > 1) square = square * square;
  }
  return p < 0 ? 1 / result : result;
}

}  // namespace nlmech
