/// @file
/// Spatial discretisation by assumed modes (Eqs. 3.44-3.48, corrected) or finite elements: mass and stiffness
/// matrices, dense and diagonalised frequency response, poles.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstdint>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/spacecraft/plant/plant.hpp"

namespace nlmech::spacecraft {

/// y(x, t) = sum q_i(t) phi_i(x) (Eq. 3.44) with
///
///     J theta'' + c^T q'' = u,   c theta'' + M q'' + K q = 0     (Eqs. 3.47, 3.48 corrected).
///
/// All entries are sums over both appendages.
struct DiscreteModel {
  double hub_inertia = 0;                        ///< I_hub, slug ft^2
  double total_inertia = 0;                      ///< J, slug ft^2
  Eigen::VectorXd coupling;                      ///< c = M_theta_q
  Eigen::MatrixXd mass;                          ///< M = M_qq, symmetric, positive definite
  Eigen::MatrixXd stiffness;                     ///< K = K_qq, symmetric, positive definite
  std::function<Eigen::VectorXd(double)> shape;  ///< phi(x), x from 0 to L in ft

  /// Number of coordinates q.
  [[nodiscard]] Eigen::Index size() const { return coupling.size(); }
  /// Mass matrix with theta as first coordinate: M x'' + K x = (u, 0) (Eq. 3.47).
  /// @throws std::invalid_argument if sizes differ
  [[nodiscard]] Eigen::MatrixXd full_mass() const;
  /// Stiffness matrix with theta as first coordinate, whose row and column are 0.
  /// @throws std::invalid_argument if sizes differ
  [[nodiscard]] Eigen::MatrixXd full_stiffness() const;
};

/// Family of mode functions of x.
enum class ModeFunctions : std::uint8_t {
  polynomial_cosine,  ///< 1 - cos(i pi x/L) + (-1)^(i+1) (i pi x/L)^2/2: Eq. 3.45 with the argument corrected
  eigenfunctions      ///< mode shapes of the appendage with its tip body on a locked hub
};

/// Assumed-modes model with @p count modes.
/// @throws std::invalid_argument if count is not 1 to 400, or as require_physical() and require_cantilever()
/// @throws nlmech::Failure if the frequencies of the eigenfunctions are not found
[[nodiscard]] DiscreteModel assumed_modes(const Parameters& parameters, int count,
                                          ModeFunctions functions = ModeFunctions::polynomial_cosine);

/// Finite element model: cubic Hermite beam elements of equal length with consistent mass, @p elements per
/// appendage, 2 coordinates per node (deflection, slope times element length), with any ends. Poles and
/// responses converge with the fourth power of the element length; tests check the observed order to 0.2.
/// @throws std::invalid_argument if elements is not 1 to 500, or as require_physical()
[[nodiscard]] DiscreteModel finite_elements(const Parameters& parameters, int elements);

/// Frequency response by a dense solve of (s^2 M + K) x = e_1 at every s: LU factorisation with row pivoting.
/// Does not allocate after construction; use one object per thread.
class DenseResponse {
 public:
  /// @param model discrete model; copied
  /// @param x place of the deflection, ft
  /// @throws std::invalid_argument if sizes differ
  DenseResponse(const DiscreteModel& model, double x);
  /// theta/u and y(x)/u; at_pole if they are not finite, as for a singular matrix.
  [[nodiscard]] Response response(Complex s);
  /// The same at s = j omega in real arithmetic.
  [[nodiscard]] AxisResponse at_frequency(double omega);

 private:
  Eigen::MatrixXd mass_, stiffness_, real_;
  Eigen::MatrixXcd complex_;
  Eigen::VectorXd shape_;  ///< phi(x)
  Eigen::PartialPivLU<Eigen::MatrixXd> real_solver_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> complex_solver_;
  Eigen::VectorXd real_solution_;
  Eigen::VectorXcd complex_solution_;
};

/// The diagonalised model:
///
///     theta/u = 1/(J s^2) + sum b_i^2/(s^2 + omega_i^2),   y(x)/u = sum b_i psi_i(x)/(s^2 + omega_i^2).
///
/// In time: eta_i'' + omega_i^2 eta_i = b_i u, theta = double integral of u/J + sum b_i eta_i, y = sum psi_i
/// eta_i.
struct ModalModel {
  double hub_inertia = 0;                        ///< I_hub, slug ft^2
  double total_inertia = 0;                      ///< J, slug ft^2
  Eigen::VectorXd omega;                         ///< poles of the model, rising, rad/s
  Eigen::VectorXd participation;                 ///< b_i
  Eigen::MatrixXd vectors;                       ///< column i: q for eta_i = 1
  std::function<Eigen::VectorXd(double)> shape;  ///< phi(x) of the coordinates q

  /// psi(x): deflection of each mode at x.
  [[nodiscard]] Eigen::VectorXd mode_shapes(double x) const;
};

/// Diagonalises the model. Relative accuracy of a pole: eps (omega_i/omega_1)^2 times the condition number of
/// the mode functions (ten assumed modes: 1e-10).
/// @throws std::invalid_argument if a matrix is not positive definite or sizes differ
[[nodiscard]] ModalModel diagonalise(const DiscreteModel& model);

/// Frequency response of the diagonalised model at one place.
class ModalResponse {
 public:
  /// @param model diagonalised model; no reference is kept
  /// @param x place of the deflection, ft
  ModalResponse(const ModalModel& model, double x);
  /// theta/u and y(x)/u; at_pole where a denominator is 0.
  [[nodiscard]] Response response(Complex s) const;
  /// The same at s = j omega in real arithmetic.
  [[nodiscard]] AxisResponse at_frequency(double omega) const;

 private:
  template <class R, class T>
  [[nodiscard]] R sum(const T& z) const;
  double total_inertia_;
  Eigen::VectorXd omega_squared_, theta_gain_, deflection_gain_;
};

}  // namespace nlmech::spacecraft
