#include "nlmech/algebraic/typed/bifurcation.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nlmech/algebraic/paths/path_step.hpp"
#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<VectorXd> bifurcation_near(const CurveEquations& equations, const VectorXd& start,
                                         double reach) {
  const Index m = start.size(), n = m - 1;
  VectorXd z = start, f, rest(2 * m);
  MatrixXd j, ahead, behind, all = MatrixXd::Zero(2 * m, 2 * m);
  equations(z, f, j);
  if (!j.allFinite()) return {};
  const VectorXd border = Eigen::JacobiSVD<MatrixXd>(j, Eigen::ComputeFullU).matrixU().col(n - 1);
  VectorXd left = border;
  const double size = z.norm() + reach, h = 1e-5 * size;
  double mu = 0, before = HUGE_VAL;
  bool is_done = false;
  for (int k = 0; k < 80 && !is_done; ++k) {
    equations(z, f, j);
    rest << -f - mu * border, -j.transpose() * left, 1 - border.dot(left);
    all.topLeftCorner(n, m) = j;
    all.col(m).head(n) = border;
    all.block(n, m + 1, m, n) = j.transpose();
    all.row(2 * m - 1).tail(n) = border.transpose();
    for (Index i = 0; i < m; ++i) {
      VectorXd at = z;
      at[i] = z[i] + h;
      equations(at, f, ahead);
      at[i] = z[i] - h;
      equations(at, f, behind);
      all.col(i).segment(n, m) = (ahead - behind).transpose() * left / (2 * h);
    }
    if (!all.allFinite() || !rest.allFinite()) return {};
    const VectorXd step = all.colPivHouseholderQr().solve(rest);
    const double length = step.head(m).norm();
    z += step.head(m);
    mu += step[m];
    left += step.tail(n);
    if (!((z - start).norm() <= reach)) return {};
    is_done = length <= eps * size || (length <= 1e-7 * size && length > 0.9 * before);
    before = length;
  }
  equations(z, f, j);
  const double here = border.dot(f);
  double noise = eps;
  VectorXd at;
  for (std::uint64_t sequence = 0; sequence < 4; ++sequence) {
    perturb_last_bits(z, sequence, at);
    equations(at, f, j);
    noise = std::max(noise, std::abs(border.dot(f) - here));
  }
  if (!is_done || !(std::abs(mu) <= 64 * noise)) return {};
  return z;
}

std::vector<VectorXd> half_branches(const CurveEquations& equations, const VectorXd& at, double radius) {
  constexpr int samples = 64;
  const Index m = at.size(), n = m - 1;
  VectorXd f, z, rest(m + 1);
  MatrixXd j, all = MatrixXd::Zero(m + 1, m + 1);
  equations(at, f, j);
  const Eigen::JacobiSVD<MatrixXd> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (n > 1 && !(svd.singularValues()[n - 2] > 1e-6 * svd.singularValues()[0])) return {};
  const MatrixXd null = svd.matrixV().rightCols(2);
  all.col(m).head(n) = svd.matrixU().col(n - 1);
  all.bottomLeftCorner(2, m) = null.transpose();
  // The bifurcation equation; z becomes the point.
  const auto reduced = [&](double angle) {
    const Eigen::Vector2d place(radius * std::cos(angle), radius * std::sin(angle));
    z = at + null * place;
    double mu = 0;
    for (int k = 0; k < 8; ++k) {
      equations(z, f, j);
      all.topLeftCorner(n, m) = j;
      rest << -f - mu * all.col(m).head(n), place - null.transpose() * (z - at);
      const VectorXd step = all.partialPivLu().solve(rest);
      z += step.head(m);
      mu += step[m];
      if (step.head(m).norm() <= eps * radius) break;
    }
    return mu;
  };
  const auto angle = [](int i) { return 0.1 + 2 * std::numbers::pi * i / samples; };
  const auto value = [&](int i) { return reduced(angle(i)); };
  std::vector<std::pair<double, double>> brackets;
  double last = value(-1), here = value(0);
  for (int i = 0; i < samples; ++i) {
    const double next = value(i + 1);
    if ((here > 0) != (next > 0)) brackets.emplace_back(angle(i), angle(i + 1));
    const bool is_extremum = (last > 0) == (here > 0) && (here > 0) == (next > 0) &&
                             std::abs(here) < std::abs(last) && std::abs(here) <= std::abs(next);
    // Two zeros between samples.
    const auto between = [&](double place) -> std::optional<double> {
      const double there = reduced(place);
      return (there > 0) == (here > 0) ? std::optional(std::abs(there)) : std::nullopt;
    };
    if (is_extremum) {
      if (const auto place = golden_section(angle(i - 1), angle(i + 1), 40, between)) {
        brackets.emplace_back(angle(i - 1), *place);
        brackets.emplace_back(*place, angle(i + 1));
      }
    }
    last = std::exchange(here, next);
  }
  std::vector<VectorXd> points;
  for (auto [low, high] : brackets) {
    const bool is_positive = reduced(low) > 0;
    for (int k = 0; k < 50; ++k) {
      const double middle = low + (high - low) / 2;
      ((reduced(middle) > 0) == is_positive ? low : high) = middle;
    }
    points.push_back(z);
  }
  return points;
}

}  // namespace nlmech::algebraic
