/// Random systems of equations for every solver by its name: each reported root has a residual, in long
/// double, within the tolerance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/algebraic/typed/solve_typed.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/program/dual.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised::algebraic_test {
namespace {

using algebraic::NamedSolver;
using algebraic::Report;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most = 5;  // the largest number of unknowns
enum class Shape { product, chain, exponential, saturating, no_root, root };

/// F_i = scale_i f((A x)_i), with a root for most shapes.
struct RandomSystem {
  Shape shape{};
  int n = 1, degree = 1;
  MatrixXd a;      ///< factors of x
  MatrixXd roots;  ///< roots of f, a row for each component
  VectorXd scale;
  double steepness = 1;

  template <class T>
  [[nodiscard]] T component(const std::vector<T>& x, int i) const {
    using std::exp;
    using std::sqrt;
    if (shape == Shape::chain)
      return i == 0 ? T(scale[0] * (roots(0, 0) - x[0]))
                    : T(scale[i] * (x[static_cast<std::size_t>(i)] -
                                    x[static_cast<std::size_t>(i - 1)] * x[static_cast<std::size_t>(i - 1)]));
    T y(0);
    for (int j = 0; j < n; ++j) y += a(i, j) * x[static_cast<std::size_t>(j)];
    const double r = roots(i, 0);
    switch (shape) {
      case Shape::exponential: return scale[i] * (exp(steepness * y) - std::exp(steepness * r));
      case Shape::saturating: {
        const T u = steepness * (y - r);
        return scale[i] * (u / sqrt(1 + u * u) + 0.01 * (y - r));
      }
      case Shape::no_root: return scale[i] * (steepness + (y - r) * (y - r));
      case Shape::root: return scale[i] * (sqrt(y) - std::abs(r));
      default: {
        T product(scale[i]);
        for (int k = 0; k < degree; ++k) product = product * (y - roots(i, k));
        return product;
      }
    }
  }
};

RandomSystem random_system(Draw& draw) {
  RandomSystem s;
  s.shape = draw.one_of({Shape::product, Shape::product, Shape::chain, Shape::exponential, Shape::saturating,
                         Shape::no_root, Shape::root});
  s.n = draw.whole(1, most);
  s.degree = draw.whole(1, 3);
  s.steepness = draw.log_uniform(1e-3, 30);
  s.a = MatrixXd::Identity(s.n, s.n);
  s.roots.resize(s.n, 3);
  s.scale.resize(s.n);
  const double apart = draw.log_uniform(1e-3, 1), size = draw.log_uniform(0.1, 10);
  for (int i = 0; i < s.n; ++i) {
    for (int j = 0; j < s.n; ++j) s.a(i, j) += apart * draw.uniform(-1, 1);
    for (int k = 0; k < 3; ++k) s.roots(i, k) = size * draw.uniform(-1, 1);
    if (draw.chance(0.1)) s.roots(i, 1) = s.roots(i, 0);  // a double root
    s.scale[i] = draw.chance(0.3) ? draw.signed_log(1e-12, 1e12) : 1;
  }
  return s;
}

template <class T>
std::vector<T> numbers(const VectorXd& x) {
  return {x.begin(), x.end()};
}

void residual(const RandomSystem& s, const VectorXd& x, VectorXd& f) {
  const auto at = numbers<double>(x);
  for (int i = 0; i < s.n; ++i) f[i] = s.component<double>(at, i);
}

void derivative(const RandomSystem& s, const VectorXd& x, MatrixXd& b) {
  using D = Dual<double, most>;
  std::vector<D> at;
  for (int i = 0; i < s.n; ++i) at.push_back(D::variable(x[i], i));
  for (int i = 0; i < s.n; ++i) {
    const D f = s.component<D>(at, i);
    for (int j = 0; j < s.n; ++j) b(i, j) = f.partial[static_cast<std::size_t>(j)];
  }
}

/// A component in long double. If the argument at the root is negative by less than the rounding error of the
/// sum in double, the value is that of argument 0, as in double.
long double exact_component(const RandomSystem& s, const std::vector<long double>& x, int i) {
  if (s.shape != Shape::root) return s.component(x, i);
  long double y = 0, size = 0;
  for (int j = 0; j < s.n; ++j) {
    const long double term = s.a(i, j) * x[static_cast<std::size_t>(j)];
    y += term;
    size += std::abs(term);
  }
  const bool is_edge = y < 0 && y >= -s.n * std::numeric_limits<double>::epsilon() * size;
  return is_edge ? -s.scale[i] * std::abs(static_cast<long double>(s.roots(i, 0))) : s.component(x, i);
}

/// |F| in long double, and the deviation of |F| in double from it.
struct ErrorNorm {
  double length = 0, rounding = 0;
};

ErrorNorm error_norm(const RandomSystem& s, const VectorXd& x) {
  const auto exact = numbers<long double>(x);
  const auto at = numbers<double>(x);
  long double square = 0, off = 0;
  for (int i = 0; i < s.n; ++i) {
    const long double f = exact_component(s, exact, i), g = s.component<double>(at, i);
    square += f * f;
    off += (f - g) * (f - g);
  }
  return {static_cast<double>(std::sqrt(square)), static_cast<double>(std::sqrt(off))};
}

Report solved(const NamedSolver& method, algebraic::Equations& equations, VectorXd& x) {
  if (method.name != "kinsol") return find_root(method, equations, x);
  const peers::Kinsol kinsol{.tolerance = method.tolerance * method.scale, .iterations = method.iterations};
  return peers::find_root(kinsol, equations, x);
}

TEST(RandomisedAlgebraic, ARootHasTheResidualThatWasAskedFor) {
  std::vector<std::string> names;
  for (const std::string_view name : algebraic::solver_names()) {
    if (name != "energy-trust-region") names.emplace_back(name);
  }
  if (peers::kinsol_available()) names.emplace_back("kinsol");
  randomised_test({.quick = 1500, .full = 200'000, .least_right = 0.2}, [&](Draw& draw) {
    const RandomSystem s = random_system(draw);
    algebraic::DenseEquations equations(
        s.n, [&](const VectorXd& x, VectorXd& f) { residual(s, x, f); },
        [&](const VectorXd& x, MatrixXd& b) { derivative(s, x, b); });
    NamedSolver method{.name = draw.one_of(names), .iterations = 200};
    method.tolerance = draw.log_uniform(1e-16, 1e-2);
    method.scale = draw.chance(0.5) ? 1 : draw.log_uniform(1e-8, 1e8);
    method.to_rounding = draw.chance(0.2);
    VectorXd x(s.n);
    const double spread = draw.log_uniform(1e-3, 10);
    for (int i = 0; i < s.n; ++i) x[i] = s.roots(i, 0) + spread * draw.normal();
    const Report report = solved(method, equations, x);
    if (!report.status.ok()) return Case::refused(report.status.text());
    const ErrorNorm at_end = error_norm(s, x);
    // The greatest component, for the peer.
    const double bound =
        method.name == "kinsol" ? method.tolerance * method.scale * std::sqrt(s.n) : report.bound;
    return Case::judged(
        at_end.length, bound + at_end.rounding,
        fmt::format("{}: shape {}, n = {}, degree {}, tolerance {:.3g} of {:.3g}, to rounding {}, "
                    "|F| = {:.3g}",
                    method.name, static_cast<int>(s.shape), s.n, s.degree, method.tolerance, method.scale,
                    method.to_rounding, at_end.length));
  });
}

// The argument is 9 * 2^-60 below 0 in long double and 0 in double: F is -|r| in both.
TEST(RandomisedAlgebraic, TheEdgeOfADomainIsKnownToRounding) {
  const RandomSystem s{.shape = Shape::root,
                       .n = 2,
                       .a = MatrixXd{{1 + 3 * 0x1p-30, -1}, {0, 1}},
                       .roots = MatrixXd::Zero(2, 3),
                       .scale = VectorXd::Ones(2)};
  const ErrorNorm at = error_norm(s, VectorXd{{1 - 3 * 0x1p-30, 1}});
  EXPECT_EQ(at.length, 1);
  EXPECT_EQ(at.rounding, 0);
  EXPECT_TRUE(std::isnan(error_norm(s, VectorXd{{1 - 0x1p-20, 1}}).length));
}

/// V = sum of w_i f(y_i) with y = A x: wells, so that V has minima, saddle points and maxima.
struct Wells : algebraic::Potential {
  MatrixXd a, hessian;
  VectorXd weight, place;

  [[nodiscard]] Eigen::Index size() const override { return a.cols(); }
  template <class T>
  [[nodiscard]] Eigen::Matrix<T, Eigen::Dynamic, 1> gradient(const VectorXd& x) const {
    using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    const Column y = a.cast<T>() * x.cast<T>() - place.cast<T>();
    Column slope(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) slope[i] = T(weight[i]) * y[i] * (y[i] * y[i] - 1);
    return a.cast<T>().transpose() * slope;
  }
  void residual(const VectorXd& x, VectorXd& f) override { f = gradient<double>(x); }
  void linearise(const VectorXd& x) override {
    const VectorXd y = a * x - place;
    hessian = a.transpose() * (weight.array() * (3 * y.array().square() - 1)).matrix().asDiagonal() * a;
  }
  void apply(const VectorXd& v, VectorXd& out) const override { out.noalias() = hessian * v; }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override { out.noalias() = hessian * v; }
  void matrix(MatrixXd& b) const override { b = hessian; }
  [[nodiscard]] double energy(const VectorXd& x) override {
    const auto square = (a * x - place).array().square();
    return (weight.array() * (square * square / 4 - square / 2)).sum();
  }
};

TEST(RandomisedAlgebraic, TheEnergyEndsInAMinimum) {
  randomised_test({.quick = 500, .full = 100'000, .least_right = 0.3}, [](Draw& draw) {
    Wells wells;
    const int n = draw.whole(1, most);
    wells.a = MatrixXd::Identity(n, n);
    wells.weight.resize(n);
    wells.place.resize(n);
    VectorXd x(n);
    const double apart = draw.log_uniform(1e-4, 1), spread = draw.log_uniform(1e-6, 100);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) wells.a(i, j) += apart * draw.uniform(-1, 1);
      wells.weight[i] = draw.log_uniform(1e-4, 1e4);
      wells.place[i] = draw.uniform(-1, 1);
      x[i] = draw.chance(0.2) ? 0 : spread * draw.normal();
    }
    NamedSolver method{.name = "energy-trust-region", .tolerance = draw.log_uniform(1e-14, 1e-3)};
    method.scale = wells.weight.maxCoeff();
    method.to_rounding = draw.chance(0.3);
    const Report report = find_root(method, wells, x);
    if (!report.status.ok()) return Case::refused(report.status.text());
    const std::string what = fmt::format("n = {}, tolerance {:.3g}", n, method.tolerance);
    wells.linearise(x);
    // The matrix has an error of eps times its norm, at a point that is a minimum up to rounding.
    const MatrixXd shifted = wells.hessian + 1e-12 * wells.hessian.norm() * MatrixXd::Identity(n, n);
    if (Eigen::LLT<MatrixXd>(shifted).info() != Eigen::Success) return Case::wrong(what + ": no minimum");
    const auto exact = wells.gradient<long double>(x);
    const double rounding =
        static_cast<double>((exact - wells.gradient<double>(x).cast<long double>()).norm());
    return Case::judged(static_cast<double>(exact.norm()), report.bound + rounding, what);
  });
}

/// The system as typed.
std::string text_of(const RandomSystem& s) {
  std::string text;
  for (int i = 0; i < s.n; ++i) {
    if (s.shape == Shape::chain) {
      text += i == 0 ? fmt::format("{:.17g} ({:.17g} - x0) = 0; ", s.scale[0], s.roots(0, 0))
                     : fmt::format("{0:.17g} (x{1} - x{2}^2) = 0; ", s.scale[i], i, i - 1);
      continue;
    }
    std::string y = "0";
    for (int j = 0; j < s.n; ++j) y += fmt::format(" + {:.17g}*x{}", s.a(i, j), j);
    const double r = s.roots(i, 0);
    text += fmt::format("y{} = {}; ", i, y) + fmt::format("{:.17g} ", s.scale[i]);
    switch (s.shape) {
      case Shape::exponential:
        text += fmt::format("(exp({0:.17g} y{1}) - exp({0:.17g}*({2:.17g})))", s.steepness, i, r);
        break;
      case Shape::saturating:
        text += fmt::format(
            "({0:.17g}*(y{1} - ({2:.17g}))/sqrt(1 + ({0:.17g}*(y{1} - ({2:.17g})))^2) + 0.01*(y{1} - "
            "({2:.17g})))",
            s.steepness, i, r);
        break;
      case Shape::no_root: text += fmt::format("({:.17g} + (y{} - ({:.17g}))^2)", s.steepness, i, r); break;
      case Shape::root: text += fmt::format("(sqrt(y{}) - {:.17g})", i, std::abs(r)); break;
      default:
        for (int k = 0; k < s.degree; ++k) text += fmt::format("(y{} - ({:.17g}))", i, s.roots(i, k));
    }
    text += " = 0; ";
  }
  return text;
}

/// Largest distance of a component from its nearest root, over what the bounds of x and the rounding of the
/// text allow.
double distance_from_roots(const RandomSystem& s, const VectorXd& x, const VectorXd& bound) {
  constexpr double eps = 4 * std::numeric_limits<double>::epsilon();
  double worst = 0;
  long double link = s.roots(0, 0);
  for (int i = 0; i < s.n; ++i) {
    if (s.shape == Shape::chain) {
      worst = std::max(worst, static_cast<double>(std::abs(x[i] - link) /
                                                  (bound[i] + eps * (i + 1) * std::abs(link) + 1e-300L)));
      link *= link;
      continue;
    }
    long double y = 0, allowed = 0;
    for (int j = 0; j < s.n; ++j) {
      y += static_cast<long double>(s.a(i, j)) * x[j];
      allowed += std::abs(s.a(i, j)) * (bound[j] + eps * std::abs(x[j]));
    }
    long double least = HUGE_VALL;
    for (int k = 0; k < (s.shape == Shape::product ? s.degree : 1); ++k) {
      const long double r =
          s.shape == Shape::root ? std::pow(static_cast<long double>(s.roots(i, 0)), 2) : s.roots(i, k);
      least = std::min(least, std::abs(y - r) / (allowed + eps * std::abs(r) + 1e-300L));
    }
    worst = std::max(worst, static_cast<double>(least));
  }
  return worst;
}

TEST(RandomisedAlgebraic, ATypedSystemHasARootWhereOneIsReported) {
  randomised_test({.quick = 600, .full = 100'000, .least_right = 0.2}, [&](Draw& draw) {
    const RandomSystem s = random_system(draw);
    const std::string text = text_of(s);
    const algebraic::TypedSystem system(program::SourceText("--equation", text));
    const std::vector<algebraic::TypedSolver> solvers = typed_solvers(system);
    const algebraic::TypedSolver& solver = draw.one_of(solvers);
    VectorXd x(s.n);
    const double spread = draw.log_uniform(1e-3, 10);
    for (int i = 0; i < s.n; ++i) x[i] = s.roots(i, 0) + spread * draw.normal();
    // Names in the order of the text: all unknowns occur in the first equation, but for a chain one by one.
    const algebraic::TypedSolution found = solve_by(solver, system, x, draw.log_uniform(1e-13, 1e-2), 200);
    if (!found.status.ok()) return Case::refused(found.status.text());
    const std::string what = fmt::format("{}: {} as {}", solver.name, text, to_string(found.root.kind));
    if (s.shape == Shape::no_root) return Case::wrong(what + " has no root");
    return Case::judged(distance_from_roots(s, found.root.x, found.root.bound), 1, what);
  });
}

}  // namespace
}  // namespace nlmech::randomised::algebraic_test
