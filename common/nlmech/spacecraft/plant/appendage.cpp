#include "nlmech/spacecraft/plant/appendage.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// (4k + n - 4)!/(4k + n)! for n = 0 to 5: ratio of successive terms.
inline constexpr auto term_ratios = [] {
  std::array<std::array<double, 8>, 6> all{};
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (std::size_t k = 1; k < all[n].size(); ++k) {
      const double m = static_cast<double>(4 * k + n);
      all[n][k] = 1 / (m * (m - 1) * (m - 2) * (m - 3));
    }
  }
  return all;
}();

/// sum over k of t^k/(4k + n)!, eight terms; for |t| <= series_limit the ninth is below 3e-23.
template <class T>
[[nodiscard]] T krylov(const T& t, int n) {
  static constexpr std::array<double, 6> factorials = {1, 1, 2, 6, 24, 120};
  const auto row = static_cast<std::size_t>(n);
  T sum(1.);
  for (std::size_t k = term_ratios[row].size() - 1; k > 0; --k) sum = 1. + sum * (t * term_ratios[row][k]);
  return T(sum / factorials[row]);
}

/// xi^n sum over k of (-b xi^4)^k/(4k + n)!; for n = -1 the derivative of the function n = 0.
template <class T>
[[nodiscard]] T krylov_at(const T& b, double xi, int n) {
  const double square = xi * xi;
  const T t = -(b * (square * square));
  if (n < 0) return T(-(b * (square * xi)) * krylov(t, 3));
  double power = 1;
  for (int i = 0; i < n; ++i) power *= xi;
  return T(power * krylov(t, n));
}

template <class T>
[[nodiscard]] T imaginary_unit() {
  if constexpr (std::is_same_v<T, Jet>)
    return Jet(Complex(0, 1));
  else
    return T(0, 1);
}
template <class T>
[[nodiscard]] double real_part(const T& z) {
  if constexpr (std::is_same_v<T, double>)
    return z;
  else if constexpr (std::is_same_v<T, Jet>)
    return z.value.real();
  else
    return static_cast<double>(z.real());
}
template <class T>
[[nodiscard]] double imaginary_part(const T& z) {
  if constexpr (std::is_same_v<T, double>)
    return 0;
  else if constexpr (std::is_same_v<T, Jet>)
    return z.value.imag();
  else
    return static_cast<double>(z.imag());
}
template <class T>
[[nodiscard]] double size_of(const T& z) {
  return std::hypot(real_part(z), imaginary_part(z));
}

/// Reflection matrix of the tip: C = R A, with the amplitudes of incident and reflected waves at the tip.
template <class T>
struct Reflection {
  T r11, r12, r21, r22;
  T determinant;  ///< of the two tip conditions
};

/// @param i wave2/wave1, i or -i
template <class T>
[[nodiscard]] Reflection<T> reflect(const Ratios& ratios, const T& p, const T& i) {
  // (w'' + b j w')/p^2 = 0 and (w''' - b mu w)/p^3 = 0, in the columns C_1, C_2, A_1, A_2.
  T c11(1.), c12(-1.), c21(1.), c22(-i), a11(1.), a12(-1.), a21(-1.), a22(i);
  if (ratios.tip) {
    const T turn = ratios.inertia * (p * p * p), move = ratios.mass * p;
    c11 = 1. - turn;
    c12 = -1. - i * turn;
    a11 = 1. + turn;
    a12 = i * turn - 1.;
    c21 = 1. + move;
    c22 = move - i;
    a21 = move - 1.;
    a22 = move + i;
  }
  const T determinant = c11 * c22 - c12 * c21;
  return {(c12 * a21 - c22 * a11) / determinant, (c12 * a22 - c22 * a12) / determinant,
          (c21 * a11 - c11 * a21) / determinant, (c21 * a12 - c11 * a22) / determinant, determinant};
}

}  // namespace

template <class T>
Motion<T> motion_by_series(const Ratios& ratios, const T& b) {
  const T t = -b;
  const T k1 = krylov(t, 0), k2 = krylov(t, 1), k3 = krylov(t, 2), k4 = krylov(t, 3);
  const double eta = ratios.hub;
  T a11 = k1, a12 = k2, a21 = t * k4, a22 = k1, e1 = eta * k3 + k4, e2 = eta * k2 + k3;
  if (ratios.tip) {
    const double mu = ratios.mass, j = ratios.inertia;
    const T bj = b * j, bmu = b * mu;
    a11 = a11 + bj * k2;
    a12 = a12 + bj * k3;
    a21 = a21 - bmu * k3;
    a22 = a22 - bmu * k4;
    e1 = e1 - j * (k1 + eta * t * k4);
    e2 = e2 + mu * (eta * k1 + k2);
  }
  Motion<T> motion;
  motion.b = b;
  motion.determinant = a11 * a22 - a12 * a21;
  motion.curvature = e1 * a22 - a12 * e2;
  motion.jerk = a11 * e2 - e1 * a21;
  motion.inertia = eta * motion.jerk - motion.curvature;
  motion.wave_number = std::sqrt(std::sqrt(size_of(b)));
  return motion;
}

template <class T>
Motion<T> motion_by_waves(const Ratios& ratios, const T& b) {
  using std::exp;
  using std::sqrt;
  const T root = sqrt(T(-b)), p = sqrt(root);
  const T unit = imaginary_unit<T>(), i = imaginary_part(p) > 0 ? T(-unit) : unit;
  const T q = i * p, e1 = exp(T(-p)), e2 = exp(T(-q));
  const Reflection<T> r = reflect(ratios, p, i);
  // With amplitudes A at the root, C = R (e A) at the tip, and e C at the root.
  const T g11 = e1 * r.r11 * e1, g12 = e1 * r.r12 * e2, g21 = e2 * r.r21 * e1, g22 = e2 * r.r22 * e2;
  // w = eta and w'/p = 1/p at the root.
  const T m11 = 1. + g11 + g21, m12 = 1. + g12 + g22;
  const T m21 = g11 + i * g21 - 1., m22 = g12 + i * g22 - i;
  const double eta = ratios.hub;
  const T target = 1. / p;

  Motion<T> motion;
  motion.b = b;
  motion.waves = true;
  motion.wave1 = p;
  motion.wave2 = q;
  motion.wave_number = std::sqrt(std::sqrt(size_of(b)));
  motion.exponent = real_part(T(p + q));
  // The Wronskian of the four waves is -16 i p^6 e1 e2; the tip conditions contain p^3 and p^2, the root
  // conditions p. Dividing by it preserves the phase of D_0, which the argument principle needs.
  const T factor = r.determinant * exp(T(p + q - motion.exponent)) / (-16. * i);
  motion.determinant = factor * (m11 * m22 - m12 * m21);
  motion.from_root1 = factor * (eta * m22 - m12 * target);
  motion.from_root2 = factor * (m11 * target - eta * m21);
  const T at_tip1 = e1 * motion.from_root1, at_tip2 = e2 * motion.from_root2;
  motion.from_tip1 = r.r11 * at_tip1 + r.r12 * at_tip2;
  motion.from_tip2 = r.r21 * at_tip1 + r.r22 * at_tip2;

  const T back = e1 * motion.from_tip1;
  const T sum = back + motion.from_root1, difference = back - motion.from_root1;
  const T squared = p * p;
  motion.inertia = 2. * (sum - eta * (p * difference)) / squared;
  motion.curvature = (eta * motion.determinant - 2. * sum) / squared;
  motion.jerk = (motion.determinant * target - 2. * difference) / p;
  return motion;
}

namespace {

/// Derivative of w of order @p order, times D_0 exp(-exponent).
template <class T>
[[nodiscard]] T wave_sum(const Motion<T>& m, double xi, int order) {
  if constexpr (std::is_same_v<T, double>) {
    const double q = m.wave1, away = m.from_root1 * std::exp(-q * xi), c = std::cos(q * xi),
                 s = std::sin(q * xi), back = m.from_tip1 * std::exp(-q * (1 - xi));
    switch (order) {
      case 0: return away + back + m.from_root2 * c + m.from_tip2 * s;
      case 1: return q * (back - away + m.from_tip2 * c - m.from_root2 * s);
      case 2: return q * q * (away + back - m.from_root2 * c - m.from_tip2 * s);
      default: return q * q * q * (back - away + m.from_root2 * s - m.from_tip2 * c);
    }
  } else {
    using std::exp;
    const T p = m.wave1, q = m.wave2;
    T away1 = m.from_root1 * exp(T(-(p * xi))), away2 = m.from_root2 * exp(T(-(q * xi)));
    T back1 = m.from_tip1 * exp(T(-(p * (1 - xi)))), back2 = m.from_tip2 * exp(T(-(q * (1 - xi))));
    for (int k = 0; k < order; ++k) {
      away1 = -(away1 * p);
      away2 = -(away2 * q);
      back1 = back1 * p;
      back2 = back2 * q;
    }
    return T(away1 + away2 + (back1 + back2));
  }
}

}  // namespace

template <class T>
T relative_deflection(const Motion<T>& motion, const Ratios& ratios, double xi, int order) {
  if (motion.waves && motion.wave_number * xi >= 2.5) {
    const T w = wave_sum(motion, xi, order);
    if (order > 1) return T(w / motion.b);
    return T((w - (order == 0 ? ratios.hub + xi : 1.) * motion.determinant) / motion.b);
  }
  const auto k = [&](int n) { return krylov_at(motion.b, xi, n - order); };
  return T(motion.curvature * k(2) + motion.jerk * k(3) - motion.determinant * (ratios.hub * k(4) + k(5)));
}

template Motion<double> motion_by_series(const Ratios&, const double&);
template Motion<Complex> motion_by_series(const Ratios&, const Complex&);
template Motion<Jet> motion_by_series(const Ratios&, const Jet&);
template Motion<Complex> motion_by_waves(const Ratios&, const Complex&);
template Motion<Jet> motion_by_waves(const Ratios&, const Jet&);
template double relative_deflection(const Motion<double>&, const Ratios&, double, int);
template Complex relative_deflection(const Motion<Complex>&, const Ratios&, double, int);
template Jet relative_deflection(const Motion<Jet>&, const Ratios&, double, int);

// w = A exp(-q xi) + C exp(-q (1 - xi)) + F cos(q xi) + G sin(q xi); the root conditions give F = eta - A - E
// C and G = 1/q + A - E C; the tip conditions give A and C.
template <>
Motion<double> motion_by_waves(const Ratios& ratios, const double& b) {
  const double root = std::sqrt(-b), q = std::sqrt(root), e = std::exp(-q), eta = ratios.hub;
  const double c = std::cos(q), s = std::sin(q), inverse = 1 / q;
  // Columns of the tip conditions for A exp(q), C, F and G.
  double a1 = 1, c1 = 1, f1 = -c, g1 = -s, a2 = -1, c2 = 1, f2 = s, g2 = -c;
  if (ratios.tip) {
    const double turn = q * root * ratios.inertia, move = q * ratios.mass;
    a1 += turn;
    c1 -= turn;
    f1 += turn * s;
    g1 -= turn * c;
    a2 += move;
    c2 += move;
    f2 += move * c;
    g2 += move * s;
  }
  const double m11 = e * a1 - f1 + g1, m12 = c1 - e * (f1 + g1);
  const double m21 = e * a2 - f2 + g2, m22 = c2 - e * (f2 + g2);
  const double h1 = -(eta * f1 + inverse * g1), h2 = -(eta * f2 + inverse * g2);

  Motion<double> motion;
  motion.b = b;
  motion.waves = true;
  motion.wave1 = motion.wave2 = motion.wave_number = motion.exponent = q;
  // Divided by the Wronskian of the four functions and the powers of q, D_0 is 1/8 of the determinant.
  motion.determinant = (m11 * m22 - m12 * m21) / 8;
  motion.from_root1 = (h1 * m22 - m12 * h2) / 8;
  motion.from_tip1 = (m11 * h2 - h1 * m21) / 8;
  const double back = e * motion.from_tip1, sum = back + motion.from_root1,
               difference = back - motion.from_root1;
  motion.from_root2 = eta * motion.determinant - sum;
  motion.from_tip2 = inverse * motion.determinant - difference;
  motion.inertia = 2 * (sum - eta * q * difference) / root;
  motion.curvature = (eta * motion.determinant - 2 * sum) / root;
  motion.jerk = (inverse * motion.determinant - 2 * difference) * inverse;
  return motion;
}

namespace {

template <class T>
Motion<T> evaluate(const Ratios& ratios, const T& b, double size, Evaluation evaluation) {
  const bool series =
      evaluation == Evaluation::krylov || (evaluation == Evaluation::automatic && size < series_limit);
  return series ? motion_by_series(ratios, b) : motion_by_waves(ratios, b);
}

}  // namespace

Appendage::Appendage(const Parameters& parameters) : parameters_(parameters) {
  require_physical(parameters);
  const double l = parameters.length, mass = parameters.mass_per_length * l;
  ratios_ = {parameters.hub_radius / l, parameters.tip_mass / mass, parameters.tip_inertia / (mass * l * l),
             parameters.has_tip()};
  inertia_unit_ = mass * l * l;
  beta_unit_ = inertia_unit_ * l / parameters.bending_stiffness();
  deflection_unit_ = l * beta_unit_;
}

Motion<Complex> Appendage::motion(Complex s, Evaluation evaluation) const {
  const Complex b = s * s * beta_unit_;
  return evaluate(ratios_, b, std::abs(b), evaluation);
}

Motion<Jet> Appendage::motion_with_slope(Complex s) const {
  const Jet b(s * s * beta_unit_, 2. * s * beta_unit_);
  return evaluate(ratios_, b, std::abs(b.value), Evaluation::automatic);
}

Motion<double> Appendage::motion_at_frequency(double omega) const {
  const double b = -(omega * omega * beta_unit_);
  return evaluate(ratios_, b, -b, Evaluation::automatic);
}

Complex Appendage::inertia(Complex s) const {
  const Motion<Complex> m = motion(s);
  return inertia(m) / m.determinant;
}

Complex Appendage::deflection(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  return s * s * deflection(m, x) / m.determinant;
}

Complex Appendage::slope(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  return m.b * relative_deflection(m, ratios_, x / parameters_.length, 1) / m.determinant;
}

Complex Appendage::moment(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  const double unit = parameters_.bending_stiffness() / parameters_.length;
  return unit * (m.b * relative_deflection(m, ratios_, x / parameters_.length, 2) / m.determinant);
}

Complex Appendage::shear(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  const double unit = parameters_.bending_stiffness() / (parameters_.length * parameters_.length);
  return unit * (m.b * relative_deflection(m, ratios_, x / parameters_.length, 3) / m.determinant);
}

void Appendage::require_place(double x) const {
  if (!(x >= 0 && x <= parameters_.length))
    throw invalid_argument("spacecraft: x = {} is not on the appendage, 0 to {}", x, parameters_.length);
}

}  // namespace nlmech::spacecraft
