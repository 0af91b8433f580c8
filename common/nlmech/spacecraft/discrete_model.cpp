#include "nlmech/spacecraft/discrete_model.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
Eigen::MatrixXd DiscreteModel::full_mass() const { throw std::logic_error("full_mass"); }
Eigen::MatrixXd DiscreteModel::full_stiffness() const { throw std::logic_error("full_stiffness"); }
DenseResponse::DenseResponse(const DiscreteModel&, double) { throw std::logic_error("DenseResponse"); }
Response DenseResponse::response(Complex) { throw std::logic_error("DenseResponse"); }
AxisResponse DenseResponse::at_frequency(double) { throw std::logic_error("DenseResponse"); }
Eigen::VectorXd ModalModel::mode_shapes(double) const { throw std::logic_error("ModalModel"); }
ModalModel diagonalise(const DiscreteModel&) { throw std::logic_error("diagonalise"); }
ModalResponse::ModalResponse(const ModalModel& m, double) : total_inertia_(m.total_inertia) {}
Response ModalResponse::response(Complex) const { throw std::logic_error("ModalResponse"); }
AxisResponse ModalResponse::at_frequency(double) const { throw std::logic_error("ModalResponse"); }
}  // namespace nlmech::spacecraft
