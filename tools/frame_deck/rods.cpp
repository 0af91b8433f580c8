#include "tools/frame_deck/rods.hpp"

#include <Eigen/LU>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

#include "nlmech/program/dual.hpp"

namespace nlmech::frame_deck {
namespace {

using D = Dual<Real, 4>;
using Section = std::array<D, 4>;  // x, y, rotation, moment

/// Along one rod the force does not change.
struct Slopes {
  const Rod& rod;
  D h, v;
  void operator()(const Section& s, Section& slope, Real arc) const {
    const D angle = s[2] + (rod.angle + rod.curvature * arc);
    const D c = cos(angle), z = sin(angle), stretch = 1 + (h * c + v * z) / rod.ea;
    const D x = stretch * c, y = stretch * z;
    slope = {x, y, s[3] / rod.ei, h * y - v * x};
  }
};

/// The places of the ends of the rods at rest.
std::vector<std::array<Real, 2>> rest_of(const Chain& chain) {
  std::vector<std::array<Real, 2>> places;
  Real x = 0, y = 0;
  for (const Rod& r : chain.rods) {
    // The chord of an arc halves its angle.
    const Real turn = r.curvature * r.length / 2,
               chord = turn == 0 ? r.length : r.length * std::sin(turn) / turn;
    x += chord * std::cos(r.angle + turn);
    y += chord * std::sin(r.angle + turn);
    places.push_back({x, y});
  }
  return places;
}

}  // namespace

/// What shooting leads to.
struct Shooting::End {
  std::array<D, 3> misses;  ///< of the conditions at the end
  D displacement;           ///< of the place
};

Shooting::End Shooting::integrate(const std::array<Real, 4>& u) const {
  boost::numeric::odeint::runge_kutta_fehlberg78<Section, Real> fehlberg;
  D h = D::variable(u[0], 0), v = D::variable(u[1], 1);
  const D free = D::variable(u[2], 2), load = D::variable(u[3], 3), zero(Real(0));
  Section s{zero, zero, chain_.is_clamped ? zero : free, chain_.is_clamped ? free : zero};
  const auto rest = rest_of(chain_);
  End end;
  for (std::size_t i = 0; i < chain_.rods.size(); ++i) {
    const Rod& rod = chain_.rods[i];
    const Real step = rod.length / static_cast<Real>(steps_);
    for (int k = 0; k < steps_; ++k)
      fehlberg.do_step(Slopes{rod, h, v}, s, static_cast<Real>(k) * step, step);
    if (i == place_.rod)
      end.displacement = place_.part == Part::x   ? s[0] - rest[i][0]
                         : place_.part == Part::y ? s[1] - rest[i][1]
                                                  : s[2];
    h -= load * chain_.loads[i][0];
    v -= load * chain_.loads[i][1];
    s[3] -= load * chain_.loads[i][2];
  }
  const std::array<D, 6> all = {s[0] - rest.back()[0], s[1] - rest.back()[1], s[2], h, v, s[3]};
  for (std::size_t i = 0; i < 3; ++i) end.misses[i] = all[static_cast<std::size_t>(chain_.fixed[i])];
  return end;
}

Equilibrium Shooting::at(Real displacement, const Equilibrium& near) const {
  using Matrix = Eigen::Matrix<Real, 4, 4>;
  using Column = Eigen::Matrix<Real, 4, 1>;
  Equilibrium e = near;
  e.is_found = false;
  Real before = HUGE_VALL;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const End end = integrate(e.u);
    Matrix j;
    Column f;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const D& miss = i < 3 ? end.misses[static_cast<std::size_t>(i)] : end.displacement;
      f[i] = miss.value - (i < 3 ? 0 : displacement);
      for (Eigen::Index k = 0; k < 4; ++k) j(i, k) = miss.partial[static_cast<std::size_t>(k)];
    }
    const Eigen::FullPivLU<Matrix> lu(j);
    const Column step = lu.solve(f);
    Real size = 0;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(i);
      e.u[k] -= step[i];
      size = std::max(size, std::abs(step[i]) / (std::abs(e.u[k]) + Real(1e-6)));
    }
    if (!std::isfinite(size)) return e;
    if (size < Real(1e-16) || (size < Real(1e-11) && size > before / 2)) {
      e.slope = lu.solve(Column(0, 0, 0, 1))[3];
      e.is_found = true;
      return e;
    }
    before = size;
  }
  return e;
}

Equilibrium Shooting::reach(Real displacement, int parts, const Equilibrium& from) const {
  const Real begin = integrate(from.u).displacement.value;
  Equilibrium e = from;
  for (int i = 1; i <= parts; ++i)
    e = at(begin + (displacement - begin) * static_cast<Real>(i) / static_cast<Real>(parts), e);
  return e;
}

Real Shooting::determinant(const Equilibrium& e) const {
  const End end = integrate(e.u);
  Eigen::Matrix<Real, 3, 3> j;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k)
      j(i, k) = end.misses[static_cast<std::size_t>(i)].partial[static_cast<std::size_t>(k)];
  }
  return j.determinant();
}

}  // namespace nlmech::frame_deck
