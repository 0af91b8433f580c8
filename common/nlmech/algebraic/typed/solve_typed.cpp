#include "nlmech/algebraic/typed/solve_typed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Typical sizes of the unknowns.
VectorXd sizes_of(const VectorXd& start, const VectorXd& end) {
  const double largest = start.cwiseAbs().maxCoeff(), fallback = largest > 0 ? largest : 1;
  VectorXd size = start.cwiseAbs();
  for (Index i = 0; i < size.size(); ++i)
    size[i] = std::max(size[i] > 0 ? size[i] : fallback, std::isfinite(end[i]) ? std::abs(end[i]) : 0);
  return size;
}

/// Typed equations in units of their sizes. With an energy the matrix stays symmetric.
/// @tparam Base Equations or Potential
template <class Base>
class ScaledEquations : public Base {
 public:
  ScaledEquations(const TypedSystem& system, const VectorXd& start, const VectorXd& unit)
      : system_(system), unit_(unit), f_(start.size()) {
    system_.residual(start, f_);
    system_.derivative(start, j_);
    rows_ = (j_.leftCols(size()) * unit_.asDiagonal()).cwiseAbs().rowwise().sum().cwiseMax(f_.cwiseAbs());
    if constexpr (std::is_same_v<Base, Potential>)
      rows_ = unit_.cwiseInverse() * (rows_.cwiseProduct(unit_)).maxCoeff();
    for (double& row : rows_) row = std::isfinite(row) && row > 1e-300 ? row : 1;
  }

  [[nodiscard]] Index size() const override { return unit_.size(); }
  void residual(const VectorXd& y, VectorXd& f) override {
    const VectorXd x = unit_.cwiseProduct(y);
    if (system_.contains(x))
      system_.residual(x, f);
    else
      f.setConstant(size(), std::numeric_limits<double>::quiet_NaN());
    f.array() /= rows_.array();
  }
  void linearise(const VectorXd& y) override {
    system_.derivative(unit_.cwiseProduct(y), j_);
    b_ = rows_.cwiseInverse().asDiagonal() * j_.leftCols(size()) * unit_.asDiagonal();
  }
  void apply(const VectorXd& v, VectorXd& out) const override { out.noalias() = b_ * v; }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override {
    out.noalias() = b_.transpose() * v;
  }
  void matrix(MatrixXd& b) const override { b = b_; }

 protected:
  [[nodiscard]] double scaled_energy(const VectorXd& y) const {
    const VectorXd x = unit_.cwiseProduct(y);
    return system_.contains(x) ? system_.energy(x) / (rows_[0] * unit_[0]) : HUGE_VAL;
  }

 private:
  const TypedSystem& system_;
  VectorXd unit_, rows_, f_;
  MatrixXd j_, b_;
};

class ScaledPotential final : public ScaledEquations<Potential> {
 public:
  using ScaledEquations::ScaledEquations;
  [[nodiscard]] double energy(const VectorXd& y) override { return scaled_energy(y); }
};

/// Is there a root, to the tolerance?
Status status_of_root(const TypedSolution& all, double tolerance) {
  const CheckedRoot& root = all.root;
  if (root.kind == CheckedRoot::Kind::none)
    return failed_with(Outcome::spurious_root,
                       "{}: ends with |F| below its tolerance, but {}; start elsewhere", all.solver,
                       root.reason);
  const double error = root.error(all.typical);
  // What rounding of well-scaled equations leaves is no fault of the solver.
  const double allowed =
      root.kind == CheckedRoot::Kind::proved
          ? std::max(tolerance, 64 * std::numeric_limits<double>::epsilon() * root.condition)
          : std::pow(tolerance, 1. / root.order);
  if (error <= allowed) return {};
  return failed_with(
      Outcome::not_converged,
      "{}: rounding leaves the root uncertain by {:.2g} of its size; take a tolerance above that", all.solver,
      error);
}

}  // namespace

std::vector<TypedSolver> typed_solvers(const TypedSystem& system) {
  std::vector<TypedSolver> all;
  for (const std::string_view name : solver_names()) {
    if (name == "energy-trust-region" && !system.has_energy()) continue;
    all.push_back({std::string(name),
                   [name](double tolerance, std::int64_t iterations, Equations& equations, VectorXd& x) {
                     return find_root(NamedSolver{.name = std::string(name),
                                                  .tolerance = tolerance,
                                                  .iterations = iterations,
                                                  .to_rounding = true},
                                      equations, x);
                   }});
  }
  return all;
}

namespace {

/// solve_by() from @p start, judged in the sizes of @p own and of the end: another start that was tried,
/// perhaps far away, does not decide what is small.
TypedSolution solve_from(const TypedSolver& solver, const TypedSystem& system, const VectorXd& start,
                         const VectorXd& own, double tolerance, std::int64_t iterations) {
  TypedSolution all;
  all.solver = solver.name;
  const Stopwatch time;
  const VectorXd unit = start.unaryExpr([](double x) { return x != 0 ? std::abs(x) : 1; });
  VectorXd y = start.cwiseQuotient(unit);
  const auto run = [&](Equations&& equations) { return solver.run(tolerance, iterations, equations, y); };
  all.report = system.has_energy() ? run(ScaledPotential(system, start, unit))
                                   : run(ScaledEquations<Equations>(system, start, unit));
  all.end = unit.cwiseProduct(y);
  all.seconds = time.seconds();
  all.typical = sizes_of(own, all.end);
  const bool is_near = all.report.status.ok() || all.report.last <= 1e-4 * all.report.first;
  if (is_near && all.end.allFinite()) {
    all.root = check_root(system, all.end, all.typical);
    if (all.root.x.allFinite()) all.typical = all.typical.cwiseMax(all.root.x.cwiseAbs());
    all.digits =
        -std::log10(std::max((all.end - all.root.x).cwiseQuotient(all.typical).cwiseAbs().maxCoeff(), 1e-16));
  } else {
    all.root.x = all.end;
    all.root.reason = "the solver fails";
  }
  all.status = all.report.status.ok() ? status_of_root(all, tolerance) : all.report.status;
  return all;
}

}  // namespace

TypedSolution solve_by(const TypedSolver& solver, const TypedSystem& system, const VectorXd& start,
                       double tolerance, std::int64_t iterations) {
  return solve_from(solver, system, start, start, tolerance, iterations);
}

std::vector<VectorXd> starts_around(const TypedSystem& system, const VectorXd& start, double size,
                                    int count) {
  std::mt19937_64 bits(20150514);
  // From the bits, since distributions differ between libraries.
  const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  std::vector<VectorXd> all;
  for (int k = 0; k < count; ++k) {
    VectorXd x = start;
    for (Index i = 0; i < x.size(); ++i) {
      x[i] += size * (start[i] != 0 ? std::abs(start[i]) : 1) * (2 * uniform() - 1);
      x[i] = std::clamp(x[i], system.lower()[i], system.upper()[i]);
    }
    all.push_back(std::move(x));
  }
  return all;
}

/// The next multiples of the start, by powers of ten up and down, at which no equation is far larger than the
/// change that the unknowns can make: none if the start is such a point.
std::vector<VectorXd> other_sizes(const TypedSystem& system, const VectorXd& start) {
  const auto is_balanced = [&](const VectorXd& x) {
    VectorXd f;
    MatrixXd j;
    system.residual(x, f);
    system.derivative(x, j);
    const VectorXd change = (j.leftCols(x.size()) * x.asDiagonal()).cwiseAbs().rowwise().sum();
    return f.allFinite() && change.allFinite() && (f.cwiseAbs().array() <= 4 * change.array()).all();
  };
  std::vector<VectorXd> all;
  if (is_balanced(start)) return all;
  for (const int sign : {1, -1}) {
    for (int k = 1; k <= 300; ++k) {
      const VectorXd x = start * std::pow(10., sign * k);
      if (!system.contains(x) || !is_balanced(x)) continue;
      all.push_back(x);
      break;
    }
  }
  return all;
}

TypedSolution solve_by_several(const TypedSystem& system, const VectorXd& start, double tolerance,
                               std::int64_t iterations, int& tried) {
  const std::vector<TypedSolver> solvers = typed_solvers(system);
  // A solver that fails near a root, as at singular ones, has found it: the check improves its end.
  const auto by = [&](std::string_view name, const VectorXd& from) {
    TypedSolution found = solve_from(*std::ranges::find(solvers, name, &TypedSolver::name), system, from,
                                     start, tolerance, iterations);
    if (!found.status.ok() && status_of_root(found, tolerance).ok()) found.status = {};
    return found;
  };
  tried = 1;
  TypedSolution lowest;
  if (system.has_energy()) {
    TypedSolution found = by("energy-trust-region", start);
    if (found.status.ok()) return found;
  }
  for (const std::string_view name : {"dogleg", "levenberg-marquardt", "damped-newton", "riks"}) {
    TypedSolution found = by(name, start);
    // A root that rounding hides from the tolerance is no better from elsewhere.
    if (found.status.ok() || found.root.kind == CheckedRoot::Kind::proved) return found;
    if (name == "levenberg-marquardt") lowest = std::move(found);
  }
  std::vector<VectorXd> others = other_sizes(system, start);
  for (const double size : {0.1, 1., 10., 100.}) {
    for (VectorXd& from : starts_around(system, start, size, 8)) others.push_back(std::move(from));
  }
  for (const VectorXd& from : others) {
    ++tried;
    for (const std::string_view name : {"dogleg", "levenberg-marquardt"}) {
      TypedSolution found = by(name, from);
      if (found.status.ok()) return found;
    }
  }
  const bool is_minimum = lowest.end.allFinite() && is_stationary(system, lowest.end, lowest.typical);
  lowest.status = failed_with(
      lowest.status.ok() ? Outcome::not_converged : lowest.status.outcome(),
      "{}; no root from {} other starts either",
      is_minimum ? "from the start |F| falls to a minimum that is no root" : lowest.status.sentence(),
      tried - 1);
  return lowest;
}

}  // namespace nlmech::algebraic
