/// @file
/// What the names and expressions of a text mean.
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
  int order;         ///< of its highest derivative
  Place place;       ///< where that first stands
};

/// "x''"
[[nodiscard]] std::string with_primes(const std::string& name, int primes);

/// An expression that is linear in the highest derivatives: rest + sum of coefficients times these.
struct LinearForm {
  NodeId rest;                    ///< of time and state
  std::map<int, NodeId> highest;  ///< coefficient of the highest derivative of each unknown; no number 0
};

/// Reads the table in a file. @throws InputError naming file, line and value
using TableReader = std::function<Table(const std::string& file)>;

/// What names mean.
struct Names {
  std::vector<Unknown> unknowns;                               ///< as the text first names them
  std::map<std::string, int> numbers;                          ///< of the unknowns
  std::map<std::pair<std::string, int>, int> components;       ///< of the state, by name and primes
  std::map<std::string, LinearForm> defined;                   ///< definitions that are worked out
  TableReader read_table;                                      ///< none: no tables
  double earliest = -std::numeric_limits<double>::infinity();  ///< time of all tables that were read
  double latest = std::numeric_limits<double>::infinity();     ///< the same

  /// The component of the state that a node of a tree names, or -1.
  [[nodiscard]] int component(const Syntax& node) const;
  /// "x'', y'"
  [[nodiscard]] std::string highest() const;
};

/// Works out the expressions of a text.
class Meaning {
 public:
  /// How deep definitions and brackets may be nested together.
  static constexpr int most_depth = 1000;
  /// How many operations they may make.
  static constexpr int most_operations = 1'000'000;

  /// @param names learns definitions
  Meaning(Graph& graph, Names& names, const SourceText& source, const SyntaxTree& tree)
      : graph_(graph), names_(names), source_(source), tree_(tree) {}

  /// A definition, to be worked out when it is needed.
  void define(const std::string& name, std::size_t node) { definitions_[name] = node; }
  /// Is it the name of a definition?
  [[nodiscard]] bool is_defined(const std::string& name) const {
    return definitions_.contains(name) || names_.defined.contains(name);
  }
  /// A definition. @param place where it is named
  const LinearForm& definition(const std::string& name, const Place& place);

  /// An expression that may hold highest derivatives. @throws InputError that points at the mistake
  [[nodiscard]] LinearForm form_of(std::size_t node);
  /// One that may not. @throws InputError
  [[nodiscard]] NodeId expression(std::size_t node);
  /// One that is a number, which does not change with time and state.
  /// @param what in messages: "an initial value"
  /// @throws InputError
  [[nodiscard]] double number(std::size_t node, std::string_view what);

  /// to - what
  void subtract(LinearForm& to, const LinearForm& what) { add(to, what, true); }

 private:
  [[nodiscard]] LinearForm meaning(const Syntax& node);
  void hold_to_numbers(const LinearForm& form, const Syntax& node) const;
  [[nodiscard]] LinearForm name(const Syntax& node);
  [[nodiscard]] std::string unknown_name(const std::string& name) const;
  [[nodiscard]] bool means_something(const std::string& name) const;
  void add(LinearForm& to, const LinearForm& what, bool subtract);
  [[nodiscard]] LinearForm scaled(LinearForm form, NodeId factor, bool divide = false);
  [[nodiscard]] LinearForm sum(const Syntax& node);
  [[nodiscard]] LinearForm product(const Syntax& node);
  [[nodiscard]] LinearForm power(const Syntax& node);
  [[nodiscard]] LinearForm call(const Syntax& node);
  void hold_to_domain(const Syntax& node, const std::vector<NodeId>& arguments) const;
  [[nodiscard]] LinearForm choose(const Syntax& node);
  [[nodiscard]] NodeId table(const Syntax& node);
  [[nodiscard]] NodeId where(std::size_t condition, NodeId yes, NodeId no);
  [[nodiscard]] NodeId argument(std::size_t node);
  [[nodiscard]] InputError nonlinear(std::size_t node, const LinearForm& form, std::string_view where) const;

  Graph& graph_;
  Names& names_;
  const SourceText& source_;
  const SyntaxTree& tree_;
  std::map<std::string, std::size_t> definitions_;  // and their expressions
  std::map<std::string, bool> open_;                // definitions that are being worked out
  std::size_t handled_ = 0;                         // terms of linear forms
  int depth_ = 0;
};

}  // namespace nlmech::program
