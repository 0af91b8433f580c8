/// @file
/// Stiff problems in extended precision: collocation at Radau points with many stages, for references.
/// Newton's matrices are in double, since they decide how fast the iteration converges and not to what.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::references {

/// Nodes c_1 < ... < c_s = 1 of Radau's right rule in (0, 1], and a(i, j), the integral of Lagrange's
/// polynomial j from 0 to c_i.
template <class Real>
struct RadauRule {
  std::vector<Real> c;                                    ///< nodes
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> a;  ///< weights
  std::vector<Real> last;  ///< by which values at 0, c_1, ... give the divided difference of all of them

  /// With @p stages nodes.
  explicit RadauRule(int stages) : c(roots(stages)), a(stages, stages) {
    const auto s = static_cast<std::size_t>(stages);
    for (std::size_t j = 0; j < s; ++j) {
      std::vector<Real> p = {Real(1)};  // Lagrange's polynomial by powers
      for (std::size_t m = 0; m < s; ++m) {
        if (m == j) continue;
        const Real factor = Real(1) / (c[j] - c[m]);
        p.emplace_back(0);
        for (std::size_t k = p.size(); k-- > 0;) p[k] = ((k > 0 ? p[k - 1] : Real(0)) - c[m] * p[k]) * factor;
      }
      for (std::size_t i = 0; i < s; ++i) {
        Real sum(0);
        for (std::size_t k = s; k-- > 0;) sum = (sum + p[k] / static_cast<int>(k + 1)) * c[i];
        a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = sum;
      }
    }
    for (std::size_t j = 0; j <= s; ++j) {
      Real product(1);
      for (std::size_t m = 0; m <= s; ++m) {
        if (m != j) product *= at(j) - at(m);
      }
      last.push_back(Real(1) / product);
    }
  }
  /// 0, c_1, c_2, ...
  [[nodiscard]] Real at(std::size_t j) const { return j == 0 ? Real(0) : c[j - 1]; }

 private:
  /// P_s - P_{s-1} of Legendre at x.
  static Real radau(int s, const Real& x) {
    Real before(1), now(x);
    for (int k = 1; k < s; ++k) {
      const Real next = ((2 * k + 1) * x * now - k * before) / (k + 1);
      before = now;
      now = next;
    }
    return now - before;
  }
  static std::vector<Real> roots(int s) {
    std::vector<Real> nodes;
    const int places = 40 * s;
    const auto place = [&](int i) { return Real(-std::cos(3.14159265358979 * (i + 0.5) / (places + 1))); };
    for (int i = 0; i < places; ++i) {
      Real low = place(i), high = place(i + 1);
      Real at_low = radau(s, low);
      if (at_low * radau(s, high) > 0) continue;
      for (int turn = 0; turn < 40; ++turn) {  // bisection, then the secant
        const Real middle = (low + high) / 2, value = radau(s, middle);
        if (value * at_low > 0) {
          low = middle;
          at_low = value;
        } else {
          high = middle;
        }
      }
      Real y0 = radau(s, low), y1 = radau(s, high);
      for (int turn = 0; turn < 8 && y1 != y0; ++turn) {
        const Real next = high - y1 * (high - low) / (y1 - y0);
        low = high;
        y0 = y1;
        high = next;
        y1 = radau(s, next);
      }
      nodes.push_back((high + 1) / 2);
    }
    nodes.emplace_back(1);
    if (nodes.size() != static_cast<std::size_t>(s)) throw std::logic_error("Radau: nodes are missing");
    return nodes;
  }
};

/// Derivatives of the end of a step by its start: the same collocation of the variational equations, in
/// double.
/// @param jacobians at the nodes
inline Eigen::MatrixXd step_derivative(const Eigen::MatrixXd& a, double h,
                                       const std::vector<Eigen::MatrixXd>& jacobians) {
  const auto s = static_cast<Eigen::Index>(jacobians.size()), n = jacobians[0].rows();
  Eigen::MatrixXd m = Eigen::MatrixXd::Identity(s * n, s * n), start(s * n, n);
  for (Eigen::Index i = 0; i < s; ++i) {
    start.middleRows(i * n, n).setIdentity();
    for (Eigen::Index j = 0; j < s; ++j)
      m.block(i * n, j * n, n, n) -= h * a(i, j) * jacobians[static_cast<std::size_t>(j)];
  }
  return m.partialPivLu().solve(start).bottomRows(n);
}

/// One step of the integration.
template <class Real>
struct RadauStep {
  Real end;                    ///< time
  Eigen::VectorXd start;       ///< state, in double
  Eigen::MatrixXd derivative;  ///< of the end by the start
};

/// Integrates a stiff problem to each of @p times.
/// @param problem right-hand side for Real, and for dual numbers
/// @param stages 2 stages - 1 is the order
/// @param tolerance of the last coefficient of a step's polynomial, relative to the components
/// @param visit called with each RadauStep
template <class Real, class Problem, class Visit>
std::vector<Vector<Real, Problem::dimension>> radau_states(const Problem& problem, const Real& t0,
                                                           const Vector<Real, Problem::dimension>& x0,
                                                           const std::vector<Real>& times, int stages,
                                                           double tolerance, double first_step,
                                                           Visit&& visit) {
  constexpr int dimension = Problem::dimension;
  using State = Vector<Real, dimension>;
  const RadauRule<Real> rule(stages);
  const auto s = static_cast<std::size_t>(stages);
  const Eigen::Index n = x0.size();
  const ivp::Direct<Problem, Eigen::Dynamic> direct(problem);
  const Eigen::MatrixXd a = rule.a.template cast<double>();
  std::vector<State> found, stage(s, x0), slope(s, x0);
  State x = x0;
  Real t = t0, h(first_step), last_h(0);
  std::vector<State> previous;  // values at 0, c_1, ... of the step before
  Eigen::MatrixXd m(n * stages, n * stages);
  std::vector<Eigen::MatrixXd> jacobians(s, Eigen::MatrixXd(n, n));

  // Of a component within the step. One that has only just left zero is a difference of others, and counts by
  // them.
  constexpr double least_share = 1e-25;
  const auto size_of = [&](Eigen::Index i) {
    Real size = abs(x[i]), greatest = x.cwiseAbs().maxCoeff();
    for (const State& z : stage) size = std::max(size, Real(abs(z[i])));
    return std::max(size, Real(least_share * greatest));
  };
  const auto guess = [&](bool extrapolated) {
    for (std::size_t i = 0; i < s; ++i) {
      stage[i] = x;
      if (!extrapolated) continue;
      const Real place = 1 + rule.c[i] * h / last_h;
      stage[i].setZero();
      for (std::size_t j = 0; j <= s; ++j) {
        Real weight = rule.last[j];
        for (std::size_t k = 0; k <= s; ++k) {
          if (k != j) weight *= place - rule.at(k);
        }
        stage[i] += weight * previous[j];
      }
    }
  };
  /// Newton's iteration; false if it does not converge.
  const auto solve = [&](const Real& step) {
    const auto step_double = static_cast<double>(step);
    double before = 1e300;
    for (int turn = 0; turn < 40; ++turn) {
      m.setIdentity();
      for (std::size_t j = 0; j < s; ++j) {
        problem(Real(t + rule.c[j] * step), stage[j], slope[j]);
        ivp::Jacobian own(n, n);
        direct.jacobian(static_cast<double>(Real(t + rule.c[j] * step)), stage[j].template cast<double>(),
                        own);
        jacobians[j] = own;
        for (std::size_t i = 0; i < s; ++i) {
          const auto ii = static_cast<Eigen::Index>(i), jj = static_cast<Eigen::Index>(j);
          m.block(ii * n, jj * n, n, n) -= step_double * a(ii, jj) * jacobians[j];
        }
      }
      if (!m.allFinite()) return false;
      const Eigen::PartialPivLU<Eigen::MatrixXd> lu(m);
      // The residual in Real is brought to the range of double before it is solved for.
      std::vector<State> residual(s, x);
      Real greatest(0);
      for (std::size_t i = 0; i < s; ++i) {
        residual[i] = stage[i] - x;
        for (std::size_t j = 0; j < s; ++j)
          residual[i] -=
              (step * rule.a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))) * slope[j];
        for (Eigen::Index k = 0; k < n; ++k) greatest = std::max(greatest, Real(abs(residual[i][k])));
      }
      if (greatest == 0) return true;
      Eigen::VectorXd right(n * stages);
      for (std::size_t i = 0; i < s; ++i) {
        for (Eigen::Index k = 0; k < n; ++k)
          right[static_cast<Eigen::Index>(i) * n + k] = static_cast<double>(Real(residual[i][k] / greatest));
      }
      const Eigen::VectorXd correction = lu.solve(right);
      if (!correction.allFinite()) return false;
      double change = 0;
      for (Eigen::Index k = 0; k < n; ++k) {
        const Real size = size_of(k);
        for (std::size_t i = 0; i < s; ++i) {
          const Real move = greatest * correction[static_cast<Eigen::Index>(i) * n + k];
          stage[i][k] -= move;
          if (size > 0) change = std::max(change, static_cast<double>(Real(abs(move) / size)));
        }
      }
      if (change < 1e-38) return true;
      if (turn > 6 && change > before) return change < 1e-32;
      before = change;
    }
    return false;
  };
  /// The last coefficient of the polynomial, as of Chebyshev's, relative to the components.
  const auto roughness = [&] {
    double worst = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      Real sum = rule.last[0] * x[k];
      for (std::size_t j = 0; j < s; ++j) sum += rule.last[j + 1] * stage[j][k];
      const Real size = size_of(k);
      if (size > 0) worst = std::max(worst, static_cast<double>(Real(abs(sum) / size)));
    }
    return std::ldexp(worst, 1 - 2 * stages);
  };

  for (const Real& stop : times) {
    while (t < stop) {
      const bool lands = t + h >= stop;
      const Real wanted = h, step = lands ? Real(stop - t) : h;
      h = step;
      bool solved = false;
      if (!previous.empty()) {
        guess(true);
        solved = solve(step);
      }
      if (!solved) {
        guess(false);
        solved = solve(step);
      }
      const double rough = solved ? roughness() : 1e300;
      if (!solved || rough > 4 * tolerance) {
        h = step * (solved ? std::max(0.1, 0.9 * std::pow(tolerance / rough, 1.0 / stages)) : 0.25);
        if (!(t + h > t)) throw std::runtime_error("Radau: the step underflows at t = " + t.str(10));
        continue;
      }
      visit(RadauStep<Real>{Real(t + step), x.template cast<double>(),
                            step_derivative(a, static_cast<double>(step), jacobians)});
      previous.assign(1, x);
      previous.insert(previous.end(), stage.begin(), stage.end());
      last_h = step;
      x = stage.back();
      t = lands ? stop : Real(t + step);
      const double growth = std::min(2.0, 0.9 * std::pow(tolerance / std::max(rough, 1e-300), 1.0 / stages));
      h = lands ? std::max(Real(step * growth), wanted) : Real(step * growth);
    }
    found.push_back(x);
  }
  return found;
}

}  // namespace nlmech::references
