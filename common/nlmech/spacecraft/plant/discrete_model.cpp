#include "nlmech/spacecraft/plant/discrete_model.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

void require_sizes(const DiscreteModel& m) {
  const Eigen::Index n = m.size();
  if (n < 1 || m.mass.rows() != n || m.mass.cols() != n || m.stiffness.rows() != n || m.stiffness.cols() != n)
    throw invalid_argument("DiscreteModel: {} coordinates, mass {} x {}, stiffness {} x {}", n, m.mass.rows(),
                           m.mass.cols(), m.stiffness.rows(), m.stiffness.cols());
}

template <class R>
R judged(R r) {
  if (!is_finite(r.theta) || !is_finite(r.deflection)) r.outcome = Outcome::at_pole;
  return r;
}

}  // namespace

Eigen::MatrixXd DiscreteModel::full_mass() const {
  require_sizes(*this);
  const Eigen::Index n = size();
  Eigen::MatrixXd full(n + 1, n + 1);
  full(0, 0) = total_inertia;
  full.block(1, 0, n, 1) = coupling;
  full.block(0, 1, 1, n) = coupling.transpose();
  full.block(1, 1, n, n) = mass;
  return full;
}

Eigen::MatrixXd DiscreteModel::full_stiffness() const {
  require_sizes(*this);
  const Eigen::Index n = size();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n + 1, n + 1);
  full.block(1, 1, n, n) = stiffness;
  return full;
}

DenseResponse::DenseResponse(const DiscreteModel& model, double x)
    : mass_(model.full_mass()),
      stiffness_(model.full_stiffness()),
      real_(mass_.rows(), mass_.cols()),
      complex_(mass_.rows(), mass_.cols()),
      shape_(model.shape(x)),
      real_solver_(mass_.rows()),
      complex_solver_(mass_.rows()),
      real_solution_(mass_.rows()),
      complex_solution_(mass_.rows()) {}

Response DenseResponse::response(Complex s) {
  const Eigen::Index n = shape_.size();
  complex_ = s * s * mass_ + stiffness_;
  complex_solver_.compute(complex_);
  complex_solution_ = complex_solver_.solve(Eigen::VectorXcd::Unit(n + 1, 0));
  return judged(Response{complex_solution_[0], shape_.dot(complex_solution_.tail(n)), Outcome::success});
}

AxisResponse DenseResponse::at_frequency(double omega) {
  const Eigen::Index n = shape_.size();
  real_ = stiffness_ - omega * omega * mass_;
  real_solver_.compute(real_);
  real_solution_ = real_solver_.solve(Eigen::VectorXd::Unit(n + 1, 0));
  return judged(AxisResponse{real_solution_[0], shape_.dot(real_solution_.tail(n)), Outcome::success});
}

Eigen::VectorXd ModalModel::mode_shapes(double x) const { return vectors.transpose() * shape(x); }

// With theta'' = (u - c^T q'')/J: (M - c c^T/J) q'' + K q = -c u/J. Solved as M' v = (1/omega^2) K v, because
// K is better conditioned than M' and the low frequencies become the large eigenvalues.
ModalModel diagonalise(const DiscreteModel& model) {
  require_sizes(model);
  const Eigen::VectorXd& c = model.coupling;
  const Eigen::MatrixXd reduced = model.mass - c * c.transpose() / model.total_inertia;
  // With scaled coordinates the condition numbers depend on the mode functions alone.
  const Eigen::VectorXd scale = model.stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd k = scale.asDiagonal() * model.stiffness * scale.asDiagonal();
  const Eigen::MatrixXd m = scale.asDiagonal() * reduced * scale.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(m, k);
  if (solver.info() != Eigen::Success || !(solver.eigenvalues().minCoeff() > 0))
    throw std::invalid_argument("diagonalise: mass or stiffness matrix is not positive definite to rounding");
  ModalModel modes;
  modes.hub_inertia = model.hub_inertia;
  modes.total_inertia = model.total_inertia;
  modes.omega = solver.eigenvalues().reverse().cwiseSqrt().cwiseInverse();
  // Eigen normalises to v^T K v = 1; here v^T M' v = 1.
  modes.vectors = scale.asDiagonal() * solver.eigenvectors().rowwise().reverse() * modes.omega.asDiagonal();
  modes.participation = -(modes.vectors.transpose() * c) / model.total_inertia;
  modes.shape = model.shape;
  return modes;
}

ModalResponse::ModalResponse(const ModalModel& model, double x)
    : total_inertia_(model.total_inertia),
      omega_squared_(model.omega.cwiseAbs2()),
      theta_gain_(model.participation.cwiseAbs2()),
      deflection_gain_(model.participation.cwiseProduct(model.mode_shapes(x))) {}

/// Response at s^2 = @p z, which is real on the imaginary axis.
template <class R, class T>
R ModalResponse::sum(const T& z) const {
  R r{1. / (total_inertia_ * z), 0., Outcome::success};
  for (Eigen::Index i = 0; i < omega_squared_.size(); ++i) {
    const T inverse = 1. / (z + omega_squared_[i]);
    r.theta += theta_gain_[i] * inverse;
    r.deflection += deflection_gain_[i] * inverse;
  }
  return judged(r);
}

Response ModalResponse::response(Complex s) const { return sum<Response>(s * s); }
AxisResponse ModalResponse::at_frequency(double omega) const { return sum<AxisResponse>(-omega * omega); }

namespace {

/// Mode functions of xi = x/L.
struct Family {
  /// Writes phi_i, d phi_i/d xi or d^2 phi_i/d xi^2 (order 0, 1, 2) at xi into a column.
  std::function<void(double, int, Eigen::VectorXd&)> evaluate;
  int count;
};

/// Eq. 3.45 with cos(i pi x/L) in place of cos(i pi x)/L. All satisfy phi(0) = phi'(0) = 0 and phi''(L) =
/// phi'''(L) = 0; so none satisfies the boundary conditions of a tip body.
Family polynomial_cosine(int count) {
  return {[count](double xi, int order, Eigen::VectorXd& value) {
            for (int i = 1; i <= count; ++i) {
              const double k = i * std::numbers::pi, sign = i % 2 == 1 ? 1 : -1, angle = k * xi;
              const double half = std::sin(angle / 2);
              double& phi = value[i - 1];
              if (order == 0)
                phi = 2 * half * half + sign * angle * angle / 2;
              else if (order == 1)
                phi = k * (std::sin(angle) + sign * angle);
              else
                phi = k * k * (std::cos(angle) + sign);
            }
          },
          count};
}

/// Eigenfunction of wave number q: amplitudes of the exponentials from root and tip, of cosine and sine, as
/// in motion_by_waves().
struct Resonance {
  double q, from_root, from_tip, cosine, sine;

  [[nodiscard]] double operator()(double xi, int order) const {
    const double away = from_root * std::exp(-q * xi), back = from_tip * std::exp(-q * (1 - xi)),
                 c = std::cos(q * xi), s = std::sin(q * xi);
    if (order == 0) return away + back + cosine * c + sine * s;
    if (order == 1) return q * (back - away + sine * c - cosine * s);
    return q * q * (away + back - cosine * c - sine * s);
  }
};

Family eigenfunctions(const Plant& plant, int count) {
  const Frequencies frequencies = hub_zeros(plant, count);
  if (!frequencies.status.ok()) throw Failure(frequencies.status);
  const Ratios& ratios = plant.appendage().ratios();
  auto all = std::make_shared<std::vector<Resonance>>();
  for (const double omega : frequencies.omega) {
    const double root = omega * std::sqrt(plant.appendage().beta_unit()), q = std::sqrt(root),
                 e = std::exp(-q);
    const double c = std::cos(q), s = std::sin(q);
    // F = -(A + E C) and G = A - E C satisfy the root conditions; w'' = -b j w' at the tip gives A : C, b =
    // -q^4.
    const double turn = ratios.tip ? q * root * ratios.inertia : 0;
    const double of_root = e * (1 + turn) + (c - turn * s) - (s + turn * c);
    const double of_tip = (1 - turn) + e * (c - turn * s) + e * (s + turn * c);
    const double size = std::hypot(of_root, of_tip), a = of_tip / size, t = -of_root / size;
    all->push_back({q, a, t, -(a + e * t), a - e * t});
  }
  return {[all](double xi, int order, Eigen::VectorXd& value) {
            for (std::size_t i = 0; i < all->size(); ++i)
              value[static_cast<Eigen::Index>(i)] = (*all)[i](xi, order);
          },
          count};
}

}  // namespace

// Quadrature panels of two half waves of the shortest function make the integrals exact to rounding.
DiscreteModel assumed_modes(const Parameters& parameters, int count, ModeFunctions functions) {
  const Plant plant(parameters);
  require_cantilever(parameters, "assumed_modes");
  if (count < 1 || count > 400) throw invalid_argument("assumed_modes: {} modes, of 1 to 400", count);
  const Family family =
      functions == ModeFunctions::eigenfunctions ? eigenfunctions(plant, count) : polynomial_cosine(count);
  const double l = parameters.length, rho = parameters.mass_per_length, r = parameters.hub_radius;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(count, count), stiffness = mass;
  Eigen::VectorXd coupling = Eigen::VectorXd::Zero(count), phi(count), bend(count);
  const int panels = count + 4;
  for (int panel = 0; panel < panels; ++panel) {
    for (const auto& [place, weight] : gauss_rule) {
      const double xi = (panel + (1 + place) / 2) / panels, w = weight / 2 / panels;
      family.evaluate(xi, 0, phi);
      family.evaluate(xi, 2, bend);
      coupling += (2 * rho * l * w * (r + l * xi)) * phi;
      mass.selfadjointView<Eigen::Lower>().rankUpdate(phi, 2 * rho * l * w);
      stiffness.selfadjointView<Eigen::Lower>().rankUpdate(
          bend, 2 * parameters.bending_stiffness() * w / (l * l * l));
    }
  }
  if (parameters.has_tip()) {
    Eigen::VectorXd slope(count);
    family.evaluate(1, 0, phi);
    family.evaluate(1, 1, slope);
    slope /= l;
    coupling += 2 * (parameters.tip_mass * (r + l) * phi + parameters.tip_inertia * slope);
    mass.selfadjointView<Eigen::Lower>().rankUpdate(phi, 2 * parameters.tip_mass);
    mass.selfadjointView<Eigen::Lower>().rankUpdate(slope, 2 * parameters.tip_inertia);
  }
  DiscreteModel model;
  model.hub_inertia = parameters.hub_inertia;
  model.total_inertia = parameters.total_inertia();
  model.coupling = coupling;
  model.mass = mass.selfadjointView<Eigen::Lower>();
  model.stiffness = stiffness.selfadjointView<Eigen::Lower>();
  model.shape = [family, plant](double x) {
    plant.appendage().require_place(x);
    Eigen::VectorXd value(family.count);
    family.evaluate(x / plant.parameters().length, 0, value);
    return value;
  };
  return model;
}

namespace {

/// Cubic Hermite functions at t = 0 to 1: deflection and slope times h at the left node, then at the right
/// node.
Eigen::Vector4d hermite(double t) {
  const double s = 1 - t;
  return {(1 + 2 * t) * s * s, t * s * s, t * t * (3 - 2 * t), -t * t * s};
}

/// Integrals over an element of the products of the cubic Hermite functions, divided by h.
Eigen::Matrix4d element_mass() {
  Eigen::Matrix4d m;
  m << 156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4;
  return m / 420;
}

/// Integrals over an element of the products of their second derivatives, times h^3.
Eigen::Matrix4d element_stiffness() {
  Eigen::Matrix4d k;
  k << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4;
  return k;
}

}  // namespace

// Assembled with a free root: the rigid rotation by theta has the node values (r + x, h), and its product
// with the mass matrix is the coupling, exact because the elements contain r + x.
DiscreteModel finite_elements(const Parameters& parameters, int elements) {
  require_physical(parameters);
  if (elements < 1 || elements > 500)
    throw invalid_argument("finite_elements: {} elements, of 1 to 500", elements);
  const Eigen::Index n = 2 * (static_cast<Eigen::Index>(elements) + 1);
  const double l = parameters.length, h = l / elements;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), stiffness = mass;
  Eigen::VectorXd rigid(n);
  for (Eigen::Index i = 0; i < elements; ++i) {
    mass.block<4, 4>(2 * i, 2 * i) += 2 * parameters.mass_per_length * h * element_mass();
    stiffness.block<4, 4>(2 * i, 2 * i) +=
        2 * parameters.bending_stiffness() / (h * h * h) * element_stiffness();
  }
  if (parameters.has_tip()) {
    mass(n - 2, n - 2) += 2 * parameters.tip_mass;
    mass(n - 1, n - 1) += 2 * parameters.tip_inertia / (h * h);
  }
  for (Eigen::Index i = 0; i <= elements; ++i) {
    rigid[2 * i] = parameters.hub_radius + l * static_cast<double>(i) / elements;
    rigid[2 * i + 1] = h;
  }
  const bool turns = std::isfinite(parameters.root_stiffness);
  if (turns) stiffness(1, 1) += 2 * parameters.root_stiffness / (h * h);
  std::vector<Eigen::Index> moving;  // without the coordinates that the ends hold
  for (Eigen::Index i = turns ? 1 : 2; i < n; ++i) {
    if (!(i == n - 2 && parameters.tip_stays()) && !(i == n - 1 && parameters.tip_keeps_slope()))
      moving.push_back(i);
  }
  if (moving.empty())
    throw std::invalid_argument("finite_elements: a single element between clamps is rigid");
  DiscreteModel model;
  model.hub_inertia = parameters.hub_inertia;
  model.total_inertia = parameters.total_inertia();
  model.coupling = (mass * rigid)(moving);
  model.mass = mass(moving, moving);
  model.stiffness = stiffness(moving, moving);
  model.shape = [l, elements, n, moving](double x) {
    if (!(x >= 0 && x <= l))
      throw invalid_argument("finite_elements: x = {} is not on the appendage, 0 to {}", x, l);
    const double at = x / l * elements;
    const int element = std::min(static_cast<int>(at), elements - 1);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
    all.segment<4>(2 * static_cast<Eigen::Index>(element)) = hermite(at - element);
    return Eigen::VectorXd(all(moving));
  };
  return model;
}

}  // namespace nlmech::spacecraft
