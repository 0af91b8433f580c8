#include "nlmech/algebraic/typed/root_check.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using program::Interval;

/// Halving from the largest to the smallest double takes 2100 iterations; longer steps skip most of them.
constexpr int most_iterations = 2500;

Interval at(const Box& box, Index i) { return box[static_cast<std::size_t>(i)]; }

/// The box x - r to x + r.
Box box_around(const VectorXd& x, const VectorXd& r) {
  Box box;
  for (Index i = 0; i < x.size(); ++i) box.push_back(Interval::outwards(x[i] - r[i], x[i] + r[i]));
  return box;
}

/// Newton's steps from a point, in units of the typical sizes, with rows of equal size.
class Polish {
 public:
  Polish(const TypedSystem& system, const VectorXd& start, const VectorXd& typical)
      : system_(system), typical_(typical), x(start) {}

  // Ends at rounding, where F is 0, or where neither the steps become shorter nor F falls: towards the root
  // of exp(x) = 1e-100 all steps are as long, towards that of 1/x = 1e-20 they grow.
  void run() {
    double before = HUGE_VAL, ratio_before = 0, f_before = HUGE_VAL, leap = 0;
    int longer = 0;
    bool may_leap = true;
    VectorXd left;  // where the last leap began
    for (int k = 0; k < most_iterations; ++k) {
      const bool is_valid = step();
      if (is_zero) break;
      const double size = is_valid ? step_size() : HUGE_VAL, ratio = size / before;
      if (leap > 0 && !(size > 0 && size < leap && f_size <= f_before)) {  // too far, as x^20 = 1e-200 from 1
        x = left, order = 1, may_leap = false;
        before = f_before = HUGE_VAL, leap = 0;
        continue;
      }
      if (!is_valid) break;
      if (size < best_size) best = x, best_step = s, best_size = size, best_order = order;
      longer = ratio < 0.98 || f_size < 0.75 * f_before ? 0 : longer + 1;
      if (longer > 8 || is_rounding()) break;
      const bool is_steady = may_leap && ratio > 0.3 && ratio < 0.98 && std::abs(ratio - ratio_before) < 0.02;
      if (is_steady) order = std::max(order, static_cast<int>(std::lround(1 / (1 - ratio)))), left = x;
      x += (is_steady ? order : 1) * s.cwiseProduct(typical_);
      leap = is_steady ? size : 0;
      ratio_before = is_steady ? 0 : ratio;
      before = is_steady ? HUGE_VAL : size;
      f_before = f_size;
    }
    if (is_zero) best = x, best_step.setZero(x.size()), best_size = 0, best_order = order;
    if (best_size == HUGE_VAL) best = x, best_step.setConstant(x.size(), HUGE_VAL);
    x = best, s = best_step, order = best_order;
  }

 private:
  // Sets s, Newton's step. @return false if there is none, or none is needed
  bool step() {
    system_.residual(x, f_);
    is_zero = f_.allFinite() && (f_.array() == 0).all();
    if (is_zero || !f_.allFinite()) return false;
    system_.derivative(x, j_);
    j_.conservativeResize(x.size(), x.size());
    j_ *= typical_.asDiagonal();
    if (row_size_.size() == 0) row_size_ = j_.cwiseAbs().rowwise().maxCoeff();
    f_size = f_.cwiseAbs().cwiseQuotient(row_size_).maxCoeff();
    for (Index i = 0; i < x.size(); ++i) {
      const double size = j_.row(i).cwiseAbs().maxCoeff();
      if (size == 0) continue;
      j_.row(i) /= size;
      f_[i] /= size;
    }
    if (!j_.allFinite() || !f_.allFinite()) return false;
    s = -Eigen::ColPivHouseholderQR<MatrixXd>(j_).solve(f_);
    return s.allFinite();
  }
  // In units of the typical sizes, or of x where that is greater.
  [[nodiscard]] double step_size() const {
    const VectorXd unit = typical_.cwiseMax(x.cwiseAbs());
    return s.cwiseProduct(typical_).cwiseQuotient(unit).cwiseAbs().maxCoeff();
  }
  [[nodiscard]] bool is_rounding() const {
    return (s.cwiseProduct(typical_).array().abs() <= eps / 2 * x.array().abs()).all();
  }

  const TypedSystem& system_;
  const VectorXd& typical_;
  VectorXd f_, row_size_;  // F, and the sizes of its rows at the start
  MatrixXd j_;
  VectorXd best, best_step;
  double f_size = 0;
  double best_size = HUGE_VAL;
  int best_order = 1;

 public:
  VectorXd x, s = {};    // the best point, and Newton's step there in typical sizes
  int order = 1;         // from the ratio of steps
  bool is_zero = false;  // is F exactly 0?
};

/// Proof for boxes about the root that grow until Krawczyk's operator maps them into themselves.
bool prove(const TypedSystem& system, CheckedRoot& root) {
  const Index n = root.x.size();
  VectorXd radius(n);
  for (Index i = 0; i < n; ++i) radius[i] = 8 * eps * std::abs(root.x[i]) + 1e-300;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const Box box = box_around(root.x, radius);
    Box f, j;
    if (system.enclose(box, f, j) != TypedSystem::Domain::smooth) return false;
    const std::optional<Box> image = krawczyk(system, box, j);
    if (!image) return false;
    VectorXd reach(n);
    for (Index i = 0; i < n; ++i)
      reach[i] = std::max(std::abs(at(*image, i).low - root.x[i]), std::abs(at(*image, i).high - root.x[i]));
    if (is_inside(*image, box)) {
      root.bound = reach * (1 + 4 * eps);
      return true;
    }
    for (Index i = 0; i < n; ++i) radius[i] = std::max(radius[i], 2.5 * reach[i]);
    if (!radius.allFinite()) return false;
  }
  return false;
}

/// dF/dx in typical sizes; rows divided by their largest size at x and at a point one typical size away.
MatrixXd scaled_matrix(const TypedSystem& system, const VectorXd& x, const VectorXd& typical,
                       VectorXd& row_size) {
  MatrixXd j, away;
  system.derivative(x, j);
  VectorXd other = x;
  for (Index i = 0; i < x.size(); ++i) other[i] += (i % 2 == 0 ? 0.6 : -0.7) * typical[i];
  system.derivative(other, away);
  const Index n = x.size();
  j = (j.leftCols(n) * typical.asDiagonal()).eval();
  away = (away.leftCols(n) * typical.asDiagonal()).eval();
  row_size = j.cwiseAbs().rowwise().sum();
  const VectorXd size_away = away.cwiseAbs().rowwise().sum();
  for (Index i = 0; i < n; ++i) {
    if (std::isfinite(size_away[i])) row_size[i] = std::max(row_size[i], size_away[i]);
    if (!(row_size[i] > 0) || !std::isfinite(row_size[i])) row_size[i] = 1;
    j.row(i) /= row_size[i];
  }
  return j;
}

/// Is F_i exactly 0 with all its derivatives, and next to nothing in points around x: has it underflown?
bool has_underflown(const TypedSystem& system, const VectorXd& x, const VectorXd& typical) {
  VectorXd f, g, h;
  MatrixXd j;
  system.residual(x, f);
  system.derivative(x, j);
  const VectorXd offset = 1e-4 * typical;
  system.residual(x + offset, g);
  system.residual(x - offset, h);
  for (Index i = 0; i < x.size(); ++i) {
    const bool is_nothing = std::abs(g[i]) < 1e-290 && std::abs(h[i]) < 1e-290;
    if (f[i] == 0 && is_nothing && (j.row(i).array() == 0).all()) return true;
  }
  return false;
}

/// Does the enclosure of F within @p radius of x contain 0, and F not jump there?
bool may_vanish(const TypedSystem& system, const VectorXd& x, const VectorXd& radius,
                const VectorXd& row_size) {
  constexpr double jump = 1e-6;  // of the change of F over a typical distance
  Box f, j;
  static_cast<void>(system.enclose(box_around(x, radius), f, j));
  for (Index i = 0; i < x.size(); ++i) {
    if (!at(f, i).has(0) || !(at(f, i).magnitude() <= jump * row_size[i])) return false;
  }
  return true;
}

/// Widens the bound of a singular root along the null vectors @p null as far as rounding may make F vanish.
/// @return the farthest of these distances, in typical sizes, at most 1
double widen_bound(const TypedSystem& system, const MatrixXd& null, const VectorXd& typical,
                   const VectorXd& row_size, CheckedRoot& root) {
  const VectorXd thin = 4 * eps * root.x.cwiseAbs();
  double farthest = 0;
  for (Index k = 0; k < null.cols(); ++k) {
    const VectorXd direction = null.col(k).cwiseProduct(typical);
    for (double r = 4 * eps; r < 1; r *= 2) {
      if (!may_vanish(system, root.x + r * direction, thin, row_size) &&
          !may_vanish(system, root.x - r * direction, thin, row_size))
        break;
      root.bound = root.bound.cwiseMax(2 * r * direction.cwiseAbs());
      farthest = std::max(farthest, r);
    }
  }
  return farthest;
}

/// Is there another root at a distance of about @p h typical sizes along a null vector: do roots fill a
/// curve? The iteration of Gauss and Newton with the shortest steps stays there if they do, and returns if
/// not.
bool has_neighbour(const TypedSystem& system, const MatrixXd& null, const VectorXd& typical,
                   const VectorXd& row_size, double h, const VectorXd& x) {
  constexpr int iterations = 30;
  VectorXd f;
  MatrixXd j;
  for (Index k = 0; k < null.cols(); ++k) {
    VectorXd y = x + h * null.col(k).cwiseProduct(typical);
    for (int i = 0; i < iterations; ++i) {
      system.residual(y, f);
      system.derivative(y, j);
      j = (row_size.cwiseInverse().asDiagonal() * j.leftCols(y.size()) * typical.asDiagonal()).eval();
      if (!f.allFinite() || !j.allFinite()) break;
      Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors(j);
      factors.setThreshold(1e-9);
      y -= factors.solve(f.cwiseQuotient(row_size)).cwiseProduct(typical);
    }
    const double distance = (y - x).cwiseQuotient(typical).norm();
    const VectorXd thin = 4 * eps * y.cwiseAbs();
    if (distance > h / 2 && distance < 2 * h && may_vanish(system, y, thin, row_size)) return true;
  }
  return false;
}

}  // namespace

bool is_stationary(const TypedSystem& system, const VectorXd& x, const VectorXd& typical) {
  VectorXd f, row_size;
  system.residual(x, f);
  const MatrixXd j = scaled_matrix(system, x, typical, row_size);
  row_size *= f.cwiseQuotient(row_size).cwiseAbs().maxCoeff();  // the square of F may be out of range
  f = f.cwiseQuotient(row_size).eval();
  VectorXd fall = -(j.transpose() * f);
  if (!f.allFinite() || !(fall.norm() <= 1e-5 * f.norm())) return false;
  // Flat is not enough: exp(x) is flat at -30 beside its slope some way off, and falls on.
  fall = fall.stableNormalized().cwiseProduct(typical);
  VectorXd lower;
  for (double h = 0.01; h > eps; h /= 4) {
    system.residual(x + h * fall, lower);
    if (lower.cwiseQuotient(row_size).norm() < 0.99 * f.norm()) return false;
  }
  return true;
}

std::string_view to_string(CheckedRoot::Kind kind) noexcept {
  constexpr std::string_view names[] = {"none", "proved", "singular", "unproved"};
  return names[static_cast<int>(kind)];
}

bool is_inside(const Box& inner, const Box& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!(inner[i].low > outer[i].low && inner[i].high < outer[i].high)) return false;
  }
  return true;
}

std::optional<Box> krawczyk(const TypedSystem& system, const Box& box, const Box& j) {
  const auto n = static_cast<Index>(box.size());
  MatrixXd middle(n, n);
  Box point, image;
  for (const Interval& side : box) point.emplace_back(side.low + (side.high - side.low) / 2);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) {
      const Interval& entry = at(j, i * n + k);
      middle(i, k) = entry.low + (entry.high - entry.low) / 2;
    }
  }
  if (!middle.allFinite()) return {};
  const MatrixXd inverse = middle.partialPivLu().inverse();
  if (!inverse.allFinite()) return {};
  Box f, unused;
  static_cast<void>(system.enclose(point, f, unused));
  for (Index i = 0; i < n; ++i) {
    Interval sum = at(point, i);
    for (Index k = 0; k < n; ++k) sum = sum - inverse(i, k) * at(f, k);
    for (Index k = 0; k < n; ++k) {
      Interval rest(i == k ? 1. : 0.);
      for (Index l = 0; l < n; ++l) rest = rest - inverse(i, l) * at(j, l * n + k);
      sum = sum + rest * (at(box, k) - at(point, k));
    }
    if (!std::isfinite(sum.low) || !std::isfinite(sum.high)) return {};
    image.push_back(sum);
  }
  return image;
}

CheckedRoot check_root(const TypedSystem& system, const VectorXd& start, const VectorXd& typical) {
  CheckedRoot root;
  Polish polish(system, start, typical);
  polish.run();
  const VectorXd x = root.x = polish.x, unit = typical.cwiseMax(x.cwiseAbs());
  VectorXd f, row_size;
  system.residual(x, f);
  const auto refuse = [&](const std::string& why) {
    root.reason = why;
    return root;
  };
  root.bound.setConstant(x.size(), HUGE_VAL);
  root.residual = root.condition = HUGE_VAL;
  if (!f.allFinite() || !x.allFinite()) return refuse("F does not exist there");
  const MatrixXd j = scaled_matrix(system, x, unit, row_size);
  if (!j.allFinite()) return refuse("dF/dx is not finite there");
  root.residual = f.cwiseQuotient(row_size).cwiseAbs().maxCoeff();
  const Eigen::JacobiSVD<MatrixXd> svd(j, Eigen::ComputeFullV);
  const VectorXd& singular = svd.singularValues();
  const double least = singular[singular.size() - 1];
  root.condition = least > 0 ? singular[0] / least : HUGE_VAL;
  if (!system.contains(x)) return refuse("Newton's iteration leaves the bounds");
  if (has_underflown(system, x, unit)) return refuse("an equation is 0 there by underflow alone");
  if (prove(system, root)) {
    root.kind = CheckedRoot::Kind::proved;
    return root;
  }
  const VectorXd step = polish.s.cwiseProduct(typical).cwiseAbs();
  root.bound = (2. * polish.order * step).cwiseMax(4 * eps * x.cwiseAbs());
  if (!(root.error(unit) < 1e-2)) return refuse("Newton's iteration does not converge");
  const VectorXd radius = root.bound.cwiseMin(4 * eps * unit).cwiseMax(4 * eps * x.cwiseAbs());
  if (!may_vanish(system, x, radius, row_size)) return refuse("F is not 0 near there");
  // Rows have size 1 at a typical distance.
  root.defect = (singular.array() < 1e-5).count();
  if (root.defect > 0) root.bound = root.bound.cwiseMax(4 * eps * unit);
  const MatrixXd null = svd.matrixV().rightCols(root.defect);
  const VectorXd narrow = root.bound;
  const double reach = widen_bound(system, null, unit, row_size, root);
  root.is_isolated =
      reach < 0.1 && !has_neighbour(system, null, unit, row_size, std::max(1e-3, 8 * reach), x);
  if (!root.is_isolated) root.bound = narrow;
  root.order = polish.order;
  const bool loses_rank = root.defect > 0;
  root.kind = loses_rank ? CheckedRoot::Kind::singular : CheckedRoot::Kind::unproved;
  if (loses_rank) root.order = std::max(root.order, 2);
  return root;
}

}  // namespace nlmech::algebraic
