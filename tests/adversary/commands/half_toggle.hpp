/// @file
/// A toggle of beam-columns written anew, for hunts: forces by closed forms in long double, stiffness by
/// their differences, the symmetric path by prescribed drops. Nothing of nlmech::frames.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace nlmech::adversary {

using Real = long double;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// (n/4)^(1/2) coth (n/4)^(1/2) = 1 + (n/4) u: u and its derivative by n/4 = y, by Bernoulli's series and
/// circular or hyperbolic functions.
struct Flexibility {
  Real u, slope;
};
[[nodiscard]] Flexibility flexibility(Real y);

/// Negative eigenvalues of both kinds of motions, and the smallest pivot over its diagonal.
struct Inertia {
  int symmetric = 0, antisymmetric = 0;
  Real least = 1;  ///< near 0: the counts are open
};

/// An equilibrium under a prescribed drop.
struct AtDrop {
  Real drop = 0, load = 0, slope = 0;  ///< slope: dW/ddrop
  RealVector x;
  Inertia inertia;
};

/// The left member with m beam-columns: three motions for each node from the first above the base to the
/// apex.
class HalfToggle {
 public:
  HalfToggle(double height, int elements);

  [[nodiscard]] Eigen::Index size() const { return 3 * Eigen::Index{m_}; }
  /// Forces that hold it.
  [[nodiscard]] RealVector force(const RealVector& x) const;
  /// Differences of force().
  [[nodiscard]] RealMatrix stiffness(const RealVector& x) const;
  /// Of the whole toggle whose mirror image the right member is. Small motions that are symmetric leave the
  /// apex upright and on its vertical, antisymmetric ones leave its height.
  [[nodiscard]] Inertia inertia(const RealMatrix& k) const;
  /// On the path from rest, on which half a turn about its middle maps the member on itself, from a shape
  /// nearby; nothing if Newton's iteration does not converge.
  [[nodiscard]] std::optional<AtDrop> at(Real drop, const AtDrop& near) const;
  /// From rest, upwards or downwards, by steps of a share of the height and less, while @p go_on. Members
  /// that have dropped by much less than they buckle at take a share of that: a long step would stay on the
  /// straight shape.
  template <class GoOn>
  [[nodiscard]] std::vector<AtDrop> path(Real sign, Real share, const GoOn& go_on) const {
    std::vector<AtDrop> all = {rest()};
    Real part = 1;
    while (go_on(all.back())) {
      const Real most = std::min(share * rise(), (buckling_drop() + std::abs(all.back().drop)) / 20);
      const auto next = next_of(all.back(), sign * part * most);
      if (next) {
        all.push_back(*next);
        part = std::min<Real>(2 * part, 1);
      } else if ((part /= 2) < 1e-4L) {
        break;
      }
    }
    return all;
  }
  /// Where a straight member would carry 20.19 EI/l^2.
  [[nodiscard]] Real buckling_drop() const { return 20.19L * ei_ / ea_ / rise(); }
  [[nodiscard]] AtDrop rest() const;
  /// What goes with an equilibrium.
  [[nodiscard]] AtDrop described(const RealVector& x) const;
  [[nodiscard]] Real rise() const { return m_ * dy_; }            ///< the height
  [[nodiscard]] Eigen::Index apex() const { return 3 * m_ - 2; }  ///< its vertical motion, upwards

 private:
  [[nodiscard]] Eigen::Matrix<Real, 6, 1> element_force(const Eigen::Matrix<Real, 6, 1>& d) const;
  [[nodiscard]] Eigen::Matrix<Real, 6, 1> ends(const RealVector& x, int element) const;
  /// The mean of a shape and of itself after half a turn: no member bows.
  [[nodiscard]] RealVector turned(const RealVector& x) const;
  [[nodiscard]] RealVector way(const RealMatrix& k) const;  ///< dx/ddrop
  [[nodiscard]] std::optional<AtDrop> next_of(const AtDrop& from, Real step) const;

  int m_;
  Real dx_, dy_, length_;
  Real ea_ = 1.885e6L, ei_ = 9.27e3L;  // Table 2.1
};

}  // namespace nlmech::adversary
