#include "nlmech/spacecraft/plant/timoshenko.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

using Matrix4 = Eigen::Matrix4cd;
using Vector4 = Eigen::Vector4cd;

void require_positive(const char* name, double value, bool may_be_zero = false) {
  if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero))
    throw invalid_argument("spacecraft: {} = {} is out of range", name, value);
}

/// Constants of the field equations at one s.
struct Field {
  Complex z;   ///< s^2
  double ei;   ///< EI
  double rho;  ///< mass per length
  double shear;
  double rotary;
  double length;
};

/// The two roots lambda^2 of lambda^4 - (e1 + e2) lambda^2 + e1 e2 + beta = 0, the larger by the formula, the
/// other from the product of both.
std::array<Complex, 2> squares(const Field& f) {
  const Complex e1 = f.z * (f.rho / f.shear), e2 = f.z * (f.rotary / f.ei), beta = f.z * (f.rho / f.ei);
  const Complex root = std::sqrt((e1 - e2) * (e1 - e2) - 4. * beta), sum = e1 + e2;
  const Complex large = std::abs(sum + root) > std::abs(sum - root) ? (sum + root) / 2. : (sum - root) / 2.;
  return {large, (e1 * e2 + beta) / large};
}

/// Are the two solutions that belong to lambda^2 waves that decay from root and tip? Else an even and an odd
/// function: where the wave is longer than the beam, or does not decay at all.
bool decays(const Field& f, Complex square) {
  const bool real = square.imag() == 0 && square.real() < 0;
  return !real && std::abs(square) * f.length * f.length > 1;
}

/// States (w, psi, M, V) at x of these two.
void pair(const Field& f, Complex square, double x, Eigen::Ref<Eigen::Matrix<Complex, 4, 2>> columns) {
  const Complex u = std::sqrt(square), d = square - f.z * (f.rho / f.shear), mass = f.z * f.rho;
  if (decays(f, square)) {
    for (int k = 0; k < 2; ++k) {
      const double way = k == 0 ? -1 : 1, run = k == 0 ? x : f.length - x;
      const Complex e = std::exp(-u * run);
      columns.col(k) << e, way * d / u * e, f.ei * d * e, way * mass / u * e;
    }
    return;
  }
  const Complex c = std::cosh(u * x), s = u == 0. ? Complex(x) : std::sinh(u * x) / u;
  columns.col(0) << square * s, d * c, f.ei * square * d * s, mass * c;
  columns.col(1) << c, d * s, f.ei * d * c, mass * s;
}

Matrix4 basis(const Field& f, const std::array<Complex, 2>& square, double x) {
  Matrix4 all;
  pair(f, square[0], x, all.leftCols<2>());
  pair(f, square[1], x, all.rightCols<2>());
  return all;
}

/// Relative states (y, psi - 1, M, V)/s^2 at x by power series: column 0 from rest under the inertia of the
/// rigid rotation, columns 1 and 2 for a unit moment and a unit shear at the root.
Eigen::Matrix<Complex, 4, 3> series(const Field& f, double radius, double x) {
  Eigen::Matrix<Complex, 4, 3> sum = Eigen::Matrix<Complex, 4, 3>::Zero(), term = sum;
  term(2, 1) = term(3, 2) = sum(2, 1) = sum(3, 2) = 1;
  for (int k = 1; k <= 60; ++k) {
    Eigen::Matrix<Complex, 4, 3> next;
    next.row(0) = term.row(1) + term.row(3) / f.shear;
    next.row(1) = term.row(2) / f.ei;
    next.row(2) = f.z * f.rotary * term.row(1) - term.row(3);
    next.row(3) = f.z * f.rho * term.row(0);
    if (k == 1) {
      next(2, 0) += f.rotary;
      next(3, 0) += f.rho * radius;
    }
    if (k == 2) next(3, 0) += f.rho * x;
    term = next * (x / k);
    sum += term;
  }
  return sum;
}

}  // namespace

/// Per unit of theta.
struct TimoshenkoPlant::Solution {
  Complex inertia;      ///< B
  Complex deflection;   ///< y(x)/s^2
  Complex determinant;  ///< 0 where the appendage resonates with the hub locked; real at s = j omega
  int way;              ///< how it was found: determinants found in the same way are one smooth function of s
};

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

TimoshenkoPlant::TimoshenkoPlant(const Parameters& parameters, const ShearBeam& beam)
    : parameters_(parameters), beam_(beam) {
  require_physical(parameters);
  require_positive("shear_stiffness", beam.shear_stiffness);
  require_positive("rotary_inertia", beam.rotary_inertia, true);
}

TimoshenkoPlant::Solution TimoshenkoPlant::solve(Complex s, double x) const {
  const Parameters& p = parameters_;
  const double l = p.length, r = p.hub_radius, reach = r + l;
  const Field f = {
      s * s, p.bending_stiffness(), p.mass_per_length, beam_.shear_stiffness, beam_.rotary_inertia, l};
  const std::array<Complex, 2> square = squares(f);
  if (f.z == 0. || std::abs(square[0]) * l * l < 9) {
    // M(L) = -s^2 I_tip psi(L) and V(L) = -s^2 m w(L), divided by s^2.
    const auto end = series(f, r, l);
    Eigen::Matrix<Complex, 1, 3> moment = end.row(2), shear = end.row(3);
    if (p.has_tip()) {
      moment += p.tip_inertia * f.z * end.row(1);
      shear += p.tip_mass * f.z * end.row(0);
      moment[0] += p.tip_inertia;
      shear[0] += p.tip_mass * reach;
    }
    const Complex determinant = moment[1] * shear[2] - moment[2] * shear[1];
    const Complex m0 = (moment[2] * shear[0] - moment[0] * shear[2]) / determinant;
    const Complex v0 = (moment[0] * shear[1] - moment[1] * shear[0]) / determinant;
    const auto here = series(f, r, x);
    return {-(r * v0 + m0), here(0, 0) + m0 * here(0, 1) + v0 * here(0, 2), determinant, 0};
  }
  const Matrix4 root = basis(f, square, 0), end = basis(f, square, l);
  Matrix4 a;
  a.topRows<2>() = root.topRows<2>();
  a.row(2) = end.row(2);
  a.row(3) = end.row(3);
  if (p.has_tip()) {
    a.row(2) += f.z * p.tip_inertia * end.row(1);
    a.row(3) += f.z * p.tip_mass * end.row(0);
  }
  Vector4 right(r, 1, 0, 0);
  for (int i = 0; i < 4; ++i) {
    const double size = a.row(i).cwiseAbs().maxCoeff();
    a.row(i) /= size;
    right[i] /= size;
  }
  const Eigen::FullPivLU<Matrix4> solver(a);
  const Vector4 amplitude = solver.solve(right);
  const Complex m0 = root.row(2) * amplitude, v0 = root.row(3) * amplitude;
  const Complex w = basis(f, square, x).row(0) * amplitude;
  return {-(r * v0 + m0) / f.z, (w - (r + x)) / f.z, solver.determinant(),
          1 + (decays(f, square[0]) ? 1 : 0) + (decays(f, square[1]) ? 2 : 0)};
}

Response TimoshenkoPlant::response(Complex s, double x) const {
  if (!(x >= 0 && x <= parameters_.length))
    throw invalid_argument("spacecraft: x = {} is not on the appendage, 0 to {}", x, parameters_.length);
  const Solution a = solve(s, x);
  const Complex sum = parameters_.hub_inertia + 2. * a.inertia;
  Response r{1. / (s * s * sum), a.deflection / sum, Outcome::success};
  const double q =
      std::pow(std::norm(s) * parameters_.mass_per_length / parameters_.bending_stiffness(), 0.25);
  if (!std::isfinite(std::abs(a.inertia)))
    r.outcome = Outcome::non_finite;
  else if (vanishes(std::abs(sum), parameters_.hub_inertia + 2 * std::abs(a.inertia),
                    q * parameters_.length) ||
           !std::isfinite(std::abs(r.theta)))
    r.outcome = Outcome::at_pole;
  return r;
}

Complex TimoshenkoPlant::inertia(Complex s) const { return solve(s, 0).inertia; }

double TimoshenkoPlant::cutoff() const {
  return beam_.rotary_inertia > 0 ? std::sqrt(beam_.shear_stiffness / beam_.rotary_inertia)
                                  : std::numeric_limits<double>::infinity();
}

// The determinant times I_hub + 2 B vanishes at the poles alone. Where the determinant changes from one
// smooth function to another, and to tell a zero from such a change, I_hub + 2 B is asked: it rises through
// zero at a pole, for all its terms store energy, and jumps down at a resonance with the hub locked.
std::vector<double> TimoshenkoPlant::poles(int count, double highest) const {
  if (count < 1 || !(highest > 0))
    throw invalid_argument("TimoshenkoPlant: {} poles up to {}", count, highest);
  struct Sample {
    double omega, sum, product;
    int way;
  };
  const Parameters& p = parameters_;
  const double l = p.length, ei = p.bending_stiffness();
  const auto at = [&](double omega) {
    const Solution a = solve({0, omega}, 0);
    const double sum = p.hub_inertia + 2 * a.inertia.real();
    return Sample{omega, sum, sum * a.determinant.real(), a.way};
  };
  const double flexural = std::sqrt(p.mass_per_length / ei) * l * l;
  const double fastest =
      l * std::sqrt(std::max(p.mass_per_length / beam_.shear_stiffness, beam_.rotary_inertia / ei));
  std::vector<double> found;
  Sample low = at(0);
  while (static_cast<int>(found.size()) < count && low.omega < highest) {
    const double q = std::sqrt(low.omega * flexural) + 0.1;
    const Sample high = at(std::min(q * q / flexural, low.omega + 0.1 / fastest));
    const bool smooth = low.way == high.way;
    if (smooth ? (low.product > 0) != (high.product > 0) : low.sum < 0 && high.sum > 0) {
      Sample a = low, b = high;
      for (;;) {
        const double middle = a.omega + (b.omega - a.omega) / 2;
        if (middle <= a.omega || middle >= b.omega) break;
        const Sample m = at(middle);
        const bool left = smooth ? (m.product > 0) == (a.product > 0) : m.sum < 0;
        (left ? a : b) = m;
      }
      if (a.sum <= 0 && b.sum >= 0) found.push_back(b.omega);
    }
    low = high;
  }
  return found;
}

}  // namespace nlmech::spacecraft
