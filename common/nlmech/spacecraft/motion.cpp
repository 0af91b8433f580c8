#include "nlmech/spacecraft/motion.hpp"

#include "nlmech/spacecraft/motion_kernel.hpp"

namespace nlmech::spacecraft {

template Motion<double> motion_by_series(const Ratios&, const double&);
template Motion<Complex> motion_by_series(const Ratios&, const Complex&);
template Motion<Jet> motion_by_series(const Ratios&, const Jet&);
template Motion<Complex> motion_by_waves(const Ratios&, const Complex&);
template Motion<Jet> motion_by_waves(const Ratios&, const Jet&);
template double relative_deflection(const Motion<double>&, const Ratios&, double, int);
template Complex relative_deflection(const Motion<Complex>&, const Ratios&, double, int);
template Jet relative_deflection(const Motion<Jet>&, const Ratios&, double, int);

// w = A exp(-q xi) + C exp(-q (1 - xi)) + F cos(q xi) + G sin(q xi); the root gives F = eta - A - E C and G =
// 1/q + A - E C, the tip the two equations for A and C.
template <>
Motion<double> motion_by_waves(const Ratios& ratios, const double& b) {
  const double root = std::sqrt(-b), q = std::sqrt(root), e = std::exp(-q), eta = ratios.hub;
  const double c = std::cos(q), s = std::sin(q), inverse = 1 / q;
  // Columns at the tip of A exp(q), C, F and G.
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
  // The Wronskian of the four functions and the powers of q divided out leave D_0 = 1/8 of the determinant.
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

}  // namespace nlmech::spacecraft
