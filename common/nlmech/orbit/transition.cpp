#include "nlmech/orbit/transition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Taylor series of a motion in a zonal field and of its variational equation about one state, in units of
/// its distance and of the length of the step, so that the sum is that of the coefficients and no power
/// overflows.
///
/// With H_n = q^(n+3) P''_n(z q), q = 1/r, for which (n - 2) H_n = (2n - 1) z q^2 H_{n-1} - (n + 1) q^2
/// H_{n-2} from H_1 = 0 and H_2 = 3 q^5, and with w_k = J_k R^k (w_0 = -1), the acceleration is
///
///     a = mu (B r - C z^),  B = sum_k w_k (r^2 H_{k+2} - H_k)/(2k + 3),
///                           C = sum_{k>=2} w_k (r^2 H_{k+1} - H_{k-1})/(2k + 1),
///
/// by P''_{n+1} - P''_{n-1} = (2n + 1) P'_n, and its gradient, without trace,
///
///     A = mu (B 1 + D r r^T + E (r z^^T + z^ r^T) + ... z^ z^^T),  D = -sum_k w_k H_{k+2},
///                                                                  E = sum_{k>=2} w_k H_{k+1}.
class VariationalSeries {
 public:
  VariationalSeries(const Gravity& gravity, double tolerance)
      : gravity_(gravity), degree_(gravity.degree()), tolerance_(std::max(tolerance, eps / 4)) {}

  /// Moves @p x by the time @p h. @return d(end)/d(x); not finite if the motion has a singularity there
  TransitionMatrix advance(State& x, double h, int halvings = 0) {
    set_units(x, h);
    if (!expand()) {
      // Beyond the radius of convergence, or near it: in two halves.
      if (halvings == 20) return TransitionMatrix::Constant(std::numeric_limits<double>::quiet_NaN());
      TransitionMatrix m = advance(x, h / 2, halvings + 1);
      if (m.allFinite()) m = advance(x, h / 2, halvings + 1) * m;
      return m;
    }
    return sum(x, h);
  }

 private:
  static constexpr std::size_t most = 64;  ///< coefficients
  static constexpr std::size_t highest = Gravity::most_degree + 3;
  using Row = std::array<double, most>;
  /// Columns of dr, as rows, so that the six are adjacent in memory.
  using Columns = Eigen::Matrix<double, 6, 3>;

  void set_units(const State& x, double h) {
    length_ = std::ldexp(1.0, std::ilogb(x.position.stableNorm()));
    mu_ = gravity_.mu * (h / length_) * (h / length_) / length_;
    const double radius = gravity_.radius / length_;
    weight_[0] = -1;
    for (int k = 2; k <= degree_; ++k)
      weight_[static_cast<std::size_t>(k)] =
          gravity_.zonal[static_cast<std::size_t>(k - 2)] * std::pow(radius, k);
    for (std::size_t i = 0; i < 3; ++i) {
      r_[i][0] = x.position[static_cast<int>(i)] / length_;
      r_[i][1] = x.velocity[static_cast<int>(i)] / length_ * h;
    }
    columns_[0].setZero();
    columns_[1].setZero();
    columns_[0].topRows<3>().setIdentity();
    columns_[1].bottomRows<3>().setIdentity();
  }

  /// sum_{m=0}^{n} a_m b_{n-m}
  static double product(const Row& a, const Row& b, std::size_t n) {
    double even = 0, odd = 0;
    std::size_t m = 0;
    for (; m < n; m += 2) {
      even += a[m] * b[n - m];
      odd += a[m + 1] * b[n - m - 1];
    }
    return m == n ? even + odd + a[n] * b[0] : even + odd;
  }
  /// Coefficient n of f^(-p/2).
  void power(Row& g, int p, std::size_t n) const {
    if (n == 0) {
      g[0] = std::pow(f_[0], -0.5 * p);
      return;
    }
    double sum = 0;
    for (std::size_t m = 1; m <= n; ++m)
      sum += (2 * static_cast<double>(n) + (p - 2) * static_cast<double>(m)) * (f_[m] * g[n - m]);
    g[n] = -sum / (2 * static_cast<double>(n) * f_[0]);
  }

  /// Computes coefficients until those of the matrix are below the tolerance. @return false if they do not
  /// fall so far
  bool expand() {
    double wanted = 0;
    int small = 0;
    for (count_ = 2; count_ < most; ++count_) {
      const std::size_t n = count_ - 2;
      f_[n] = product(r_[0], r_[0], n) + product(r_[1], r_[1], n) + product(r_[2], r_[2], n);
      fields(n);
      const double divisor = static_cast<double>((n + 1) * (n + 2));
      for (std::size_t i = 0; i < 3; ++i) {
        const double axial = i == 2 ? axial_[n] : 0;
        r_[i][n + 2] = mu_ * (product(radial_, r_[i], n) - axial) / divisor;
      }
      gradient(n);
      Columns next = columns_[n] * gradient_[0];
      for (std::size_t m = 1; m <= n; ++m) next += columns_[n - m].lazyProduct(gradient_[m]);
      columns_[n + 2] = next / divisor;
      const double last = static_cast<double>(n + 2) * columns_[n + 2].cwiseAbs().maxCoeff();
      if (n == 0) wanted = tolerance_ * std::min(1.0, last);
      small = last <= wanted ? small + 1 : 0;
      if (small == 2 || !(last < 1e100)) break;
    }
    return small == 2;
  }

  /// Coefficient n of B, C, D and E.
  void fields(std::size_t n) {
    power(h_[2], 5, n);
    if (n == 0) h_[2][0] *= 3;  // the recurrence is homogeneous
    sloping_[n] = -weight_[0] * h_[2][n];
    scaled_[n] = weight_[0] / 3 * h_[2][n];
    power(square_, 2, n);
    by_height_[n] = product(r_[2], square_, n);
    const auto top = static_cast<std::size_t>(degree_);
    for (std::size_t k = 3; k <= top + 2; ++k)
      h_[k][n] = ((2.0 * static_cast<double>(k) - 1) * product(by_height_, h_[k - 1], n) -
                  (static_cast<double>(k) + 1) * product(square_, h_[k - 2], n)) /
                 (static_cast<double>(k) - 2);
    double lower = 0, axial_lower = 0;
    height_[n] = axial_scaled_[n] = 0;
    for (std::size_t k = 2; k <= top; ++k) {
      const double w = weight_[k], first = w / (2.0 * static_cast<double>(k) + 3),
                   second = w / (2.0 * static_cast<double>(k) + 1);
      scaled_[n] += first * h_[k + 2][n];
      lower += first * h_[k][n];
      sloping_[n] -= w * h_[k + 2][n];
      height_[n] += w * h_[k + 1][n];
      axial_scaled_[n] += second * h_[k + 1][n];
      axial_lower += second * h_[k - 1][n];
    }
    radial_[n] = product(f_, scaled_, n) - lower;
    axial_[n] = product(f_, axial_scaled_, n) - axial_lower;
  }

  /// Coefficient n of A.
  void gradient(std::size_t n) {
    for (std::size_t i = 0; i < 2; ++i) slope_[i][n] = product(sloping_, r_[i], n);
    const auto entry = [&](std::size_t i, std::size_t j) { return mu_ * product(slope_[i], r_[j], n); };
    const double xz = entry(0, 2) + mu_ * product(height_, r_[0], n),
                 yz = entry(1, 2) + mu_ * product(height_, r_[1], n);
    const double xx = mu_ * radial_[n] + entry(0, 0), yy = mu_ * radial_[n] + entry(1, 1), xy = entry(0, 1);
    gradient_[n] << xx, xy, xz, xy, yy, yz, xz, yz, -(xx + yy);
  }

  /// Sums the series, the smallest terms first.
  TransitionMatrix sum(State& x, double h) const {
    Columns position = Columns::Zero(), velocity = Columns::Zero();
    x.position.setZero();
    x.velocity.setZero();
    for (std::size_t n = count_ + 1; n-- > 0;) {
      const auto order = static_cast<double>(n);
      position += columns_[n];
      velocity += order * columns_[n];
      const Vector3<double> r(r_[0][n], r_[1][n], r_[2][n]);
      x.position += r;
      x.velocity += order * r;
    }
    x.position *= length_;
    x.velocity *= length_ / h;
    TransitionMatrix m;
    m << position.topRows<3>().transpose(), h * position.bottomRows<3>().transpose(),
        velocity.topRows<3>().transpose() / h, velocity.bottomRows<3>().transpose();
    return m;
  }

  Gravity gravity_;
  int degree_;
  double tolerance_;
  double length_ = 1, mu_ = 1;
  std::array<double, highest> weight_{};
  std::size_t count_ = 0;
  std::array<Row, 3> r_;
  Row f_, square_, by_height_, sloping_, scaled_, height_, axial_scaled_, radial_, axial_;
  std::array<Row, 2> slope_;
  std::array<Row, highest> h_{};  ///< H_n at [n]
  std::array<Matrix<double, 3>, most> gradient_;
  std::array<Columns, most> columns_;
};

}  // namespace

TransitionSolution propagate_transition(const State& start, double t0, double t1, const Gravity& gravity,
                                        const AnalyticContinuation& method, std::span<const double> times,
                                        const TransitionSink& sink, const Limits& limits) {
  VariationalSeries series(gravity, method.tolerance);
  TransitionSolution result;
  TransitionMatrix& transition = result.transition;
  Status failure;
  const bool closed = gravity.degree() == 0;
  const auto over = [&](const Step& step, double t) -> TransitionMatrix {
    if (!closed) {
      State x = step.x0;
      return series.advance(x, t - step.t0) * transition;
    }
    KeplerTransition k = kepler_transition(start, t - t0, gravity.mu);
    if (!k.status.ok()) failure = std::move(k.status);
    return k.transition;
  };
  std::size_t next = 0;
  const auto observe = [&](const Step& step) {
    for (; next < times.size() && std::abs(times[next] - t0) <= std::abs(step.t1 - t0); ++next) {
      if (!sink(times[next], step.at(times[next]), over(step, times[next]))) return false;
    }
    if (!closed || step.t1 == t1) transition = over(step, step.t1);
    if (failure.ok() && !transition.allFinite())
      failure = failed_with(Outcome::non_finite,
                            "{}: the transition matrix at t = {:.17g} is beyond the range of doubles; end "
                            "before that time",
                            method.name, step.t1);
    return failure.ok();
  };
  result.end = propagate(start, t0, t1, gravity, method, observe, limits);
  if (!failure.ok()) result.end.status = std::move(failure);
  return result;
}

}  // namespace nlmech::orbit
