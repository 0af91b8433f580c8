#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/solvers/counted.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::newton_cost {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using CountedVector = Eigen::Matrix<Counted, Eigen::Dynamic, 1>;
using CountedMatrix = Eigen::Matrix<Counted, Eigen::Dynamic, Eigen::Dynamic>;
using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
using CountedFactors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<Counted>>;

/// Matrices of at most so many rows are also inverted and factorised by counting numbers.
constexpr Index most_counted = 100;

/// Operations of the parts of one iteration.
struct Cost {
  const char* frame = "";           ///< which
  Index unknowns = 0, entries = 0;  ///< of B, both halves
  double elements = 0;              ///< of the frame
  double force = 0, tangent = 0;    ///< counted
  double inverse = 0, lu = 0;       ///< of a dense matrix, with the product or the substitutions: formulas
  double sparse = 0;                ///< L D L^T and substitutions: by the columns of L
  double discrepancy = 0;           ///< largest difference of a formula from its count; 0 if none was counted
  double difference = 0;            ///< of the steps of the three, relative, over n eps cond(B); as above

  [[nodiscard]] double assembly() const { return force + tangent; }
  /// Of solving in an iteration.
  [[nodiscard]] double share(double solving) const { return solving / (assembly() + solving); }
  /// What an iteration without solving saves: it has the product B^T F instead.
  [[nodiscard]] double saving() const {
    return 1 - (assembly() + 2 * static_cast<double>(entries)) / (assembly() + sparse);
  }
};

/// Gauss and Jordan's inverse in place; the pivots of a positive definite matrix need no search.
void invert(CountedMatrix& a) {
  const Index n = a.rows();
  for (Index k = 0; k < n; ++k) {
    const Counted pivot = 1 / a(k, k);
    a(k, k) = pivot;
    for (Index j = 0; j < n; ++j) {
      if (j != k) a(k, j) *= pivot;
    }
    for (Index i = 0; i < n; ++i) {
      if (i == k) continue;
      const Counted factor = a(i, k);
      for (Index j = 0; j < n; ++j) {
        if (j != k) a(i, j) -= factor * a(k, j);
      }
      a(i, k) = -factor * pivot;
    }
  }
}

/// Gauss's elimination and substitution; x becomes A^-1 x.
void eliminate(CountedMatrix& a, CountedVector& x) {
  const Index n = a.rows();
  for (Index k = 0; k < n; ++k) {
    for (Index i = k + 1; i < n; ++i) {
      const Counted factor = a(i, k) / a(k, k);
      for (Index j = k + 1; j < n; ++j) a(i, j) -= factor * a(k, j);
      x[i] -= factor * x[k];
    }
  }
  for (Index i = n; i-- > 0;) {
    for (Index j = i + 1; j < n; ++j) x[i] -= a(i, j) * x[j];
    x[i] /= a(i, i);
  }
}

/// Additions, multiplications and divisions of invert() and a product with a vector.
double inverse_operations(double n) { return n * (2 * n * n - 2 * n + 1) + n * (2 * n - 1); }
/// Of eliminate().
double lu_operations(double n) { return n * (n - 1) * (4 * n + 1) / 6 + n * (2 * n - 1); }

/// Of Eigen's up-looking L D L^T with a shift, and its substitutions, by the numbers of entries below the
/// diagonal in the columns of L.
double sparse_operations(const Factors& factors, const Eigen::SparseMatrix<double>& b) {
  const Eigen::SparseMatrix<double>& l = factors.matrixL().nestedExpression();
  const auto n = static_cast<double>(b.rows()), nonzeros = static_cast<double>(b.nonZeros());
  double sum = (nonzeros + n) / 2 + 2 * n + 2 * n;  // scattered, shifted; divided by D
  for (Index j = 0; j < l.cols(); ++j) {
    const auto c = static_cast<double>(l.outerIndexPtr()[j + 1] - l.outerIndexPtr()[j]);
    sum += c * (c + 2) + 4 * c;
  }
  return sum;
}

CountedVector counted(const VectorXd& x, std::int64_t* counter) {
  CountedVector y(x.size());
  for (Index i = 0; i < x.size(); ++i) y[i] = {x[i], counter};
  return y;
}

/// The relative difference of two steps.
double difference(const CountedVector& x, const VectorXd& step) {
  double sum = 0;
  for (Index i = 0; i < x.size(); ++i) sum += (x[i].value - step[i]) * (x[i].value - step[i]);
  return std::sqrt(sum) / step.norm();
}

Eigen::SparseMatrix<double> plain(const Eigen::SparseMatrix<Counted>& b) {
  return b.unaryExpr([](const Counted& entry) { return entry.value; }).cast<double>();
}

/// Solves for @p f by counting numbers in all three ways, and holds the formulas and @p step to them.
void compare(Cost& cost, const Eigen::SparseMatrix<Counted>& b, const VectorXd& f, const VectorXd& step,
             std::int64_t& operations) {
  const auto judge = [&](double formula, const CountedVector& x) {
    cost.discrepancy = std::max(cost.discrepancy, std::abs(static_cast<double>(operations) - formula));
    cost.difference = std::max(cost.difference, difference(x, step));
  };
  const CountedVector right = counted(f, &operations);
  CountedMatrix dense(b);
  for (Counted& entry : dense.reshaped()) entry.counter = &operations;
  CountedMatrix inverse = dense;
  CountedVector x = right;
  operations = 0;
  eliminate(dense, x);
  judge(cost.lu, x);
  operations = 0;
  invert(inverse);
  for (Index i = 0; i < x.size(); ++i) {
    x[i] = inverse(i, 0) * right[0];
    for (Index j = 1; j < x.size(); ++j) x[i] += inverse(i, j) * right[j];
  }
  judge(cost.inverse, x);
  CountedFactors factors;
  factors.analyzePattern(b);  // once a frame, not once an iteration
  operations = 0;
  factors.factorize(b);
  x = factors.solve(right);
  judge(cost.sparse, x);
  const VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(plain(b)), Eigen::EigenvaluesOnly)
          .eigenvalues();
  const double condition = eigenvalues.maxCoeff() / eigenvalues.minCoeff();
  cost.difference /= static_cast<double>(x.size()) * std::numeric_limits<double>::epsilon() * condition;
}

/// One iteration at the displacements @p x. Throws Failure where the frame has no tangent.
Cost cost_of(const char* name, const frames::Frame& frame, const VectorXd& x) {
  std::int64_t operations = 0;
  const CountedVector at = counted(x, &operations);
  Cost cost{.frame = name};
  cost.elements = static_cast<double>(frame.members().size());
  CountedVector force;
  Status status = frame.force<Counted>(at, force);
  if (!status.ok()) throw Failure(status);
  cost.force = static_cast<double>(operations);
  operations = 0;
  Eigen::SparseMatrix<Counted> tangent;
  status = frame.tangent<Counted>(at, tangent);
  if (!status.ok()) throw Failure(status);
  cost.tangent = static_cast<double>(operations);
  const Eigen::SparseMatrix<double> b = plain(tangent);
  cost.unknowns = b.rows();
  cost.entries = b.nonZeros();
  const auto n = static_cast<double>(cost.unknowns);
  cost.inverse = inverse_operations(n);
  cost.lu = lu_operations(n);
  const Factors factors(b);
  cost.sparse = sparse_operations(factors, b);
  // The operations do not depend on the right side, as long as nothing in it is 0.
  const VectorXd f = VectorXd::Ones(x.size());
  if (cost.unknowns <= most_counted) compare(cost, tangent, f, factors.solve(f), operations);
  return cost;
}

/// Half the toggle of 0.44 in under 36 lb.
Cost cost_of_toggle(int elements) {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = elements});
  frames::Equilibrium equations(toggle.frame, toggle.load, 36);
  VectorXd x = VectorXd::Zero(toggle.frame.size());
  const Status status = find_root(algebraic::EnergyTrustRegion{}, equations, x).status;
  if (!status.ok()) throw Failure(status);
  return cost_of("half toggle", toggle.frame, x);
}

/// A square lattice of n by n joints 1 in apart, the lowest row clamped, members as the toggle's, bent by
/// displacements up to 1e-3 of that.
Cost cost_of_lattice(int n) {
  std::vector<frames::Node> nodes;
  std::vector<frames::Member> members;
  std::vector<frames::Support> supports;
  const frames::Toggle like;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int here = n * j + i;
      nodes.push_back({static_cast<double>(i), static_cast<double>(j)});
      if (i > 0) members.push_back({here - 1, here, like.ea, like.ei});
      if (j > 0) members.push_back({here - n, here, like.ea, like.ei});
      for (const auto motion : {frames::Motion::x, frames::Motion::y, frames::Motion::rotation}) {
        if (j == 0) supports.push_back({here, motion});
      }
    }
  }
  const frames::Frame frame(std::move(nodes), std::move(members), supports);
  VectorXd x(frame.size());
  for (Index k = 0; k < x.size(); ++k) x[k] = 1e-3 * std::sin(static_cast<double>(k + 1));
  return cost_of("square lattice", frame, x);
}

struct Costs {
  std::vector<Cost> toggles, lattices;
  Index first_lu = 0, first_inverse = 0,
        first_sparse = 0;  ///< unknowns from which solving takes more than half
};

Costs compute() {
  Costs c;
  for (const int elements : {1, 2, 4, 11, 34, 101, 334, 1001}) c.toggles.push_back(cost_of_toggle(elements));
  for (const int n : {2, 4, 8, 16, 32, 64, 128}) c.lattices.push_back(cost_of_lattice(n));
  for (int elements = 2; c.first_lu == 0 && elements < 200; ++elements) {
    const Cost cost = cost_of_toggle(elements);
    if (c.first_inverse == 0 && cost.share(cost.inverse) > 0.5) c.first_inverse = cost.unknowns;
    if (cost.share(cost.lu) > 0.5) c.first_lu = cost.unknowns;
  }
  for (int n = 8; c.first_sparse == 0 && n < 64; ++n) {
    const Cost cost = cost_of_lattice(n);
    if (cost.share(cost.sparse) > 0.5) c.first_sparse = cost.unknowns;
  }
  return c;
}

void put_table(const Costs& c, scene::Show& show) {
  std::vector<Cost> rows = c.toggles;
  rows.insert(rows.end(), c.lattices.begin(), c.lattices.end());
  show.table(rows, {{"frame", &Cost::frame},
                    {"unknowns", &Cost::unknowns},
                    {"operations of F and B", &Cost::assembly, 4},
                    {"of the inverse", &Cost::inverse, 4},
                    {"of dense LU", &Cost::lu, 4},
                    {"of sparse LDL^T", &Cost::sparse, 4},
                    {"share of the inverse", [](const Cost& k) { return k.share(k.inverse); }, 3},
                    {"share of dense LU", [](const Cost& k) { return k.share(k.lu); }, 3},
                    {"share of sparse LDL^T", [](const Cost& k) { return k.share(k.sparse); }, 3}});
}

void draw(const Costs& c, scene::Show& show) {
  scene::Panel& panel = show.plot("Solving: a dense inverse dominates, a band never", "unknowns",
                                  "share of solving in an iteration");
  panel.key("below").log_x(0.8, 1e5).y_range(0, 1);
  const auto add = [&](const char* name, int style, const std::vector<Cost>& costs, double Cost::*solving) {
    panel.curve(
        name, costs, &Cost::unknowns, [&](const Cost& k) { return k.share(k.*solving); },
        scene::linespoints(style));
  };
  add("toggle, dense inverse", 2, c.toggles, &Cost::inverse);
  add("toggle, dense LU", 3, c.toggles, &Cost::lu);
  add("square lattice, sparse LDL^T", 4, c.lattices, &Cost::sparse);
  add("toggle, sparse LDL^T", 1, c.toggles, &Cost::sparse);
}

/// Operations of F and B an element by the formulas: each evaluates both power series, 28 and 22 steps of
/// Horner's rule of six operations and six at the ends, one to five times, with at most 34 around each, and
/// takes at most 500 for the rest.
constexpr double least_assembly = 2 * 306, most_assembly = 2 * (5 * (306 + 34) + 500);

/// A share of solving between those that the bounds of the assembly leave.
void check_share(const std::string& name, const Cost& cost, double solving, scene::Show& show) {
  show.between(name, cost.share(solving), solving / (solving + most_assembly * cost.elements),
               solving / (solving + least_assembly * cost.elements),
               "the formula against 612 to 4400 operations of F and B an element");
}

/// Of the toggle whose n is about 30, 300 and 3000.
void check_shares(const Costs& c, scene::Show& show) {
  for (const std::size_t i : {3U, 5U, 7U}) {
    const Cost& k = c.toggles.at(i);
    const std::string n = fmt::format("toggle, n = {}", k.unknowns);
    check_share("share of the dense inverse, " + n, k, k.inverse, show);
    check_share("share of dense LU, " + n, k, k.lu, show);
    check_share("share of sparse LDL^T, " + n, k, k.sparse, show);
  }
}

void check_lattices(const Costs& c, scene::Show& show) {
  const Cost &last = c.lattices.back(), &before = c.lattices.at(c.lattices.size() - 2);
  const double exponent = std::log(last.sparse / before.sparse) /
                          std::log(static_cast<double>(last.unknowns) / static_cast<double>(before.unknowns));
  check_share("share of sparse LDL^T, largest lattice", last, last.sparse, show);
  show.between("exponent of n in the operations of sparse LDL^T, lattice", exponent, 1.5, 2,
               "no order of the unknowns takes less than n^(3/2) (Hoffman, Martin and Rose 1973); row by row "
               "it is n^2");
  show.between("unknowns from which sparse LDL^T takes more than half, lattice", c.first_sparse, 720, 2976,
               "recorded: a lattice of 16 to 32 joints a side");
  show.between("share saved by an iteration without solving, largest lattice", last.saving(),
               last.share(last.sparse) - 0.02, last.share(last.sparse),
               "solving, less a product with B: 27 entries a column against 1300 operations of F and B an "
               "unknown");
}

void check_operations(const Costs& c, scene::Show& show) {
  double discrepancy = 0, steps = 0, least = HUGE_VAL, most = 0;
  for (const auto* costs : {&c.toggles, &c.lattices}) {
    for (const Cost& k : *costs) {
      discrepancy = std::max(discrepancy, k.discrepancy);
      steps = std::max(steps, k.difference);
      least = std::min(least, k.assembly() / k.elements);
      most = std::max(most, k.assembly() / k.elements);
    }
  }
  const char* bounds = "612 to 4400 by the formulas of the element";
  show.equals("largest difference of a formula from its count, up to 100 unknowns", discrepancy, 0,
              "sums over the loops");
  show.at_most("largest difference of the steps by three ways, over n eps cond(B)", steps, 1,
               "rounding of one system of linear equations");
  show.between("least operations of F and B an element", least, least_assembly, most_assembly, bounds);
  show.between("most operations of F and B an element", most, least_assembly, most_assembly, bounds);
}

void check_toggles(const Costs& c, scene::Show& show) {
  const Cost& chain = c.toggles.back();
  // 2 n^3 = A n/3 and 2 n^3/3 = A n/3 for A operations an element, three unknowns each.
  show.between("unknowns from which the dense inverse takes more than half, toggle", c.first_inverse,
               std::sqrt(least_assembly / 6), std::sqrt(most_assembly / 6),
               "2 n^3 against 612 to 4400 operations for three unknowns");
  show.between("unknowns from which dense LU takes more than half, toggle", c.first_lu,
               std::sqrt(least_assembly / 2), std::sqrt(most_assembly / 2),
               "2 n^3/3 against 612 to 4400 operations for three unknowns");
  // Columns of L with 5, 4 and 3 entries: c (c + 2) and 4 c; 15 entries scattered, 6 shifts, 6 divided by D.
  show.near("operations of sparse LDL^T an element, 1001 elements", chain.sparse / chain.elements,
            35 + 24 + 15 + 48 + 15 + 6 + 6, 2e-3,
            "columns of L with 5, 4 and 3 entries below the diagonal; the ends have less");
  show.between("share saved by an iteration without solving, toggle, 1001 elements", chain.saving(),
               (149. - 54) / (most_assembly + 149), (149. - 54) / (least_assembly + 149),
               "149 operations less 54 of a product with B, over 612 to 4400 and 149");
}

void put(const Costs& c, scene::Show& show) {
  draw(c, show);
  put_table(c, show);
  check_operations(c, show);
  check_toggles(c, show);
  check_shares(c, show);
  check_lattices(c, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result costs(
      "operations-of-newton",
      "F and B counted at an equilibrium of the half toggle 0.44 in high under 36 lb and of a square lattice "
      "of such members; solving by formulas that counts confirm up to 100 unknowns",
      compute);
  return {{.name = "newton-cost",
           .title = "Operations of one iteration of Newton's: assembly, and solving in four ways",
           .content = scene::Content(put, costs)}};
}

}  // namespace nlmech::chapters::homotopy::newton_cost
