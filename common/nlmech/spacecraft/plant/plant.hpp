/// @file
/// Exact transfer functions of the spacecraft from hub torque u to hub angle theta and deflection y(x)
/// (corrected Eqs. 3.38, 3.39, 3.42).
#pragma once

#include <span>

#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/appendage.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// Both transfer functions at one s.
struct Response {
  Complex theta;       ///< theta/u, rad/(lb ft); even in s
  Complex deflection;  ///< y(x)/u, ft/(lb ft) = 1/lb, positive in the direction of positive rotation
  Outcome outcome;     ///< success; at_pole: the values are infinite or have no correct digits; non_finite
};

/// Both transfer functions at s = j omega, where they are real.
struct AxisResponse {
  double theta;       ///< theta/u, rad/(lb ft)
  double deflection;  ///< y(x)/u, 1/lb
  Outcome outcome;    ///< as in Response
};

/// Open-loop spacecraft: hub and two appendages.
///
///     theta/u = 1/(s^2 (I_hub + 2 B(s))),   y(x)/u = g_3(x) theta/u,   y_1 = y_2.
///
/// Accuracy: as class Appendage. Returns `at_pole` where the denominator is 0 to within the rounding of s. s
/// = 0 is a double pole of theta/u; y(x)/u is finite and accurate there.
class Plant {
 public:
  /// @throws std::invalid_argument as require_physical()
  explicit Plant(const Parameters& parameters);

  /// The parameters given to the constructor.
  [[nodiscard]] const Parameters& parameters() const { return appendage_.parameters(); }
  /// The solution of one appendage.
  [[nodiscard]] const Appendage& appendage() const { return appendage_; }

  /// theta/u and y(x)/u at @p s.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Response response(Complex s, double x) const;
  /// theta/u, and y/u at several places @p x.
  /// @param[out] theta theta/u
  /// @param[out] y y(x)/u, one for each x
  /// @throws std::invalid_argument if an x is outside 0 to L, or the sizes differ
  [[nodiscard]] Outcome response(Complex s, std::span<const double> x, Complex& theta,
                                 std::span<Complex> y) const;
  /// theta/u and y(x)/u at s = j omega: real arithmetic, at most a microsecond.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] AxisResponse at_frequency(double omega, double x) const;
  /// Both functions for a unit torque on each of the two tips in place of the hub's: theta/tau = 2
  /// w'(L)/theta times theta/u by reciprocity, y(x)/tau the sum of that rotation's deflection and of the
  /// deflection with the hub at rest. Within a relative distance d of a zero of theta/u their rounding errors
  /// are eps/d of y.
  /// @throws std::invalid_argument if an x is outside 0 to L, or the sizes differ
  [[nodiscard]] Outcome tip_torque_response(Complex s, std::span<const double> x, Complex& theta,
                                            std::span<Complex> y) const;
  /// theta/u at @p s.
  [[nodiscard]] Response response(Complex s) const { return response(s, 0.); }

  /// lim s^2 theta/u for s to 0: 1/J, unless Parameters::swings().
  [[nodiscard]] double rigid_gain() const { return 1 / parameters().total_inertia(); }
  /// lim y(x)/u for s to 0, a polynomial of degree 5 in x, 1/lb; infinite if Parameters::swings().
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] double static_deflection(double x) const;

  /// (I_hub + kappa B) D_0 exp(-exponent). For kappa = 2 an entire function of s^2 whose zeros are the poles
  /// of both transfer functions except s = 0; for kappa = 2 + k_2 a term of the closed loop's characteristic
  /// function.
  template <class T>
  [[nodiscard]] T effective_inertia(const Motion<T>& motion, double kappa = 2) const {
    return parameters().hub_inertia * motion.determinant + kappa * appendage_.inertia(motion);
  }

  /// Status with the message for @p outcome at @p s.
  [[nodiscard]] Status status(Outcome outcome, Complex s) const;

 private:
  Appendage appendage_;
};

/// Whether @p sum = |a + b| is 0 to within the rounding of s. @p size is |a| + |b|; @p waves = |beta|^(1/4) L
/// is the amplification of a relative change of s.
[[nodiscard]] bool vanishes(double sum, double size, double waves);

}  // namespace nlmech::spacecraft
