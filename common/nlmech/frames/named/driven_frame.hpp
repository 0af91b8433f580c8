/// @file
/// A frame of which some motions are given, as equations with a parameter.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "nlmech/algebraic/paths/loaded.hpp"
#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {

/// The forces on the unknowns of a frame that are not given, F = dU/dx - W q, where given unknowns are W
/// times their displacement. K, of the free unknowns, depends on W as well, and so does dF/dW: a limit point
/// is one of the given displacements.
class DrivenFrame : public algebraic::Loaded {
 public:
  /// @param frame must outlive this object
  explicit DrivenFrame(const NamedFrame& frame);

  /// All unknowns of the frame: free ones, and given ones for a load factor.
  [[nodiscard]] Eigen::VectorXd whole(const Eigen::VectorXd& free, double load) const;
  /// The free ones of all. @param all of the frame's size
  [[nodiscard]] Eigen::VectorXd free(const Eigen::VectorXd& all) const { return all(free_); }
  /// A direction of the free unknowns as one of all, the given ones at rest.
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& direction) const;

  /// See Loaded.
  [[nodiscard]] Eigen::Index size() const override { return static_cast<Eigen::Index>(free_.size()); }
  /// See Loaded.
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  /// See Loaded.
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// K d - q of the free unknowns, d being the given displacements.
  void load_vector(Eigen::VectorXd& q) const override { q = column_; }
  /// See Loaded.
  void matrix(Eigen::MatrixXd& k) const override { k = tangent_; }
  /// See Loaded.
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &tangent_; }
  /// See Loaded.
  bool long_matrix(const algebraic::LongVector& x, double load, Eigen::SparseMatrix<long double>& k) override;
  /// See Loaded.
  bool long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) override;
  /// See Frame.
  [[nodiscard]] double data_rounding(const Eigen::VectorXd& v) const override {
    return frame_.frame.data_rounding(shape(v));
  }
  /// What the frame said last.
  [[nodiscard]] Status status() const override { return status_; }

 private:
  [[nodiscard]] algebraic::LongVector long_whole(const algebraic::LongVector& free, double load) const;

  const NamedFrame& frame_;
  std::vector<Eigen::Index> free_;  ///< of the frame's unknowns
  std::vector<std::pair<Eigen::Index, Eigen::Index>>
      slots_;  ///< values of all of K that are those of tangent_
  Eigen::SparseMatrix<double> all_, tangent_;
  Eigen::VectorXd column_, forces_;
  Status status_;
};

}  // namespace nlmech::frames
