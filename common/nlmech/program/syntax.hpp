/// @file
/// Syntax tree of equations.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nlmech/program/functions.hpp"
#include "nlmech/program/source_text.hpp"
#include "nlmech/program/tokens.hpp"

namespace nlmech::program {

/// Kind of a node of the tree.
enum class SyntaxKind {
  number,    ///< a number
  name,      ///< t, pi, a definition, an unknown or a derivative of one
  negative,  ///< - operand
  sum,       ///< operands, each added or (`inverse`) subtracted
  product,   ///< operands, each a factor or (`inverse`) a divisor
  power,     ///< two operands
  call,      ///< a function of its operands
  // Conditions, only as the first operand of `if`:
  comparison,  ///< two operands compared by `relation`
  both,        ///< all operands are true
  either,      ///< one of the operands is true
  opposite     ///< the operand is false
};

/// A node of an expression. Sums and products hold all their operands, so the depth of a tree is that of its
/// brackets.
struct Syntax {
  /// An operand, by its index in the tree.
  struct Operand {
    std::size_t node;      ///< index
    bool inverse = false;  ///< subtracted, or a divisor
  };
  SyntaxKind kind;                     ///< kind of the node
  Place place;                         ///< place in the text
  double number = 0;                   ///< value of a number
  std::string name = {};               ///< a name; for a table the name of its file
  int primes = 0;                      ///< number of primes of a name
  Function function = {};              ///< function of a call
  TokenKind relation = {};             ///< for a comparison: at_least, at_most, above or below
  std::vector<Operand> operands = {};  ///< operands of all other kinds
};

/// `left = right`
struct Statement {
  std::size_t left;   ///< root of an expression
  std::size_t right;  ///< root of an expression
  Place place;        ///< place of the whole statement
};

/// ``x'(0) = 1``: initial value of a solution.
struct InitialValue {
  std::string name;   ///< name of the unknown
  int primes;         ///< order of the derivative
  Place place;        ///< place of `x'(0)`
  std::size_t time;   ///< root of the expression in the brackets
  std::size_t value;  ///< root of the expression after the sign
};

/// `name <= expression`: the final time, a bound of a component, or the admissible values of a definition.
struct Condition {
  std::size_t left;    ///< root of an expression
  TokenKind relation;  ///< at_least, at_most, above or below
  std::size_t right;   ///< root of an expression
  Place place;         ///< place of the whole statement
};

/// Syntax tree of a whole text.
struct SyntaxTree {
  std::vector<Syntax> nodes;                 ///< nodes; operands precede their operations
  std::vector<Statement> statements;         ///< equations and definitions
  std::vector<InitialValue> initial_values;  ///< initial values in the text
  std::vector<Condition> conditions;         ///< conditions on time, state and definitions
  std::vector<std::size_t> conserved;        ///< `conserved expression`: roots of the expressions
};

/// Largest depth of nested brackets, powers and signs.
inline constexpr int most_nested = 200;
/// Largest length of a text, in bytes.
inline constexpr std::size_t most_bytes = 1'000'000;

/// Reads equations and definitions, separated by @p separator or line ends; statements may be empty.
/// @throws InputError with the position of the mistake and what is expected
[[nodiscard]] SyntaxTree parse(const SourceText& source, Separator separator = Separator::semicolon);

/// Reads a list of `name = expression` and names, each as a statement; for a name both sides are the name.
/// @throws InputError as parse()
[[nodiscard]] SyntaxTree parse_columns(const SourceText& source);

/// Reads one expression. Appends it to a tree; its root is the last node.
/// @throws InputError as parse()
[[nodiscard]] std::size_t parse_expression(const SourceText& source, SyntaxTree& tree);

}  // namespace nlmech::program
