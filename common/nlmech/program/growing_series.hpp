/// @file
/// Power series that gain one coefficient per pass: an expression is evaluated once per order, and each of
/// its operations computes one new coefficient and stores it.
///
/// The Taylor coefficients of a solution of x' = f(t, x) need this: coefficient k of f gives coefficient k +
/// 1 of x. Evaluating f with PowerSeries for every order would repeat all lower coefficients: order^3
/// operations in place of order^2.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "nlmech/program/number_traits.hpp"
#include "nlmech/program/recurrences.hpp"
#include "nlmech/program/series_functions.hpp"
#include "nlmech/program/value_of.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech {

/// Memory of the coefficients of all operations of an expression. An operation is identified by its position
/// in the sequence of operations, so every pass must perform the same sequence. It does if the expression
/// branches only on constant values (parameters, value_of() of a series).
template <class T>
class SeriesMemory {
 public:
  /// Prepares for series up to @p order; reuses the memory, of which each coefficient is set before it is
  /// read.
  void start(std::size_t order) {
    stride_ = order + 1;
    used_ = variables_ = 0;
  }
  /// Adds a series of zeros that is set from outside; all variables are added before the first pass.
  [[nodiscard]] std::size_t add_variable() {
    const std::size_t series = add();
    variables_ = used_;
    std::fill_n((*this)[series], stride_, T(0));
    return series;
  }
  /// Starts the pass that computes coefficient @p k of all operations; k = 0, 1, 2, ...
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
  /// Number of the coefficient of the current pass.
  [[nodiscard]] std::size_t pass() const { return pass_; }
  /// The coefficients of a series; valid until the next add().
  [[nodiscard]] T* operator[](std::size_t series) { return coefficient_.data() + series * stride_; }

 private:
  std::size_t stride_ = 1, used_ = 0, variables_ = 0, pass_ = 0;
  std::vector<T> coefficient_;
};

/// A power series in a SeriesMemory, or a constant: scalar for the evaluation of a right-hand side. The
/// operations are those of PowerSeries and give the same coefficients.
template <class T>
class GrowingSeries {
 public:
  using Coefficient = T;  ///< number type

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
  /// Quotient. A divisor with c_0 = 0 gives infinities and NaN, as for numbers.
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

  /// The series with the coefficients next(a, r, k), one per pass; a are the coefficients of this series, r
  /// those of the result below k.
  template <class Next>
  [[nodiscard]] GrowingSeries by_recurrence(const Next& next) const {
    if (is_constant()) return T(next(&constant_, nullptr, 0));
    return result(*this, *this, [&](std::size_t k, const T* r) { return next(data(), r, k); });
  }
  /// The integral of g da from the expansion point, where a is this series; 0 if a is a constant.
  [[nodiscard]] GrowingSeries integral_of(const GrowingSeries& g) const {
    if (is_constant()) return {};
    if (g.is_constant())
      return result(*this, *this,
                    [&](std::size_t k, const T*) { return k == 0 ? T(0) : T(g.constant_ * (*this)[k]); });
    return result(*this, *this, [&](std::size_t k, const T*) {
      return k == 0 ? T(0) : T(recurrence::slope_product(data(), g.data(), k) / static_cast<int>(k));
    });
  }
  /// Two coupled series: r_k = first(a, g, k), then g_k = second(a, r, k).
  template <class First, class Second>
  [[nodiscard]] std::pair<GrowingSeries, GrowingSeries> by_recurrences(const First& first,
                                                                       const Second& second) const {
    if (is_constant()) {
      const T one = first(&constant_, nullptr, 0);
      return {one, T(second(&constant_, &one, 0))};
    }
    SeriesMemory<T>& memory = *memory_;
    const std::size_t one = memory.add(), other = memory.add(), k = memory.pass();
    memory[one][k] = first(data(), memory[other], k);
    memory[other][k] = second(data(), memory[one], k);
    return {GrowingSeries(memory, one), GrowingSeries(memory, other)};
  }
  /// The value of the coefficient c_0.
  friend auto value_of(const GrowingSeries& a) { return value_of(a[0]); }

 private:
  GrowingSeries(SeriesMemory<T>& memory, std::size_t series) : memory_(&memory), series_(series) {}
  [[nodiscard]] bool is_constant() const { return memory_ == nullptr; }
  [[nodiscard]] const T* data() const { return (*memory_)[series_]; }

  /// The result of the next operation of the pass: @p next(k, r) is its coefficient k, r are those below k.
  template <class Next>
  static GrowingSeries result(const GrowingSeries& a, const GrowingSeries& b, const Next& next) {
    SeriesMemory<T>& memory = a.is_constant() ? *b.memory_ : *a.memory_;
    const std::size_t series = memory.add(), k = memory.pass();
    memory[series][k] = next(k, memory[series]);
    return GrowingSeries(memory, series);
  }

  SeriesMemory<T>* memory_ = nullptr;
  std::size_t series_ = 0;
  T constant_{};
};

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// Traits of growing series as entries of Eigen vectors.
template <class T>
struct Eigen::NumTraits<nlmech::GrowingSeries<T>>
    : nlmech::detail::NumberTraits<nlmech::GrowingSeries<T>, 5, 10, 100> {};
/// @endcond
