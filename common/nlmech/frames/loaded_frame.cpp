#include "nlmech/frames/loaded_frame.hpp"

#include <cmath>
#include <utility>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {

LoadedFrame::LoadedFrame(const Frame& frame, Eigen::VectorXd direction)
    : frame_(frame), direction_(std::move(direction)) {
  if (direction_.size() != frame.size() || !direction_.allFinite()) {
    throw invalid_argument("LoadedFrame: {} forces for {} unknowns, or some are not finite",
                           direction_.size(), frame.size());
  }
}

void LoadedFrame::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  status_ = frame_.force(x, f);
  if (has_values(status_))
    f -= load * direction_;
  else
    f.setConstant(nan);
}

void LoadedFrame::linearise(const Eigen::VectorXd& x, double load) {
  static_cast<void>(load);
  status_ = frame_.tangent(x, tangent_);
  if (!has_values(status_)) tangent_.coeffs().setConstant(nan);
}

bool LoadedFrame::long_matrix(const algebraic::LongVector& x, double load,
                              Eigen::SparseMatrix<long double>& k) {
  static_cast<void>(load);
  return has_values(frame_.tangent<long double>(x, k));
}

bool LoadedFrame::long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) {
  algebraic::LongVector forces;
  status_ = frame_.force<long double>(x, forces);
  if (has_values(status_))
    f = (forces - load * direction_.cast<long double>()).cast<double>();
  else
    f.setConstant(size(), nan);
  return true;
}

LoadedWilliams::LoadedWilliams(const Williams& toggle) : toggle_(toggle) {
  for (const double number : {toggle.height, toggle.length, toggle.ea, toggle.ei}) {
    if (!(number > 0 && std::isfinite(number)))
      throw invalid_argument("LoadedWilliams: {} among height, length, EA, EI; all are positive", number);
  }
}

void LoadedWilliams::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  const bool exists = toggle_.outcome(x[0]) == Outcome::success;
  f.setConstant(1, exists ? (toggle_.load(x[0]) - load) / 2 : nan);
}

void LoadedWilliams::linearise(const Eigen::VectorXd& x, double load) {
  static_cast<void>(load);
  slope_ = toggle_.outcome(x[0]) == Outcome::success ? toggle_.stiffness(x[0]) / 2 : nan;
}

}  // namespace nlmech::frames
