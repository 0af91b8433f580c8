/// @file
/// Evaluation of the names and expressions of a text to nodes of a graph.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/syntax.hpp"

namespace nlmech::program {

/// An unknown of the equations.
struct Unknown {
  std::string name;  ///< "x"
  int order;         ///< order of its highest derivative
  Place place;       ///< first occurrence of that derivative
};

/// "x''"
[[nodiscard]] std::string with_primes(const std::string& name, int primes);

/// An expression that is linear in the highest derivatives: rest + sum of coefficients times highest
/// derivatives.
struct LinearForm {
  NodeId rest;                    ///< expression of time and state
  std::map<int, NodeId> highest;  ///< coefficient of the highest derivative by unknown; never the number 0
};

/// Reads the table in a file. @throws InputError with file, line and value
using TableReader = std::function<Table(const std::string& file)>;

/// Symbol table of a text.
struct Names {
  std::vector<Unknown> unknowns;                               ///< in the order of the text
  std::map<std::string, int> numbers;                          ///< index of each unknown, by name
  std::map<std::pair<std::string, int>, int> components;       ///< component of the state, by name and primes
  std::map<std::string, LinearForm> defined;                   ///< evaluated definitions
  TableReader read_table;                                      ///< reads tables; empty: no tables
  double earliest = -std::numeric_limits<double>::infinity();  ///< earliest time covered by all tables
  double latest = std::numeric_limits<double>::infinity();     ///< latest time covered by all tables

  /// The component of the state named by a node of a tree, or -1.
  [[nodiscard]] int component(const Syntax& node) const;
  /// "x'', y'"
  [[nodiscard]] std::string highest() const;
};

/// Evaluates the expressions of a text to nodes of a graph.
class Meaning {
 public:
  /// Largest depth of nested definitions and brackets together.
  static constexpr int most_depth = 1000;
  /// Largest number of operations.
  static constexpr int most_operations = 1'000'000;

  /// @param names receives the definitions
  Meaning(Graph& graph, Names& names, const SourceText& source, const SyntaxTree& tree)
      : graph_(graph), names_(names), source_(source), tree_(tree) {}

  /// Adds a definition, which is evaluated on first use.
  void define(const std::string& name, std::size_t node) { definitions_[name] = node; }
  /// Is it the name of a definition?
  [[nodiscard]] bool is_defined(const std::string& name) const {
    return definitions_.contains(name) || names_.defined.contains(name);
  }
  /// The value of a definition. @param place of the use
  const LinearForm& definition(const std::string& name, const Place& place);

  /// Evaluates an expression that may contain highest derivatives. @throws InputError with the position of
  /// the mistake
  [[nodiscard]] LinearForm form_of(std::size_t node);
  /// Evaluates an expression without highest derivatives. @throws InputError with the position of the mistake
  [[nodiscard]] NodeId expression(std::size_t node);
  /// Evaluates an expression that is a number, independent of time and state.
  /// @param what for messages: "an initial value"
  /// @throws InputError
  [[nodiscard]] double number(std::size_t node, std::string_view what);

  /// to -= what
  void subtract(LinearForm& to, const LinearForm& what) { add(to, what, true); }

 private:
  [[nodiscard]] LinearForm meaning(const Syntax& node);
  void check_numbers(const LinearForm& form, const Syntax& node) const;
  [[nodiscard]] LinearForm name(const Syntax& node);
  [[nodiscard]] std::string unknown_name(const std::string& name) const;
  [[nodiscard]] bool is_known_name(const std::string& name) const;
  void add(LinearForm& to, const LinearForm& what, bool subtract);
  [[nodiscard]] LinearForm scaled(LinearForm form, NodeId factor, bool divide = false);
  [[nodiscard]] LinearForm sum(const Syntax& node);
  [[nodiscard]] LinearForm product(const Syntax& node);
  [[nodiscard]] LinearForm power(const Syntax& node);
  [[nodiscard]] LinearForm call(const Syntax& node);
  [[nodiscard]] LinearForm choose(const Syntax& node);
  [[nodiscard]] NodeId table(const Syntax& node);
  [[nodiscard]] NodeId where(std::size_t condition, NodeId yes, NodeId no);
  [[nodiscard]] NodeId argument(std::size_t node);
  [[nodiscard]] InputError nonlinear(std::size_t node, const LinearForm& form, std::string_view where) const;

  Graph& graph_;
  Names& names_;
  const SourceText& source_;
  const SyntaxTree& tree_;
  std::map<std::string, std::size_t> definitions_;  // definitions with their expressions
  std::map<std::string, bool> open_;                // definitions under evaluation
  std::size_t handled_ = 0;                         // number of processed terms of linear forms
  int depth_ = 0;
};

}  // namespace nlmech::program
