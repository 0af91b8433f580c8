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

/// xi^n sum over k of (-b xi^4)^k/(4k + n)!; for n = -1 and -2 derivatives of the function n = 0.
template <class T>
[[nodiscard]] T krylov_at(const T& b, double xi, int n) {
  if (n < 0) return T(-(b * krylov_at(b, xi, n + 4)));
  const double square = xi * xi;
  double power = 1;
  for (int i = 0; i < n; ++i) power *= xi;
  return T(power * krylov(T(-(b * (square * square))), n));
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

/// Condition at the tip for the waves: c1 C_1 + c2 C_2 + a1 A_1 + a2 A_2 = e, with the amplitudes A of the
/// incident and C of the reflected waves there.
template <class T>
struct WaveCondition {
  T c1, c2, a1, a2, e;

  [[nodiscard]] T sum(const T& incident1, const T& incident2, const Motion<T>& m) const {
    return T(c1 * m.from_tip1 + c2 * m.from_tip2 + (a1 * incident1 + a2 * incident2));
  }
};

/// The tip: C = R A + G.
template <class T>
struct Reflection {
  T r11, r12, r21, r22;
  T g1{}, g2{};
  T determinant;                 ///< of the two tip conditions
  WaveCondition<T> turn, shift;  ///< of a free tip: (w'' + b j w')/p^2 and (w''' - b mu w)/p^3
};

/// @param i wave2/wave1, i or -i
template <class T>
[[nodiscard]] Reflection<T> reflect(const Ratios& ratios, const T& p, const T& i, Drive drive) {
  WaveCondition<T> turn{T(1.), T(-1.), T(1.), T(-1.), T(0.)}, shift{T(1.), T(-i), T(-1.), i, T(0.)};
  if (ratios.tip) {
    const T j = ratios.inertia * (p * p * p), mu = ratios.mass * p;
    turn = {1. - j, -1. - i * j, 1. + j, i * j - 1., T(0.)};
    shift = {1. + mu, mu - i, mu - 1., mu + i, T(0.)};
  }
  const double theta = drive == Drive::hub ? 1 : 0;
  if (drive == Drive::tip_torque) turn.e = -(p * p);
  WaveCondition<T> one = turn, two = shift;
  if (ratios.tip_keeps_slope) one = {T(1.), i, T(-1.), T(-i), theta / p};
  if (ratios.tip_stays) two = {T(1.), T(1.), T(1.), T(1.), T(theta * (ratios.hub + 1))};
  const T determinant = one.c1 * two.c2 - one.c2 * two.c1;
  Reflection<T> r{.r11 = (one.c2 * two.a1 - two.c2 * one.a1) / determinant,
                  .r12 = (one.c2 * two.a2 - two.c2 * one.a2) / determinant,
                  .r21 = (two.c1 * one.a1 - one.c1 * two.a1) / determinant,
                  .r22 = (two.c1 * one.a2 - one.c1 * two.a2) / determinant,
                  .determinant = determinant,
                  .turn = turn,
                  .shift = shift};
  if (ratios.tip_keeps_slope || ratios.tip_stays || drive == Drive::tip_torque) {
    r.g1 = (one.e * two.c2 - one.c2 * two.e) / determinant;
    r.g2 = (one.c1 * two.e - one.e * two.c1) / determinant;
  }
  return r;
}

/// Condition at the tip, over b: k2 tilt + k3 curvature + k4 jerk = e.
template <class T>
struct SeriesCondition {
  T k2, k3, k4, e;
};

/// Adds the torque of the supports of the tip, reactions times arms, to the load at the root.
/// @param turn, shift what the conditions of a free tip, over b, leave
template <class T>
void add_reactions(const Ratios& ratios, const T& turn, const T& shift, Motion<T>& motion) {
  if (ratios.tip_keeps_slope) motion.inertia = motion.inertia + turn;
  if (ratios.tip_stays) motion.inertia = motion.inertia - (ratios.hub + 1) * shift;
}

}  // namespace

template <class T>
Motion<T> motion_by_series(const Ratios& ratios, const T& b, Drive drive) {
  const T t = -b;
  const T k1 = krylov(t, 0), k2 = krylov(t, 1), k3 = krylov(t, 2), k4 = krylov(t, 3);
  const double eta = ratios.hub;
  SeriesCondition<T> turn{t * k4, k1, k2, eta * k3 + k4}, shift{t * k3, t * k4, k1, eta * k2 + k3};
  if (ratios.tip) {
    const double mu = ratios.mass, j = ratios.inertia;
    const T bj = b * j, bmu = b * mu;
    turn = {turn.k2 + bj * k1, turn.k3 + bj * k2, turn.k4 + bj * k3, turn.e - j * (k1 + eta * t * k4)};
    shift = {shift.k2 - bmu * k2, shift.k3 - bmu * k3, shift.k4 - bmu * k4, shift.e + mu * (eta * k1 + k2)};
  }
  SeriesCondition<T> one = turn, two = shift;
  if (ratios.tip_keeps_slope) one = {k1, k2, k3, krylov(t, 4) + eta * k4};
  if (ratios.tip_stays) two = {k2, k3, k4, eta * krylov(t, 4) + krylov(t, 5)};
  if (drive == Drive::tip_torque) {
    one.e = T(ratios.tip_keeps_slope ? 0. : 1.);
    two.e = T(0.);
  }
  // Curvature and tilt have one unknown, in the ratio of root_slope to root_moment.
  const double stiff = ratios.root_slope, soft = ratios.root_moment;
  const T a11 = stiff * one.k3 + soft * one.k2, a21 = stiff * two.k3 + soft * two.k2;
  const T unknown = one.e * two.k4 - one.k4 * two.e;
  Motion<T> motion;
  motion.b = b;
  motion.theta = drive == Drive::hub ? 1 : 0;
  motion.determinant = a11 * two.k4 - one.k4 * a21;
  motion.curvature = stiff * unknown;
  motion.tilt = soft * unknown;
  motion.jerk = a11 * two.e - one.e * a21;
  motion.inertia = eta * motion.jerk - motion.curvature;
  const auto left = [&motion](const SeriesCondition<T>& c) {
    return T(c.k2 * motion.tilt + c.k3 * motion.curvature + c.k4 * motion.jerk - c.e * motion.determinant);
  };
  if (!ratios.is_cantilever()) add_reactions(ratios, left(turn), left(shift), motion);
  motion.wave_number = std::sqrt(std::sqrt(size_of(b)));
  return motion;
}

template <class T>
Motion<T> motion_by_waves(const Ratios& ratios, const T& b, Drive drive) {
  using std::exp;
  using std::sqrt;
  const T root = sqrt(T(-b)), p = sqrt(root);
  const T unit = imaginary_unit<T>(), i = imaginary_part(p) > 0 ? T(-unit) : unit;
  const T q = i * p, e1 = exp(T(-p)), e2 = exp(T(-q));
  const Reflection<T> r = reflect(ratios, p, i, drive);
  // With amplitudes A at the root, C = R (e A) + G at the tip, and e C at the root.
  const T g11 = e1 * r.r11 * e1, g12 = e1 * r.r12 * e2, g21 = e2 * r.r21 * e1, g22 = e2 * r.r22 * e2;
  const T out1 = e1 * r.g1, out2 = e2 * r.g2;
  // w = eta theta and (root_slope w' - root_moment w'')/p = root_slope theta/p at the root.
  const double eta = ratios.hub, theta = drive == Drive::hub ? 1 : 0, stiff = ratios.root_slope;
  const T soft = ratios.root_moment * p, target = 1. / p;
  const T c1 = stiff - soft, c2 = stiff * i + soft;
  const T m11 = 1. + g11 + g21, m12 = 1. + g12 + g22;
  const T m21 = c1 * g11 + c2 * g21 - (stiff + soft), m22 = c1 * g12 + c2 * g22 + (soft - stiff * i);
  const T h1 = eta * theta - (out1 + out2), h2 = stiff * theta * target - (c1 * out1 + c2 * out2);

  Motion<T> motion;
  motion.b = b;
  motion.theta = theta;
  motion.waves = true;
  motion.wave1 = p;
  motion.wave2 = q;
  motion.wave_number = std::sqrt(std::sqrt(size_of(b)));
  motion.exponent = real_part(T(p + q));
  // The Wronskian of the four waves is -16 i p^6 e1 e2; the tip conditions contain p^3 and p^2 (supported: 1
  // and p), the root conditions p. Dividing by it preserves the phase of D_0, which the argument principle
  // needs.
  const T squared = p * p;
  T factor = r.determinant * exp(T(p + q - motion.exponent)) / (-16. * i);
  if (ratios.tip_keeps_slope) factor = factor * target;
  if (ratios.tip_stays) factor = factor * (target / squared);
  motion.determinant = factor * (m11 * m22 - m12 * m21);
  motion.from_root1 = factor * (h1 * m22 - m12 * h2);
  motion.from_root2 = factor * (m11 * h2 - h1 * m21);
  const T at_tip1 = e1 * motion.from_root1, at_tip2 = e2 * motion.from_root2;
  motion.from_tip1 = r.r11 * at_tip1 + r.r12 * at_tip2 + r.g1 * motion.determinant;
  motion.from_tip2 = r.r21 * at_tip1 + r.r22 * at_tip2 + r.g2 * motion.determinant;

  const T back = e1 * motion.from_tip1;
  const T sum = back + motion.from_root1, difference = back - motion.from_root1;
  motion.inertia = 2. * (sum - eta * (p * difference)) / squared;
  motion.curvature = (eta * theta * motion.determinant - 2. * sum) / squared;
  T slope = theta * motion.determinant * target;  // w'(0)/p
  if (ratios.root_moment > 0) {
    slope = difference + i * (e2 * motion.from_tip2 - motion.from_root2);
    motion.tilt = stiff >= 0.5 ? T(motion.curvature * (ratios.root_moment / stiff))
                               : T((slope * p - theta * motion.determinant) / b);
    motion.inertia = motion.inertia - eta * (squared * motion.tilt);
  }
  motion.jerk = (slope - 2. * difference) / p;
  if (!ratios.is_cantilever())
    add_reactions(ratios, T(-(r.turn.sum(at_tip1, at_tip2, motion) / squared)),
                  T(-(r.shift.sum(at_tip1, at_tip2, motion) / p)), motion);
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
  // Exactly what the support holds; else rounding would decide.
  if (xi == 1 && ((order == 0 && ratios.tip_stays) || (order == 1 && ratios.tip_keeps_slope))) return T(0.);
  if (motion.waves && motion.wave_number * xi >= 2.5) {
    const T w = wave_sum(motion, xi, order);
    if (order > 1) return T(w / motion.b);
    return T((w - motion.theta * (order == 0 ? ratios.hub + xi : 1.) * motion.determinant) / motion.b);
  }
  const auto k = [&](int n) { return krylov_at(motion.b, xi, n - order); };
  const T w = motion.curvature * k(2) + motion.jerk * k(3) -
              motion.theta * motion.determinant * (ratios.hub * k(4) + k(5));
  return ratios.root_moment > 0 ? T(w + motion.tilt * k(1)) : w;
}

template Motion<double> motion_by_series(const Ratios&, const double&, Drive);
template Motion<Complex> motion_by_series(const Ratios&, const Complex&, Drive);
template Motion<Jet> motion_by_series(const Ratios&, const Jet&, Drive);
template Motion<Complex> motion_by_waves(const Ratios&, const Complex&, Drive);
template Motion<Jet> motion_by_waves(const Ratios&, const Jet&, Drive);
template double relative_deflection(const Motion<double>&, const Ratios&, double, int);
template Complex relative_deflection(const Motion<Complex>&, const Ratios&, double, int);
template Jet relative_deflection(const Motion<Jet>&, const Ratios&, double, int);

namespace {

/// The motion of waves at s = j omega by real numbers: exp(-j q xi) and exp(j q xi) as cosine and sine.
Motion<double> real_motion(const Motion<Complex>& m) {
  Motion<double> real;
  real.b = m.b.real();
  real.determinant = m.determinant.real();
  real.inertia = m.inertia.real();
  real.curvature = m.curvature.real();
  real.jerk = m.jerk.real();
  real.tilt = m.tilt.real();
  real.theta = m.theta;
  real.exponent = m.exponent;
  real.waves = true;
  real.wave1 = real.wave2 = real.wave_number = m.wave_number;
  real.from_root1 = m.from_root1.real();
  real.from_tip1 = m.from_tip1.real();
  const Complex back = m.from_tip2 * std::exp(-m.wave2);
  real.from_root2 = (m.from_root2 + back).real();
  real.from_tip2 = (m.from_root2 - back).imag();
  return real;
}

}  // namespace

// w = A exp(-q xi) + C exp(-q (1 - xi)) + F cos(q xi) + G sin(q xi); the root conditions give F = eta - A - E
// C and G = 1/q + A - E C; the tip conditions give A and C.
template <>
Motion<double> motion_by_waves(const Ratios& ratios, const double& b, Drive drive) {
  if (!ratios.is_cantilever() || drive != Drive::hub)
    return real_motion(motion_by_waves(ratios, Complex(b), drive));
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
  if (std::isfinite(parameters.root_stiffness)) {
    const double kappa = parameters.root_ratio();
    ratios_.root_slope = kappa / (1 + kappa);
    ratios_.root_moment = 1 / (1 + kappa);
  }
  ratios_.tip_stays = parameters.tip_stays();
  ratios_.tip_keeps_slope = parameters.tip_keeps_slope();
  inertia_unit_ = mass * l * l;
  beta_unit_ = inertia_unit_ * l / parameters.bending_stiffness();
  deflection_unit_ = l * beta_unit_;
}

Motion<Complex> Appendage::motion(Complex s, Evaluation evaluation) const {
  const Complex b = s * s * beta_unit_;
  return evaluate(ratios_, b, std::abs(b), evaluation);
}

Motion<Complex> Appendage::motion_by_tip_torque(Complex s) const {
  const Complex b = s * s * beta_unit_;
  return std::abs(b) < series_limit ? motion_by_series(ratios_, b, Drive::tip_torque)
                                    : motion_by_waves(ratios_, b, Drive::tip_torque);
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
