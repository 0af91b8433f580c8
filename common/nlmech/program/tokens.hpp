/// @file
/// Tokens of equations.
#pragma once

#include <vector>

#include "nlmech/program/source_text.hpp"

namespace nlmech::program {

/// Separator of statements, in addition to line ends.
enum class Separator : char { semicolon = ';', comma = ',' };

/// Kind of a token. Each sign is a kind.
enum class TokenKind {
  number,
  name,
  plus,
  minus,
  times,
  over,
  power,
  open,
  close,
  comma,
  equals,
  at_least,          ///< >=
  at_most,           ///< <=
  above,             ///< >
  below,             ///< <
  text,              ///< "..." after `table(`
  end_of_statement,  ///< a semicolon, or the end of a line after which the statement is complete
  end_of_text
};

/// A token: a number, name or sign.
struct Token {
  TokenKind kind;     ///< what
  Place place;        ///< place in the text, including primes
  double number = 0;  ///< value of a number
  int primes = 0;     ///< number of primes of a name
  Place name;         ///< place of a name without its primes
  bool after_blank;   ///< is it preceded by a blank or the start of the text?
};

/// All tokens of a text; the last is end_of_text. `#` starts a comment, to the end of its line. The end of a
/// line ends a statement unless a bracket is open or a sign lacks its second operand.
/// @throws InputError with the position of text that cannot be part of an equation, and for a number that is
/// not finite
[[nodiscard]] std::vector<Token> tokens_of(const SourceText& source, Separator separator);

}  // namespace nlmech::program
