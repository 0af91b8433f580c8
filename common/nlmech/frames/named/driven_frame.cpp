#include "nlmech/frames/named/driven_frame.hpp"

#include <algorithm>

#include "nlmech/support/doubles.hpp"

namespace nlmech::frames {

DrivenFrame::DrivenFrame(const NamedFrame& frame) : frame_(frame) {
  const Eigen::Index all = frame.frame.size();
  std::vector<Eigen::Index> place(static_cast<std::size_t>(all), -1);
  for (Eigen::Index i = 0; i < all; ++i) {
    if (std::binary_search(frame.given.begin(), frame.given.end(), i)) continue;
    place[static_cast<std::size_t>(i)] = size();
    free_.push_back(i);
  }
  // The pattern is that of the frame at rest, where its tangent always is.
  static_cast<void>(frame.frame.tangent<double>(Eigen::VectorXd::Zero(all), all_));
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < all_.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator at(all_, column); at; ++at) {
      const Eigen::Index row = place[static_cast<std::size_t>(at.row())],
                         own = place[static_cast<std::size_t>(column)];
      if (row >= 0 && own >= 0) entries.emplace_back(static_cast<int>(row), static_cast<int>(own), 0.);
    }
  }
  tangent_.resize(size(), size());
  tangent_.setFromTriplets(entries.begin(), entries.end());
  tangent_.makeCompressed();
  // Rows and columns keep their order, and so do the values.
  Eigen::Index from = 0, to = 0;
  for (int column = 0; column < all_.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator at(all_, column); at; ++at, ++from) {
      if (place[static_cast<std::size_t>(at.row())] >= 0 && place[static_cast<std::size_t>(column)] >= 0)
        slots_.emplace_back(from, to++);
    }
  }
}

Eigen::VectorXd DrivenFrame::whole(const Eigen::VectorXd& free, double load) const {
  Eigen::VectorXd x = load * frame_.displacement;
  x(free_) = free;
  return x;
}

Eigen::VectorXd DrivenFrame::shape(const Eigen::VectorXd& direction) const {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(frame_.frame.size());
  v(free_) = direction;
  return v;
}

void DrivenFrame::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  status_ = frame_.frame.force<double>(whole(x, load), forces_);
  if (has_values(status_))
    f = free(forces_ - load * frame_.load);
  else
    f.setConstant(size(), nan);
}

void DrivenFrame::linearise(const Eigen::VectorXd& x, double load) {
  status_ = frame_.frame.tangent<double>(whole(x, load), all_);
  if (!has_values(status_)) all_.coeffs().setConstant(nan);
  for (const auto& [from, to] : slots_) tangent_.valuePtr()[to] = all_.valuePtr()[from];
  column_ = free(all_ * frame_.displacement - frame_.load);
}

algebraic::LongVector DrivenFrame::long_whole(const algebraic::LongVector& free, double load) const {
  algebraic::LongVector x = load * frame_.displacement.cast<long double>();
  x(free_) = free;
  return x;
}

bool DrivenFrame::long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) {
  algebraic::LongVector forces;
  status_ = frame_.frame.force<long double>(long_whole(x, load), forces);
  if (has_values(status_))
    f = free((forces - load * frame_.load.cast<long double>()).cast<double>());
  else
    f.setConstant(size(), nan);
  return true;
}

bool DrivenFrame::long_matrix(const algebraic::LongVector& x, double load,
                              Eigen::SparseMatrix<long double>& k) {
  Eigen::SparseMatrix<long double> all;
  if (!has_values(frame_.frame.tangent<long double>(long_whole(x, load), all))) return false;
  k = tangent_.cast<long double>();
  for (const auto& [from, to] : slots_) k.valuePtr()[to] = all.valuePtr()[from];
  return true;
}

}  // namespace nlmech::frames
