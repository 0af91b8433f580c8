#include "nlmech/spacecraft/plant/timoshenko.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/sign_change.hpp"

namespace nlmech::spacecraft {
namespace {

void require_positive(const char* name, double value, bool may_be_zero = false) {
  if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero))
    throw invalid_argument("spacecraft: {} = {} is out of range", name, value);
}

/// Solutions of the field equations at one omega: exp(lambda x) with two values of lambda^2.
class Field {
 public:
  Field(const Parameters& p, const ShearBeam& beam, double omega)
      : ei_(p.bending_stiffness()),
        length_(p.length),
        by_shear_(-omega * omega * p.mass_per_length / beam.shear_stiffness),
        mass_(-omega * omega * p.mass_per_length) {
    // lambda^4 - (e1 + e2) lambda^2 + e1 e2 + beta = 0: the larger root by the formula, the other from the
    // product.
    const double e1 = by_shear_, e2 = -omega * omega * beam.rotary_inertia / ei_, beta = mass_ / ei_;
    const double root = std::sqrt((e1 - e2) * (e1 - e2) - 4 * beta), sum = e1 + e2;
    const double large = std::abs(sum + root) > std::abs(sum - root) ? (sum + root) / 2 : (sum - root) / 2;
    squares_ = {large, (e1 * e2 + beta) / large};
  }

  /// Four solutions (w, psi, M, V) at x, one per column.
  [[nodiscard]] Eigen::Matrix4d at(double x) const {
    Eigen::Matrix4d all;
    all << pair(squares_[0], x), pair(squares_[1], x);
    return all;
  }

 private:
  using Pair = Eigen::Matrix<double, 4, 2>;

  /// Waves that decay from tip and root; for oscillating waves, or waves longer than the beam, an odd and an
  /// even function. Both pairs span the same solutions with the same orientation, so the choice does not
  /// change the sign of the determinant.
  [[nodiscard]] Pair pair(double square, double x) const {
    const double u = std::sqrt(std::abs(square)), d = square - by_shear_;
    Pair columns;
    if (square * length_ * length_ > 1) {
      const double back = std::exp(-u * (length_ - x)), away = std::exp(-u * x);
      columns.col(0) << back, d / u * back, ei_ * d * back, mass_ / u * back;
      columns.col(1) << away, -d / u * away, ei_ * d * away, -mass_ / u * away;
      return columns;
    }
    const double c = square > 0 ? std::cosh(u * x) : std::cos(u * x);
    const double s = u == 0 ? x : (square > 0 ? std::sinh(u * x) : std::sin(u * x)) / u;
    columns.col(0) << square * s, d * c, ei_ * square * d * s, mass_ * c;
    columns.col(1) << c, d * s, ei_ * d * c, mass_ * s;
    return columns;
  }

  double ei_, length_, by_shear_, mass_;
  std::array<double, 2> squares_{};
};

/// Determinant of the five boundary conditions for theta and the amplitudes of the four solutions, each row
/// divided by its largest entry. Its zeros are the natural frequencies.
double determinant(const Parameters& p, const ShearBeam& beam, double omega) {
  const Field field(p, beam, omega);
  const Eigen::Matrix4d root = field.at(0), end = field.at(p.length);
  const double square = omega * omega;
  Eigen::Matrix<double, 5, 5> a = Eigen::Matrix<double, 5, 5>::Zero();
  a.topLeftCorner<2, 4>() = root.topRows<2>();
  a(0, 4) = -p.hub_radius;
  a(1, 4) = -1;
  a.block<1, 4>(2, 0) = end.row(2) - square * p.tip_inertia * end.row(1);
  a.block<1, 4>(3, 0) = end.row(3) - square * p.tip_mass * end.row(0);
  a.block<1, 4>(4, 0) = 2 * (p.hub_radius * root.row(3) + root.row(2));
  a(4, 4) = square * p.hub_inertia;
  for (Eigen::Index i = 0; i < 5; ++i) a.row(i) /= a.row(i).cwiseAbs().maxCoeff();
  return a.partialPivLu().determinant();
}

}  // namespace

ShearBeam solid_section(const Parameters& parameters, double density, double poisson,
                        double shear_coefficient) {
  require_physical(parameters);
  require_positive("density", density);
  require_positive("shear_coefficient", shear_coefficient);
  if (!(poisson > -1 && poisson <= 0.5))
    throw invalid_argument("spacecraft: Poisson's ratio {} is not in (-1, 1/2]", poisson);
  const double area = parameters.mass_per_length / density;
  const double shear_modulus = parameters.youngs_modulus / (2 * (1 + poisson));
  return {shear_coefficient * shear_modulus * area, density * parameters.second_moment};
}

std::vector<double> timoshenko_frequencies(const Parameters& p, const ShearBeam& beam, int count,
                                           double highest) {
  require_physical(p);
  require_cantilever(p, "timoshenko_frequencies");
  require_positive("shear_stiffness", beam.shear_stiffness);
  require_positive("rotary_inertia", beam.rotary_inertia, true);
  if (count < 1 || !(highest > 0))
    throw invalid_argument("timoshenko_frequencies: {} frequencies up to {}", count, highest);
  // Step size: a tenth of a radian of the bending waves, and of the shear and rotation waves.
  const double flexural = std::sqrt(p.mass_per_length / p.bending_stiffness()) * p.length * p.length;
  const double fastest = p.length * std::sqrt(std::max(p.mass_per_length / beam.shear_stiffness,
                                                       beam.rotary_inertia / p.bending_stiffness()));
  const auto f = [&](double omega) { return determinant(p, beam, omega); };
  std::vector<double> found;
  double low = std::min(0.01 / flexural, highest), before = f(low);
  while (static_cast<int>(found.size()) < count && low < highest) {
    const double q = std::sqrt(low * flexural) + 0.1;
    const double high = std::min(q * q / flexural, low + 0.1 / fastest), here = f(high);
    if ((here > 0) != (before > 0)) found.push_back(sign_change(f, low, high));
    low = high;
    before = here;
  }
  return found;
}

}  // namespace nlmech::spacecraft
