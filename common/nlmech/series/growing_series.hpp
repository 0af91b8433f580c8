/// @file
/// Power series that gain one coefficient at a time: an expression is evaluated again for every order, and
/// each of its operations computes one new coefficient and remembers the others.
///
/// The Taylor coefficients of a solution of x' = f(t, x) need this: coefficient k of f gives coefficient k +
/// 1 of x. Evaluating f with PowerSeries for every order would repeat all lower coefficients: order^3
/// operations in place of order^2.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "nlmech/series/number_traits.hpp"
#include "nlmech/series/recurrences.hpp"
#include "nlmech/series/value_of.hpp"
#include "nlmech/series/vector.hpp"

namespace nlmech {

/// Where the coefficients of all operations of an expression live. An operation is known by its place in the
/// sequence of operations, so every pass must perform the same sequence: which it does if the expression
/// branches on nothing but values that stay the same (parameters, value_of() of a series).
template <class T>
class SeriesMemory {
 public:
  /// Room for series up to @p order, in blocks that are kept from one use to the next.
  void start(std::size_t order) {
    stride_ = order + 1;
    used_ = variables_ = 0;
    coefficient_.clear();
  }
  /// A new series that is set from outside; all variables come before the first pass.
  [[nodiscard]] std::size_t add_variable() {
    variables_ = used_ + 1;
    return add();
  }
  /// Begins the pass that computes the coefficients number @p k of all operations; k = 0, 1, 2, ...
  void begin_pass(std::size_t k) {
    pass_ = k;
    used_ = variables_;
  }
  /// The series of the next operation of this pass.
  [[nodiscard]] std::size_t add() {
    const std::size_t series = used_++;
    if (coefficient_.size() < used_ * stride_) coefficient_.resize(used_ * stride_, T(0));
    return series;
  }
  /// Which coefficient is computed now.
  [[nodiscard]] std::size_t pass() const { return pass_; }
  /// The coefficients of a series; valid until the next add().
  [[nodiscard]] T* operator[](std::size_t series) { return coefficient_.data() + series * stride_; }

 private:
  std::size_t stride_ = 1, used_ = 0, variables_ = 0, pass_ = 0;
  std::vector<T> coefficient_;
};

/// A power series in a SeriesMemory, or a constant. The numbers that a right-hand side is evaluated with; the
/// operations are those of PowerSeries, and give the same coefficients.
template <class T>
class GrowingSeries {
 public:
  /// The constant 0.
  GrowingSeries() = default;

  /// A constant.
  template <class S>
  requires std::convertible_to<S, T> GrowingSeries(const S& constant) : constant_(static_cast<T>(constant)) {}

  /// A variable: a series whose coefficients are set from outside before the pass that needs them.
  [[nodiscard]] static GrowingSeries variable(SeriesMemory<T>& memory) {
    GrowingSeries v;
    v.memory_ = &memory;
    v.series_ = memory.add_variable();
    return v;
  }

  /// Sets coefficient @p k of a variable.
  void set(std::size_t k, const T& coefficient) { (*memory_)[series_][k] = coefficient; }
  /// Coefficient @p k, computed in the pass k or set.
  [[nodiscard]] T operator[](std::size_t k) const {
    if (memory_ != nullptr) return (*memory_)[series_][k];
    return k == 0 ? constant_ : T(0);
  }

  /// The same quantity.
  GrowingSeries operator+() const { return *this; }
  /// Its negative.
  GrowingSeries operator-() const {
    if (memory_ == nullptr) return T(-constant_);
    return result(*this, *this, [&](std::size_t k, const T*) { return T(-(*this)[k]); });
  }
  /// Sum.
  friend GrowingSeries operator+(const GrowingSeries& a, const GrowingSeries& b) {
    if (a.is_constant() && b.is_constant()) return T(a.constant_ + b.constant_);
    return result(a, b, [&](std::size_t k, const T*) { return T(a[k] + b[k]); });
  }
  /// Difference.
  friend GrowingSeries operator-(const GrowingSeries& a, const GrowingSeries& b) {
    if (a.is_constant() && b.is_constant()) return T(a.constant_ - b.constant_);
    return result(a, b, [&](std::size_t k, const T*) { return T(a[k] - b[k]); });
  }
  /// Product.
  friend GrowingSeries operator*(const GrowingSeries& a, const GrowingSeries& b) {
    if (a.is_constant() && b.is_constant()) return T(a.constant_ * b.constant_);
    if (a.is_constant()) return result(a, b, [&](std::size_t k, const T*) { return T(a.constant_ * b[k]); });
    if (b.is_constant()) return result(a, b, [&](std::size_t k, const T*) { return T(a[k] * b.constant_); });
    return result(a, b, [&](std::size_t k, const T*) { return recurrence::product(a.data(), b.data(), k); });
  }
  /// Quotient. A divisor that begins with 0 gives infinities and NaN, as numbers do.
  friend GrowingSeries operator/(const GrowingSeries& a, const GrowingSeries& b) {
    if (a.is_constant() && b.is_constant()) return T(a.constant_ / b.constant_);
    if (b.is_constant()) return result(a, b, [&](std::size_t k, const T*) { return T(a[k] / b.constant_); });
    return result(a, b,
                  [&](std::size_t k, const T* r) { return recurrence::quotient(a[k], b.data(), r, k); });
  }
  /// Adds a series.
  GrowingSeries& operator+=(const GrowingSeries& b) { return *this = *this + b; }
  /// Subtracts a series.
  GrowingSeries& operator-=(const GrowingSeries& b) { return *this = *this - b; }
  /// Multiplies by a series.
  GrowingSeries& operator*=(const GrowingSeries& b) { return *this = *this * b; }
  /// Divides by a series.
  GrowingSeries& operator/=(const GrowingSeries& b) { return *this = *this / b; }

  /// Square root, for c_0 != 0.
  friend GrowingSeries sqrt(const GrowingSeries& a) {
    using std::sqrt;
    if (a.is_constant()) return T(sqrt(a.constant_));
    return result(a, a, [&](std::size_t k, const T* r) { return recurrence::root(a.data(), r, k); });
  }
  /// Exponential function.
  friend GrowingSeries exp(const GrowingSeries& a) {
    using std::exp;
    if (a.is_constant()) return T(exp(a.constant_));
    return result(a, a, [&](std::size_t k, const T* r) { return recurrence::exponential(a.data(), r, k); });
  }
  /// Sine and cosine of one argument, which need each other.
  friend std::pair<GrowingSeries, GrowingSeries> sin_cos(const GrowingSeries& a) {
    using std::cos;
    using std::sin;
    if (a.is_constant()) return {T(sin(a.constant_)), T(cos(a.constant_))};
    return a.companions(recurrence::sine<T>, recurrence::cosine<T>);
  }
  /// Sine.
  friend GrowingSeries sin(const GrowingSeries& a) { return sin_cos(a).first; }
  /// Cosine.
  friend GrowingSeries cos(const GrowingSeries& a) { return sin_cos(a).second; }
  /// Natural logarithm, for c_0 > 0.
  friend GrowingSeries log(const GrowingSeries& a) {
    using std::log;
    if (a.is_constant()) return T(log(a.constant_));
    return result(a, a, [&](std::size_t k, const T* r) { return recurrence::logarithm(a.data(), r, k); });
  }
  /// a^p for a real exponent, for c_0 > 0.
  template <class P>
  requires(!std::integral<P> && std::convertible_to<P, T>) friend GrowingSeries
      pow(const GrowingSeries& a, const P& p) {
    using std::pow;
    const T exponent = static_cast<T>(p);
    if (a.is_constant()) return T(pow(a.constant_, exponent));
    return result(a, a,
                  [&](std::size_t k, const T* r) { return recurrence::power(a.data(), exponent, r, k); });
  }
  /// Hyperbolic sine and cosine of one argument, which need each other.
  friend std::pair<GrowingSeries, GrowingSeries> sinh_cosh(const GrowingSeries& a) {
    using std::cosh;
    using std::sinh;
    if (a.is_constant()) return {T(sinh(a.constant_)), T(cosh(a.constant_))};
    return a.companions(recurrence::hyperbolic_sine<T>, recurrence::hyperbolic_cosine<T>);
  }
  /// Hyperbolic sine.
  friend GrowingSeries sinh(const GrowingSeries& a) { return sinh_cosh(a).first; }
  /// Hyperbolic cosine.
  friend GrowingSeries cosh(const GrowingSeries& a) { return sinh_cosh(a).second; }
  /// Tangent.
  friend GrowingSeries tan(const GrowingSeries& a) {
    using std::tan;
    if (a.is_constant()) return T(tan(a.constant_));
    return a
        .companions(recurrence::tangent<T>,
                    [](const T*, const T* r, std::size_t k) {
                      return k == 0 ? T(1 + r[0] * r[0]) : recurrence::product(r, r, k);
                    })
        .first;
  }
  /// Hyperbolic tangent.
  friend GrowingSeries tanh(const GrowingSeries& a) {
    using std::cosh;
    using std::tanh;
    if (a.is_constant()) return T(tanh(a.constant_));
    return a
        .companions(recurrence::hyperbolic_tangent<T>,
                    [](const T* c, const T* r, std::size_t k) {
                      const T root = cosh(c[0]);
                      return k == 0 ? T(1 / (root * root)) : T(-recurrence::product(r, r, k));
                    })
        .first;
  }
  /// a^p for an integer exponent, by repeated squaring; a^0 is the constant 1.
  friend GrowingSeries pow(const GrowingSeries& a, int p) {
    GrowingSeries power(T(1)), square = a;
    for (unsigned rest = p < 0 ? 0U - static_cast<unsigned>(p) : static_cast<unsigned>(p); rest > 0;
         rest /= 2) {
      if (rest % 2 == 1) power *= square;
      if (rest > 1) square *= square;
    }
    return p < 0 ? GrowingSeries(T(1)) / power : power;
  }
  /// The number inside the coefficient c_0.
  friend auto value_of(const GrowingSeries& a) { return value_of(a[0]); }

 private:
  GrowingSeries(SeriesMemory<T>& memory, std::size_t series) : memory_(&memory), series_(series) {}
  [[nodiscard]] bool is_constant() const { return memory_ == nullptr; }
  [[nodiscard]] const T* data() const { return (*memory_)[series_]; }

  /// The next operation of the pass: @p next(k, r) is its coefficient k, r are those below.
  template <class Next>
  static GrowingSeries result(const GrowingSeries& a, const GrowingSeries& b, const Next& next) {
    SeriesMemory<T>& memory = a.is_constant() ? *b.memory_ : *a.memory_;
    const std::size_t series = memory.add(), k = memory.pass();
    memory[series][k] = next(k, memory[series]);
    return GrowingSeries(memory, series);
  }

  /// Two operations of the pass that need each other: r_k = first(a, g, k), then g_k = second(a, r, k).
  template <class First, class Second>
  [[nodiscard]] std::pair<GrowingSeries, GrowingSeries> companions(const First& first,
                                                                   const Second& second) const {
    SeriesMemory<T>& memory = *memory_;
    const std::size_t one = memory.add(), other = memory.add(), k = memory.pass();
    memory[one][k] = first(data(), memory[other], k);
    memory[other][k] = second(data(), memory[one], k);
    return {GrowingSeries(memory, one), GrowingSeries(memory, other)};
  }

  SeriesMemory<T>* memory_ = nullptr;
  std::size_t series_ = 0;
  T constant_{};
};

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// What Eigen has to know about growing series as entries of vectors.
template <class T>
struct Eigen::NumTraits<nlmech::GrowingSeries<T>>
    : nlmech::detail::NumberTraits<nlmech::GrowingSeries<T>, 5, 10, 100> {};
/// @endcond
