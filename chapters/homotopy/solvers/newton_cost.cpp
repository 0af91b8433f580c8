#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
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
using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
using CountedFactors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<Counted>>;

/// Largest number of unknowns for which the L D L^T formula is compared with a count.
constexpr Index most_counted = 100;

/// Operations of one Newton iteration.
struct Cost {
  const char* frame = "";
  Index unknowns = 0;
  double elements = 0;
  double assembly = 0;    ///< counted operations of F and B
  double sparse = 0;      ///< sparse_operations()
  double difference = 0;  ///< |count - sparse|; 0 if not counted

  /// Operations of a dense inverse, and of LU; leading terms (Golub and Van Loan).
  [[nodiscard]] double inverse() const { return 2 * std::pow(static_cast<double>(unknowns), 3); }
  [[nodiscard]] double lu() const { return inverse() / 3; }
  [[nodiscard]] double share(double solving) const { return solving / (assembly + solving); }
  [[nodiscard]] double share_of_inverse() const { return share(inverse()); }
  [[nodiscard]] double share_of_lu() const { return share(lu()); }
  [[nodiscard]] double share_of_sparse() const { return share(sparse); }
};

/// Operations of Eigen's up-looking L D L^T with a shift and of its substitutions, computed from the numbers
/// of subdiagonal entries in the columns of L.
double sparse_operations(const Eigen::SparseMatrix<double>& b) {
  const Factors factors(b);
  const Eigen::SparseMatrix<double>& l = factors.matrixL().nestedExpression();
  const auto n = static_cast<double>(b.rows()), nonzeros = static_cast<double>(b.nonZeros());
  double sum = (nonzeros + n) / 2 + 2 * n + 2 * n;  // scatter, shift; division by D
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

/// Cost of one iteration at the displacements @p x. @throws Failure if the frame has no tangent there
Cost cost_of(const char* name, const frames::Frame& frame, const VectorXd& x) {
  std::int64_t operations = 0;
  const CountedVector at = counted(x, &operations);
  CountedVector force;
  Eigen::SparseMatrix<Counted> tangent;
  for (const Status& status : {frame.force<Counted>(at, force), frame.tangent<Counted>(at, tangent)}) {
    if (!status.ok()) throw Failure(status);
  }
  Cost cost{.frame = name,
            .unknowns = x.size(),
            .elements = static_cast<double>(frame.members().size()),
            .assembly = static_cast<double>(operations)};
  cost.sparse =
      sparse_operations(tangent.unaryExpr([](const Counted& entry) { return entry.value; }).cast<double>());
  if (x.size() > most_counted) return cost;
  CountedFactors factors;
  factors.analyzePattern(tangent);  // once per frame, not per iteration
  operations = 0;
  factors.factorize(tangent);
  // The count does not depend on the right-hand side if no entry is 0.
  static_cast<void>(factors.solve(counted(VectorXd::Ones(x.size()), &operations)).eval());
  cost.difference = std::abs(static_cast<double>(operations) - cost.sparse);
  return cost;
}

/// Cost for half the toggle of 0.44 in under 36 lb.
Cost cost_of_toggle(int elements) {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = elements});
  frames::Equilibrium equations(toggle.frame, toggle.load, 36);
  VectorXd x = VectorXd::Zero(toggle.frame.size());
  const Status status = find_root(algebraic::EnergyTrustRegion{}, equations, x).status;
  if (!status.ok()) throw Failure(status);
  return cost_of("half toggle", toggle.frame, x);
}

/// Cost for a square lattice of n by n joints 1 in apart with clamped lowest row and the members' rigidities
/// of the toggle; displacements up to 1e-3.
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

std::vector<Cost> compute() {
  std::vector<Cost> all;
  for (const int elements : {1, 2, 4, 11, 34, 101, 334, 1001}) all.push_back(cost_of_toggle(elements));
  for (const int n : {2, 4, 8, 16, 32, 64, 128}) all.push_back(cost_of_lattice(n));
  return all;
}

/// Bounds of the operations per element of F and B. Each evaluates both power series one to five times: 28
/// and 22 steps of Horner's rule of six operations, six at the ends, and at most 34 around each evaluation.
/// The rest takes at most 500.
constexpr double least_assembly = 2 * 306, most_assembly = 2 * (5 * (306 + 34) + 500);

void put(const std::vector<Cost>& all, scene::Show& show) {
  show.table(all, {{"frame", &Cost::frame},
                   {"unknowns", &Cost::unknowns},
                   {"operations of F and B", &Cost::assembly, 4},
                   {"of the inverse", &Cost::inverse, 4},
                   {"of dense LU", &Cost::lu, 4},
                   {"of sparse LDL^T", &Cost::sparse, 4},
                   {"share of the inverse", &Cost::share_of_inverse, 3},
                   {"share of dense LU", &Cost::share_of_lu, 3},
                   {"share of sparse LDL^T", &Cost::share_of_sparse, 3}});
  double difference = 0;
  for (const Cost& k : all) {
    difference = std::max(difference, k.difference);
    show.between(fmt::format("operations of F and B an element, {}, n = {}", k.frame, k.unknowns),
                 k.assembly / k.elements, least_assembly, most_assembly,
                 "612 to 4400 by the formulas of the element");
  }
  show.equals("largest difference of the formula for LDL^T from its count, up to 100 unknowns", difference, 0,
              "sums over the loops");
  const auto check_share = [&](const std::string& name, const Cost& cost, double solving) {
    show.between(name, cost.share(solving), solving / (solving + most_assembly * cost.elements),
                 solving / (solving + least_assembly * cost.elements),
                 "the formula against 612 to 4400 operations of F and B an element");
  };
  for (const std::size_t i : {3U, 5U, 7U}) {
    const Cost& k = all.at(i);
    const std::string n = fmt::format("toggle, n = {}", k.unknowns);
    check_share("share of the dense inverse, " + n, k, k.inverse());
    check_share("share of dense LU, " + n, k, k.lu());
    check_share("share of sparse LDL^T, " + n, k, k.sparse);
  }
  check_share("share of sparse LDL^T, largest lattice", all.back(), all.back().sparse);
  // Columns of L with 5, 4 and 3 entries: c (c + 2) and 4 c; 15 entries scattered, 6 shifts, 6 divisions by
  // D.
  const Cost& chain = all.at(7);
  show.near("operations of sparse LDL^T an element, 1001 elements", chain.sparse / chain.elements,
            35 + 24 + 15 + 48 + 15 + 6 + 6, 2e-3,
            "columns of L with 5, 4 and 3 entries below the diagonal; the ends have less");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result costs(
      "operations-of-newton",
      "F and B counted at an equilibrium of the half toggle 0.44 in high under 36 lb and of a square lattice "
      "of such members; LDL^T by a formula that counts confirm up to 100 unknowns, dense matrices by 2 n^3 "
      "and "
      "2 n^3/3",
      compute);
  return {{.name = "newton-cost",
           .title = "Operations of one Newton iteration: assembly and three linear solvers",
           .place = "our own, for two claims of section 2.2",
           .content = scene::Content(put, costs)}};
}

}  // namespace nlmech::chapters::homotopy::newton_cost
