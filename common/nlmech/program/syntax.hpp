/// @file
/// What an equation says, as a tree.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nlmech/program/functions.hpp"
#include "nlmech/program/source_text.hpp"
#include "nlmech/program/tokens.hpp"

namespace nlmech::program {

/// What a node of the tree is.
enum class SyntaxKind {
  number,    ///< a number
  name,      ///< t, pi, a definition, an unknown or a derivative of one
  negative,  ///< - operand
  sum,       ///< operands, each added or (`inverse`) subtracted
  product,   ///< operands, each a factor or (`inverse`) a divisor
  power,     ///< two operands
  call,      ///< a function of its operands
  // Conditions, the first operand of `if` alone:
  comparison,  ///< of two operands, by `relation`
  both,        ///< all operands hold
  either,      ///< one of the operands holds
  opposite     ///< the operand does not hold
};

/// A part of an expression. Sums and products hold all their operands, so that a tree is as deep as its
/// brackets and no deeper.
struct Syntax {
  /// An operand, by its place in the tree.
  struct Operand {
    std::size_t node;      ///< index
    bool inverse = false;  ///< subtracted, or a divisor
  };
  SyntaxKind kind;                     ///< what
  Place place;                         ///< where
  double number = 0;                   ///< of a number
  std::string name = {};               ///< of a name; of a table, that of its file
  int primes = 0;                      ///< of a name
  Function function = {};              ///< of a call
  TokenKind relation = {};             ///< of a comparison: at_least, at_most, above or below
  std::vector<Operand> operands = {};  ///< of all else
};

/// `left = right`
struct Statement {
  std::size_t left;   ///< root of an expression
  std::size_t right;  ///< root of an expression
  Place place;        ///< of all of it
};

/// ``x'(0) = 1``: a value that a solution has where it begins.
struct InitialValue {
  std::string name;   ///< of the unknown
  int primes;         ///< which derivative
  Place place;        ///< of `x'(0)`
  std::size_t time;   ///< root of the expression in the brackets
  std::size_t value;  ///< root of the expression behind the sign
};

/// `name <= expression`: the end of the time, a bound of a component, or for which values of a definition the
/// equations have a meaning.
struct Condition {
  std::size_t left;    ///< root of an expression
  TokenKind relation;  ///< at_least, at_most, above or below
  std::size_t right;   ///< root of an expression
  Place place;         ///< of all of it
};

/// A whole text.
struct SyntaxTree {
  std::vector<Syntax> nodes;                 ///< operands before what they are operands of
  std::vector<Statement> statements;         ///< equations and definitions
  std::vector<InitialValue> initial_values;  ///< those that the text gives
  std::vector<Condition> conditions;         ///< what holds of the time, the state and the definitions
  std::vector<std::size_t> conserved;        ///< `conserved expression`: roots of the expressions
};

/// How deep brackets, powers and signs may be nested.
inline constexpr int most_nested = 200;
/// How long a text may be, in bytes.
inline constexpr std::size_t most_bytes = 1'000'000;

/// Reads equations and definitions, with separators or line ends between; some may be empty.
/// @throws InputError that points at a mistake and says what was expected
[[nodiscard]] SyntaxTree parse(const SourceText& source, Separator separator = Separator::semicolon);

/// Reads the list of `name = expression` and names, each as a statement; both sides of a name are the name.
/// @throws InputError as parse()
[[nodiscard]] SyntaxTree parse_columns(const SourceText& source);

/// Reads one expression. Appends it to a tree; its root is the last node.
/// @throws InputError as parse()
[[nodiscard]] std::size_t parse_expression(const SourceText& source, SyntaxTree& tree);

}  // namespace nlmech::program
