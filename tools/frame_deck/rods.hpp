/// @file
/// Chains of elastic rods as a boundary value problem, solved by shooting in extended precision: the limit of
/// frames of more and more elements, by another route.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace nlmech::frame_deck {

/// The numbers of this route.
using Real = long double;

/// A rod at rest, straight or a circular arc, that bends by M = EI (theta' - kappa) and stretches by N/EA.
struct Rod {
  Real length = 1;     ///< along its axis
  Real angle = 0;      ///< of its tangent at its begin, rad
  Real curvature = 0;  ///< at rest, of either sign
  Real ea = 1;         ///< EA
  Real ei = 1;         ///< EI
};

/// What a chain has at one place: x, y, rotation, and the forces and the moment that go with them.
enum class Part { x, y, rotation, horizontal, vertical, moment };

/// Rods end to end, rigidly joined, with dead loads at the ends of each.
struct Chain {
  std::vector<Rod> rods;                   ///< from the origin on
  std::vector<std::array<Real, 3>> loads;  ///< at the end of each rod: x, y, moment, for a load factor of 1
  bool is_clamped = true;                  ///< at its begin; else pinned there
  std::array<Part, 3> fixed{};  ///< at its end: motions held at those of rest, or forces that are 0
};

/// An equilibrium: the force in the begin of the chain, its moment there if it is clamped or else its
/// rotation, and the load factor.
struct Equilibrium {
  std::array<Real, 4> u{};  ///< H, V, moment or rotation, load factor
  Real slope = 0;           ///< of the load factor by the place; 0 at a limit point
  bool is_found = false;    ///< did Newton's iteration converge?
  /// The load factor.
  [[nodiscard]] Real load() const { return u[3]; }
};

/// The displacement by which equilibria are told apart: that of the end of a rod.
struct Place {
  std::size_t rod = 0;  ///< at whose end
  Part part = Part::y;  ///< x, y or rotation
};

/// Equilibria of a chain. Integrated by the Runge-Kutta pair of Fehlberg of order 8 in equal steps, with
/// derivatives by the four unknowns in dual numbers.
class Shooting {
 public:
  /// @param steps of each rod
  Shooting(Chain chain, Place place, int steps) : chain_(std::move(chain)), place_(place), steps_(steps) {}

  /// The equilibrium with that displacement, from one that is near.
  [[nodiscard]] Equilibrium at(Real displacement, const Equilibrium& near) const;
  /// The same from another equilibrium, far away, in equal parts of the displacement.
  [[nodiscard]] Equilibrium reach(Real displacement, int parts, const Equilibrium& from = {}) const;
  /// The determinant of the end conditions by force and moment or rotation at the begin, the load factor
  /// held: 0 where an equilibrium of this chain has a neighbour under the same load.
  [[nodiscard]] Real determinant(const Equilibrium& e) const;
  /// The displacement between two ends at which function(equilibrium) is 0, and that equilibrium.
  template <class Function>
  [[nodiscard]] std::optional<Equilibrium> root(Real low, Real high, Equilibrium near,
                                                const Function& function) const {
    near = at(low, near);
    Real low_value = function(near);
    Real a = low, b = high, before = low_value;
    Equilibrium e = near;
    // The secant rule, held to the bracket.
    Equilibrium other = at(high, near);
    Real value = function(other);
    if (!near.is_found || !other.is_found || (low_value > 0) == (value > 0)) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
      Real next = b - value * (b - a) / (value - before);
      if (!(next > low && next < high)) next = (low + high) / 2;
      e = at(next, e);
      if (!e.is_found) return std::nullopt;
      a = b, before = value, b = next, value = function(e);
      ((value > 0) == (low_value > 0) ? low : high) = next;
      const Real move = b > a ? b - a : a - b;
      if (value == 0 || move < Real(1e-10) * (high > 0 ? high : -high)) return e;
    }
    return std::nullopt;
  }

 private:
  struct End;
  [[nodiscard]] End integrate(const std::array<Real, 4>& u) const;

  Chain chain_;
  Place place_;
  int steps_;
};

}  // namespace nlmech::frame_deck
