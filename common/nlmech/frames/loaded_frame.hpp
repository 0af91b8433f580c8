/// @file
/// Structures under dead load, as equations with the load factor as parameter.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <utility>
#include <vector>

#include "nlmech/algebraic/paths/loaded.hpp"
#include "nlmech/frames/frame.hpp"
#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/williams.hpp"

namespace nlmech::frames {

/// The beam-column with the greatest relative shortening.
struct ShortestMember {
  double left;  ///< chord length relative to that at rest
  double x;     ///< x of its first node at rest
  double y;     ///< y of its first node at rest
};

/// Diagonal of the rectangle around the nodes at rest.
[[nodiscard]] double size_of(const Frame& frame);

/// F(x, W) = dU/dx - W q - q0 for a frame with the load factor W; q0 are constant loads. dF/dx is sparse.
/// Degrees of freedom may be prescribed: they equal W times a given displacement, and x holds the others. K
/// and dF/dW then also depend on W, and a limit point is an extremum of the prescribed displacements.
class LoadedFrame : public algebraic::Loaded {
 public:
  /// @param frame the structure; must outlive this object
  /// @param load q, forces on the unknowns for W = 1
  /// @param coupling `as_printed` uses the misprinted Eq. 2.35 in K, to show its effect; F is unchanged
  /// @throws std::invalid_argument if q has another size than the frame, or is not finite
  LoadedFrame(const Frame& frame, Eigen::VectorXd load, Coupling coupling = Coupling::consistent);
  /// Takes the loads, constant loads and prescribed displacements of a named frame. @param frame must outlive
  /// this object
  explicit LoadedFrame(const NamedFrame& frame);

  /// The structure.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// q.
  [[nodiscard]] const Eigen::VectorXd& load() const { return load_; }
  /// All unknowns of the frame: the free ones, and the prescribed ones at a load factor.
  [[nodiscard]] Eigen::VectorXd whole(const Eigen::VectorXd& free, double load) const;
  /// Extracts the free unknowns. @param all all unknowns of the frame
  [[nodiscard]] Eigen::VectorXd free(const Eigen::VectorXd& all) const;
  /// Extends a direction of the free unknowns to all unknowns, with 0 for the prescribed ones.
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& direction) const;

  /// Scales of the unknowns for path following: one for all translations, so that the rotation of a member
  /// with its node does not rotate the tangent of the path, and 1 for rotations.
  [[nodiscard]] Eigen::VectorXd scale() const;
  /// Load factor of a first step from the free unknowns @p start at the load factor 0. By linear theory it
  /// displaces no node by more than a thousandth of the size of the frame, rotates none by more than 0.02
  /// rad, and displaces no ends of a member relative to each other by more than a tenth of its length; the
  /// inertia of K does not change.
  [[nodiscard]] double first_load(const Eigen::VectorXd& start);
  /// Removes multiples of 2 pi from a difference of displacements by scale(), if both ends of each member
  /// have turned by the same multiple: the configuration is then identical.
  void remove_full_rotations(Eigen::VectorXd& change) const;
  /// K_g of the free unknowns: the change of K with the load factor by the axial forces that grow with it, as
  /// linear theory at (x, load) has them. linearise(x, load) first; empty if K is singular or a state of a
  /// member has no values.
  [[nodiscard]] std::optional<Eigen::SparseMatrix<double>> geometric(const Eigen::VectorXd& x, double load);
  /// The beam-column with the greatest relative shortening. @param x free unknowns
  [[nodiscard]] ShortestMember shortest(const Eigen::VectorXd& x, double load) const;

  [[nodiscard]] Eigen::Index size() const override { return size_; }
  /// See Loaded; f is also not finite where the frame reports a failure other than `wrong_branch`.
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// -q; with prescribed displacements d: K d - q for the free unknowns.
  void load_vector(Eigen::VectorXd& q) const override { q = column_; }
  void matrix(Eigen::MatrixXd& k) const override { k = tangent_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &tangent_; }
  bool long_matrix(const algebraic::LongVector& x, double load, Eigen::SparseMatrix<long double>& k) override;
  bool long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) override;
  [[nodiscard]] double data_rounding(const Eigen::VectorXd& v) const override {
    return frame_.data_rounding(shape(v));
  }
  /// Status of the frame at the last evaluation.
  [[nodiscard]] Status status() const override { return status_; }

 private:
  [[nodiscard]] bool has_given() const { return displacement_.size() > 0; }
  /// The block of the free unknowns of a matrix with the pattern of the tangent.
  template <class T>
  [[nodiscard]] Eigen::SparseMatrix<T> block(const Eigen::SparseMatrix<T>& all) const;
  [[nodiscard]] algebraic::LongVector long_whole(const algebraic::LongVector& free, double load) const;

  const Frame& frame_;
  Eigen::VectorXd load_, displacement_;  ///< for all unknowns; displacement_ is empty if none is prescribed
  Eigen::VectorXd steady_;               ///< q0; empty if there is none
  Eigen::Index size_;
  Coupling coupling_;
  std::vector<Eigen::Index> free_;  ///< indices of the free unknowns, if some are prescribed
  std::vector<std::pair<Eigen::Index, Eigen::Index>>
      slots_;  ///< positions in all_ and tangent_ of equal values, if some unknowns are prescribed
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
