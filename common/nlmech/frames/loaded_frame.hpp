/// @file
/// Structures under a growing dead load, as equations with a parameter.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "nlmech/algebraic/paths/loaded.hpp"
#include "nlmech/frames/frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/williams.hpp"

namespace nlmech::frames {

/// A beam-column that has lost most of its length.
struct ShortestMember {
  double left;  ///< length of the chord over that at rest
  double x;     ///< of its first node at rest
  double y;     ///< of its first node at rest
};

/// F(x, W) = dU/dx - W q for a frame, W being the load factor. dF/dx is sparse. Some motions may be given:
/// they are W times their displacement, and x are the others. K then depends on W as well, and so does dF/dW:
/// a limit point is one of the given displacements.
class LoadedFrame : public algebraic::Loaded {
 public:
  /// @param frame the structure; must outlive this object
  /// @param load q, forces on the unknowns for W = 1
  /// @param coupling `as_printed` gives K the misprint of Eq. 2.35, to show what it does; F is not touched
  /// @throws std::invalid_argument if q has another size than the frame, or is not finite
  LoadedFrame(const Frame& frame, Eigen::VectorXd load, Coupling coupling = Coupling::consistent);
  /// With the loads and given displacements of a frame by names. @param frame must outlive this object
  explicit LoadedFrame(const NamedFrame& frame);

  /// The structure.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// q.
  [[nodiscard]] const Eigen::VectorXd& load() const { return load_; }
  /// All unknowns of the frame: free ones, and given ones for a load factor.
  [[nodiscard]] Eigen::VectorXd whole(const Eigen::VectorXd& free, double load) const;
  /// The free ones of all. @param all of the frame's size
  [[nodiscard]] Eigen::VectorXd free(const Eigen::VectorXd& all) const;
  /// A direction of the free unknowns as one of all, the given ones at rest.
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& direction) const;

  /// Scales by which a path is measured: one for all translations, so that a member that turns with its node
  /// does not turn the path, and 1 for rotations.
  [[nodiscard]] Eigen::VectorXd scale() const;
  /// A load factor for a first step: it moves no node by more than a thousandth of the frame's size by linear
  /// theory, turns none by more than 0.02 rad and no member's ends against each other by more than a tenth of
  /// its length, and with these displacements the frame is still stable.
  [[nodiscard]] double first_load();
  /// Removes multiples of 2 pi from a difference of displacements by scale(), if both ends of each member
  /// have turned by the same multiple: the frame is the same then.
  void remove_full_rotations(Eigen::VectorXd& change) const;
  /// The beam-column that has lost most of its length. @param x free unknowns
  [[nodiscard]] ShortestMember shortest(const Eigen::VectorXd& x, double load) const;

  [[nodiscard]] Eigen::Index size() const override { return size_; }
  /// See Loaded; also not finite where the frame's own status is a failure, `wrong_branch` excepted.
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// -q; with given motions K d - q of the free unknowns, d being the given displacements.
  void load_vector(Eigen::VectorXd& q) const override { q = column_; }
  void matrix(Eigen::MatrixXd& k) const override { k = tangent_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &tangent_; }
  bool long_matrix(const algebraic::LongVector& x, double load, Eigen::SparseMatrix<long double>& k) override;
  bool long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) override;
  [[nodiscard]] double data_rounding(const Eigen::VectorXd& v) const override {
    return frame_.data_rounding(shape(v));
  }
  /// What the frame said last.
  [[nodiscard]] Status status() const override { return status_; }

 private:
  [[nodiscard]] bool has_given() const { return displacement_.size() > 0; }
  [[nodiscard]] algebraic::LongVector long_whole(const algebraic::LongVector& free, double load) const;

  const Frame& frame_;
  Eigen::VectorXd load_, displacement_;  ///< of all unknowns; no displacement if none is given
  Eigen::Index size_;
  Coupling coupling_;
  std::vector<Eigen::Index> free_;  ///< unknowns of the frame, if some are given
  std::vector<std::pair<Eigen::Index, Eigen::Index>>
      slots_;  ///< values of all of K that are those of tangent_, if some motions are given
  Eigen::SparseMatrix<double> all_, tangent_;
  Eigen::VectorXd column_, forces_;
  Status status_;
};

/// F(delta, W) = (W(delta) - W)/2 for Williams' toggle: one unknown, the drop of the apex. F is not finite at
/// and past the pole of d_5.
class LoadedWilliams : public algebraic::Loaded {
 public:
  /// @throws std::invalid_argument if a number of the toggle is not positive
  explicit LoadedWilliams(const Williams& toggle);

  /// 1
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  /// The toggle.
  [[nodiscard]] const Williams& toggle() const { return toggle_; }
  /// dF/ddelta of linearise().
  [[nodiscard]] double slope() const { return slope_; }
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// -1/2.
  void load_vector(Eigen::VectorXd& q) const override { q.setConstant(1, -0.5); }
  void matrix(Eigen::MatrixXd& k) const override { k.setConstant(1, 1, slope_); }

 private:
  Williams toggle_;
  double slope_ = 0;
};

}  // namespace nlmech::frames
