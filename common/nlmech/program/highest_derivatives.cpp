#include "nlmech/program/highest_derivatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace nlmech::program {
namespace {

/// Assignment of equations to unknowns, and the blocks of coupled unknowns.
class Structure {
 public:
  Structure(const std::vector<LinearEquation>& equations, int unknowns)
      : equations_(equations), equation_of_(index(unknowns), -1) {
    for (const LinearEquation& e : equations) {
      if (e.highest.size() == 1 && equation_of_[index(e.highest.begin()->first)] < 0)
        equation_of_[index(e.highest.begin()->first)] = static_cast<int>(&e - equations.data());
    }
    for (int e = 0; e < static_cast<int>(equations.size()); ++e) {
      if (std::find(equation_of_.begin(), equation_of_.end(), e) != equation_of_.end()) continue;
      std::vector<bool> seen(equation_of_.size());
      (void)match(e, seen);
    }
  }

  // The first unknown without an equation, or -1.
  [[nodiscard]] int undetermined() const {
    const auto place = std::find(equation_of_.begin(), equation_of_.end(), -1);
    return place == equation_of_.end() ? -1 : static_cast<int>(place - equation_of_.begin());
  }
  [[nodiscard]] const LinearEquation& equation_of(int unknown) const {
    return equations_[index(equation_of_[index(unknown)])];
  }

  // Strongly connected components of the unknowns (Tarjan); a block precedes those that depend on it.
  std::vector<std::vector<int>> blocks() {
    number_.assign(equation_of_.size(), -1);
    lowest_ = number_;
    on_stack_.assign(equation_of_.size(), false);
    for (int u = 0; u < static_cast<int>(equation_of_.size()); ++u) {
      if (number_[index(u)] < 0) visit(u);
    }
    return std::move(blocks_);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  bool match(int equation, std::vector<bool>& seen) {
    for (const auto& [unknown, coefficient] : equations_[index(equation)].highest) {
      if (seen[index(unknown)]) continue;
      seen[index(unknown)] = true;
      int& taken = equation_of_[index(unknown)];
      if (taken < 0 || match(taken, seen)) {
        taken = equation;
        return true;
      }
    }
    return false;
  }
  void visit(int u) {
    number_[index(u)] = lowest_[index(u)] = count_++;
    stack_.push_back(u);
    on_stack_[index(u)] = true;
    for (const auto& [other, coefficient] : equation_of(u).highest) {
      if (number_[index(other)] < 0) {
        visit(other);
        lowest_[index(u)] = std::min(lowest_[index(u)], lowest_[index(other)]);
      } else if (on_stack_[index(other)]) {
        lowest_[index(u)] = std::min(lowest_[index(u)], number_[index(other)]);
      }
    }
    if (lowest_[index(u)] != number_[index(u)]) return;
    std::vector<int> block;
    do {
      block.push_back(stack_.back());
      on_stack_[index(stack_.back())] = false;
      stack_.pop_back();
    } while (block.back() != u);
    std::sort(block.begin(), block.end());
    blocks_.push_back(std::move(block));
  }

  const std::vector<LinearEquation>& equations_;
  std::vector<int> equation_of_, number_, lowest_, stack_;
  std::vector<bool> on_stack_;
  std::vector<std::vector<int>> blocks_;
  int count_ = 0;
};

/// The linear system A h = b with nodes as entries.
struct Block {
  std::vector<std::vector<NodeId>> a;
  std::vector<NodeId> b;
};

/// Solves a block. Numbers: by elimination with partial pivoting. For other entries no pivot is known to be
/// nonzero: up to three unknowns by determinants, more by orthogonal columns, which need no pivots and are as
/// stable (Bjorck, Numerical Methods for Least Squares Problems, 1996, section 2.4: modified Gram-Schmidt,
/// the right-hand side treated as a further column).
class BlockSolver {
 public:
  BlockSolver(Graph& graph, Block block) : g_(graph), a_(std::move(block.a)), b_(std::move(block.b)) {}

  // The solution; none if the determinant is the number 0.
  std::optional<std::vector<NodeId>> solve() {
    const bool numbers = std::all_of(a_.begin(), a_.end(), [this](const std::vector<NodeId>& row) {
      return std::all_of(row.begin(), row.end(), [this](NodeId n) { return g_.is_number(n); });
    });
    return numbers ? by_elimination() : size() <= 3 ? by_determinants() : by_orthogonal_columns();
  }

 private:
  [[nodiscard]] std::size_t size() const { return b_.size(); }
  using Rows = std::vector<std::size_t>;

  // The determinant of the given rows and the columns from @p column on.
  NodeId determinant(const Rows& rows, std::size_t column) {
    if (rows.size() == 1) return a_[rows[0]][column];
    NodeId sum = g_.number(0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Rows others = rows;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const NodeId entry = a_[rows[i]][column];
      if (g_.is_number(entry, 0)) continue;
      const NodeId term = g_.product(entry, determinant(others, column + 1));
      sum = i % 2 == 0 ? g_.sum(sum, term) : g_.difference(sum, term);
    }
    return sum;
  }
  std::optional<std::vector<NodeId>> by_determinants() {
    const Rows all = size() == 1 ? Rows{0} : size() == 2 ? Rows{0, 1} : Rows{0, 1, 2};
    const NodeId whole = determinant(all, 0);
    if (g_.is_number(whole, 0)) return std::nullopt;
    std::vector<NodeId> h;
    for (std::size_t j = 0; j < size(); ++j) {
      std::vector<NodeId> column = b_;
      exchange(j, column);
      h.push_back(g_.quotient(determinant(all, 0), whole));
      exchange(j, column);
    }
    return h;
  }
  void exchange(std::size_t j, std::vector<NodeId>& column) {
    for (std::size_t i = 0; i < size(); ++i) std::swap(a_[i][j], column[i]);
  }

  std::optional<std::vector<NodeId>> by_elimination() {
    for (std::size_t k = 0; k < size(); ++k) {
      const std::size_t pivot = pivot_row(k);
      if (g_.is_number(a_[pivot][k], 0)) return std::nullopt;
      std::swap(a_[k], a_[pivot]);
      std::swap(b_[k], b_[pivot]);
      for (std::size_t i = k + 1; i < size(); ++i) {
        if (g_.is_number(a_[i][k], 0)) continue;
        const NodeId factor = g_.quotient(a_[i][k], a_[k][k]);
        for (std::size_t j = k + 1; j < size(); ++j)
          a_[i][j] = g_.difference(a_[i][j], g_.product(factor, a_[k][j]));
        b_[i] = g_.difference(b_[i], g_.product(factor, b_[k]));
      }
    }
    std::vector<NodeId> h(size());
    for (std::size_t k = size(); k-- > 0;) {
      NodeId rest = b_[k];
      for (std::size_t j = k + 1; j < size(); ++j) rest = g_.difference(rest, g_.product(a_[k][j], h[j]));
      h[k] = g_.quotient(rest, a_[k][k]);
    }
    return h;
  }
  [[nodiscard]] std::size_t pivot_row(std::size_t k) const {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < size(); ++i) {
      if (std::abs(g_[a_[i][k]].c) > std::abs(g_[a_[best][k]].c)) best = i;
    }
    return best;
  }

  std::optional<std::vector<NodeId>> by_orthogonal_columns() {
    std::vector<std::vector<NodeId>> shares(size(), std::vector<NodeId>(size()));
    std::vector<NodeId> h(size());
    for (std::size_t k = 0; k < size(); ++k) {
      const std::vector<NodeId> column = column_of(k);
      const NodeId square = dot(column, column);
      if (g_.is_number(square, 0)) return std::nullopt;
      for (std::size_t j = k + 1; j < size(); ++j) {
        shares[k][j] = g_.quotient(dot(column, column_of(j)), square);
        for (std::size_t i = 0; i < size(); ++i) take_away(a_[i][j], shares[k][j], column[i]);
      }
      h[k] = g_.quotient(dot(column, b_), square);
      for (std::size_t i = 0; i < size(); ++i) take_away(b_[i], h[k], column[i]);
    }
    for (std::size_t k = size(); k-- > 0;) {
      for (std::size_t j = k + 1; j < size(); ++j) take_away(h[k], shares[k][j], h[j]);
    }
    return h;
  }
  [[nodiscard]] std::vector<NodeId> column_of(std::size_t j) const {
    std::vector<NodeId> column;
    for (const std::vector<NodeId>& row : a_) column.push_back(row[j]);
    return column;
  }
  NodeId dot(const std::vector<NodeId>& a, const std::vector<NodeId>& b) {
    NodeId sum = g_.number(0);
    for (std::size_t i = 0; i < a.size(); ++i) sum = g_.sum(sum, g_.product(a[i], b[i]));
    return sum;
  }
  void take_away(NodeId& from, NodeId factor, NodeId what) {
    from = g_.difference(from, g_.product(factor, what));
  }

  Graph& g_;
  std::vector<std::vector<NodeId>> a_;
  std::vector<NodeId> b_;
};

}  // namespace

std::vector<NodeId> HighestDerivatives::solve(const Mistake& mistake) {
  Structure structure(equations_, unknowns_);
  if (const int u = structure.undetermined(); u >= 0) throw mistake(u, "no equation determines it");
  std::vector<NodeId> solved(static_cast<std::size_t>(unknowns_), -1);
  for (const std::vector<int>& block : structure.blocks()) {
    Block system;
    bool numbers = true;
    for (const int row : block) {
      const LinearEquation& e = structure.equation_of(row);
      NodeId b = e.rest;
      system.a.emplace_back(block.size(), graph_.number(0));
      for (const auto& [unknown, coefficient] : e.highest) {
        const auto column = std::find(block.begin(), block.end(), unknown);
        if (column == block.end()) {
          b = graph_.sum(b, graph_.product(coefficient, solved[static_cast<std::size_t>(unknown)]));
        } else {
          system.a.back()[static_cast<std::size_t>(column - block.begin())] = graph_.negative(coefficient);
          numbers = numbers && graph_.is_number(coefficient);
        }
      }
      system.b.push_back(b);
    }
    const int most = numbers ? most_coupled_by_numbers : most_coupled;
    if (static_cast<int>(block.size()) > most)
      throw mistake(block.front(),
                    fmt::format("it is coupled with {} other highest derivatives; at most {} are supported",
                                block.size() - 1, most - 1));
    const auto h = BlockSolver(graph_, std::move(system)).solve();
    if (!h) throw mistake(block.front(), "the equations do not determine it");
    for (std::size_t i = 0; i < block.size(); ++i) solved[static_cast<std::size_t>(block[i])] = (*h)[i];
  }
  return solved;
}

}  // namespace nlmech::program
