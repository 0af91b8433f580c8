/// Coefficients of explicit Runge-Kutta methods against the order conditions of all rooted trees: those of
/// order 8(5,3) in extended precision, those of ode45 in double.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "nlmech/ivp/runge_kutta/dop853_coefficients.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "tests/ivp/coefficient_table.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::runge_kutta_coefficients_test {
namespace {

using oracle::Real;
using testing::CoefficientTable;
using Weights = std::vector<Real>;

constexpr std::size_t all_stages = dop853::all_stages, end_of_step = dop853::stages;
// Rounding error of the coefficients, with 26 digits after the point and sizes up to 500, summed over sixteen
// stages and through products of weights up to 40.
constexpr double rounding = 1e-23;

CoefficientTable written() { return {"dop853", 156}; }

/// The coefficients with all their digits.
struct Exact {
  std::vector<Weights> a, dense;
  Weights c, third, fifth;
  Exact() {
    const CoefficientTable table = written();
    const auto get = [&](const std::string& key) { return table.get(key); };
    for (std::size_t i = 1; i <= all_stages; ++i) {
      const std::string n = std::to_string(i);
      c.push_back(get("c," + n + ","));
      third.push_back(get("third," + n + ","));
      fifth.push_back(get("fifth," + n + ","));
      a.emplace_back();
      for (std::size_t j = 1; j <= all_stages; ++j)
        a.back().push_back(get("a," + n + "," + std::to_string(j)));
    }
    for (int r = 4; r <= 7; ++r) {
      dense.emplace_back();
      for (std::size_t i = 1; i <= all_stages; ++i)
        dense.back().push_back(get("dense," + std::to_string(r) + "," + std::to_string(i)));
    }
  }
};

const Exact& exact() {
  static const Exact coefficients;
  return coefficients;
}

/// A rooted tree: its number of nodes, its density, and for each stage the product over the branches of their
/// sums. The weights turn this product into the elementary weight.
struct Tree {
  int order;
  Real density;
  Weights product;
};

/// All trees of up to @p most nodes for the rows @p a, each once: a tree of n nodes is a multiset of trees
/// with n - 1 nodes in total, written in descending order of their indices in the list.
std::vector<Tree> trees(int most, const std::vector<Weights>& a = exact().a) {
  const std::size_t stages = a.size();
  std::vector<Tree> all;
  std::vector<Weights> sums;  // sum_j a_ij product_j of each tree
  const auto add = [&](const Tree& tree) {
    all.push_back(tree);
    Weights sum(stages, 0);
    for (std::size_t i = 0; i < stages; ++i) {
      for (std::size_t j = 0; j < i; ++j) sum[i] += a[i][j] * tree.product[j];
    }
    sums.push_back(sum);
  };
  for (int order = 1; order <= most; ++order) {
    std::vector<Tree> found;
    const std::function<void(Tree, int, std::size_t)> grow = [&](const Tree& tree, int left,
                                                                 std::size_t end) {
      if (left == 0) found.push_back({order, tree.density * order, tree.product});
      for (std::size_t branch = 0; branch < end && left > 0; ++branch) {
        if (all[branch].order > left) continue;
        Tree grown = tree;
        grown.density *= all[branch].density;
        for (std::size_t i = 0; i < stages; ++i) grown.product[i] *= sums[branch][i];
        grow(grown, left - all[branch].order, branch + 1);
      }
    };
    grow({0, 1, Weights(stages, 1)}, order - 1, all.size());
    for (const Tree& tree : found) add(tree);
  }
  return all;
}

/// Residual of the order condition of @p tree at the fraction @p s of a step: sum of weights minus
/// s^order/density.
double miss(const Weights& weights, const Tree& tree, const Real& s = 1) {
  Real sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * tree.product[i];
  return static_cast<double>(abs(Real(sum - pow(s, tree.order) / tree.density)));
}

/// Largest residual over all trees of @p order nodes.
double worst(const std::vector<Tree>& all, int order, const Weights& weights, const Real& s = 1) {
  double largest = 0;
  for (const Tree& tree : all) {
    if (tree.order == order) largest = std::max(largest, miss(weights, tree, s));
  }
  return largest;
}

TEST(Dop853Coefficients, TreesAreCounted) {
  std::map<int, int> counts;
  for (const Tree& tree : trees(8)) ++counts[tree.order];
  EXPECT_EQ(counts, (std::map<int, int>{{1, 1}, {2, 1}, {3, 2}, {4, 4}, {5, 9}, {6, 20}, {7, 48}, {8, 115}}));
}

TEST(Dop853Coefficients, RowsSumToTheirAbscissa) {
  const Exact& e = exact();
  for (std::size_t i = 0; i < all_stages; ++i) {
    Real sum = 0;
    for (std::size_t j = 0; j < i; ++j) sum += e.a[i][j];
    EXPECT_LT(abs(Real(sum - e.c[i])), Real(rounding)) << i + 1;
  }
}

// The conditions of all 200 trees up to eight nodes hold, those of nine nodes do not.
TEST(Dop853Coefficients, FormulaIsOfOrderEight) {
  const std::vector<Tree> all = trees(9);
  for (int order = 1; order <= 8; ++order)
    EXPECT_LT(worst(all, order, exact().a[end_of_step]), rounding) << order;
  EXPECT_GT(worst(all, 9, exact().a[end_of_step]), 1e-7);
}

// The embedded formulas of the error estimate.
TEST(Dop853Coefficients, EstimatesAreOfOrdersFiveAndThree) {
  const std::vector<Tree> all = trees(6);
  Weights fifth = exact().a[end_of_step];
  for (std::size_t i = 0; i < all_stages; ++i) fifth[i] -= exact().fifth[i];
  for (int order = 1; order <= 5; ++order) EXPECT_LT(worst(all, order, fifth), rounding) << order;
  EXPECT_GT(worst(all, 6, fifth), 1e-5);
  for (int order = 1; order <= 3; ++order) EXPECT_LT(worst(all, order, exact().third), rounding) << order;
  EXPECT_GT(worst(all, 4, exact().third), 1e-4);
}

/// Weights of the stages at the fraction s of a step, from the expanded polynomial.
Weights dense_weights(const Real& s) {
  const Exact& e = exact();
  const Real u = 1 - s;
  Weights weights;
  for (std::size_t i = 0; i < all_stages; ++i) {
    const Real way = e.a[end_of_step][i], first = i == 0 ? 1 : 0, last = i == end_of_step ? 1 : 0;
    const Real begin = first - way;
    const Real inner = e.dense[0][i] + s * (e.dense[1][i] + u * (e.dense[2][i] + s * e.dense[3][i]));
    weights.emplace_back(s * (way + u * (begin + s * (way - last - begin + u * inner))));
  }
  return weights;
}

// Eight points determine a polynomial of degree 7 that is zero at 0.
TEST(Dop853Coefficients, DenseOutputIsOfOrderSeven) {
  const std::vector<Tree> all = trees(8);
  for (int k = 1; k <= 8; ++k) {
    const Real s = Real(k) / 8;
    for (int order = 1; order <= 7; ++order)
      EXPECT_LT(worst(all, order, dense_weights(s), s), rounding) << order << " at " << k << "/8";
  }
  EXPECT_GT(worst(all, 8, dense_weights(Real(1) / 2), Real(1) / 2), 1e-9);
}

TEST(Dop853Coefficients, HeaderIsTheTableRounded) {
  CoefficientTable table = written();
  const auto same = [&](double mine, const std::string& key) { table.expect_rounded(mine, key); };
  for (std::size_t i = 0; i < all_stages; ++i) {
    const std::string n = std::to_string(i + 1);
    same(dop853::c[i], "c," + n + ",");
    if (i < dop853::stages) {
      same(dop853::third[i], "third," + n + ",");
      same(dop853::fifth[i], "fifth," + n + ",");
    }
    for (std::size_t j = 0; j + 1 < all_stages; ++j)
      same(dop853::a[i][j], "a," + n + "," + std::to_string(j + 1));
    for (std::size_t r = 0; r < 4; ++r) same(dop853::dense[r][i], "dense," + std::to_string(r + 4) + "," + n);
  }
  table.expect_all_compared();
}

// ------------------------------------------------------------ ode45

/// The rows of ode45, and the weights of its stages at a fraction s of a step.
std::vector<Weights> ode45_rows() {
  std::vector<Weights> rows;
  for (const auto& row : dormand_prince::a) {
    rows.emplace_back(row.begin(), row.end());
    rows.back().emplace_back(0);
  }
  return rows;
}
Weights ode45_weights(double s) {
  Weights b;
  for (const auto& w : dormand_prince::dense) b.emplace_back(s * (w[0] + s * (w[1] + s * (w[2] + s * w[3]))));
  return b;
}

constexpr double double_rounding = 64 * std::numeric_limits<double>::epsilon();  // weights up to 10 cancel

TEST(Ode45Coefficients, FormulaIsOfOrderFiveAndItsCompanionOfFour) {
  const std::vector<Weights> rows = ode45_rows();
  const std::vector<Tree> all = trees(6, rows);
  const Weights& fifth = rows.back();
  Weights fourth = fifth;
  for (std::size_t i = 0; i < fourth.size(); ++i) fourth[i] -= dormand_prince::difference[i];
  for (int order = 1; order <= 5; ++order) EXPECT_LT(worst(all, order, fifth), double_rounding) << order;
  EXPECT_GT(worst(all, 6, fifth), 1e-5);
  for (int order = 1; order <= 4; ++order) EXPECT_LT(worst(all, order, fourth), double_rounding) << order;
  EXPECT_GT(worst(all, 5, fourth), 1e-5);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Real sum = 0;
    for (const Real& a : rows[i]) sum += a;
    EXPECT_LT(abs(Real(sum - dormand_prince::c[i])), Real(double_rounding));
  }
}

// At the end of the step the quartic equals the fifth-order formula, and its slope equals f.
TEST(Ode45Coefficients, DenseOutputIsOfOrderFour) {
  const std::vector<Weights> rows = ode45_rows();
  const std::vector<Tree> all = trees(4, rows);
  for (const double s : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (int order = 1; order <= 4; ++order)
      EXPECT_LT(worst(all, order, ode45_weights(s), s), double_rounding) << order << " at " << s;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_LT(abs(Real(ode45_weights(1)[i] - rows.back()[i])), Real(double_rounding));
    const auto& w = dormand_prince::dense[i];
    EXPECT_NEAR(w[0] + 2 * w[1] + 3 * w[2] + 4 * w[3], i + 1 == rows.size() ? 1 : 0, double_rounding);
  }
}

}  // namespace
}  // namespace nlmech::ivp::runge_kutta_coefficients_test
