/// @file
/// The words and signs of an equation.
#pragma once

#include <vector>

#include "nlmech/program/source_text.hpp"

namespace nlmech::program {

/// What stands between statements beside the ends of lines.
enum class Separator : char { semicolon = ';', comma = ',' };

/// What a token is. Signs are their own kind.
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
  text,              ///< "..." behind `table(`
  end_of_statement,  ///< a semicolon, or the end of a line after which the statement is complete
  end_of_text
};

/// A word or sign.
struct Token {
  TokenKind kind;     ///< what
  Place place;        ///< where, primes included
  double number = 0;  ///< of a number
  int primes = 0;     ///< behind a name
  Place name;         ///< of a name, without its primes
  bool after_blank;   ///< does a blank or the start of the text stand before it?
};

/// All tokens of a text; the last is end_of_text. `#` begins a comment, to the end of its line. The end of a
/// line ends a statement unless a bracket is open or a sign waits for its second operand.
/// @throws InputError that points at what can be no part of an equation, and for a number that is not finite
[[nodiscard]] std::vector<Token> tokens_of(const SourceText& source, Separator separator);

}  // namespace nlmech::program
