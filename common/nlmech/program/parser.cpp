#include <fmt/format.h>

#include <algorithm>

#include "nlmech/program/syntax.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {
namespace {

/// Recursive descent parser. Increasing precedence: sum, product (also implicit, with the precedence of * and
/// /), sign, power (right-associative).
class Parser {
 public:
  Parser(const SourceText& source, SyntaxTree& tree, Separator separator)
      : source_(source), tree_(tree), tokens_(tokens_of(source, separator)) {}

  void statements() {
    while (peek().kind != TokenKind::end_of_text) {
      if (peek().kind == TokenKind::end_of_statement) {
        ++at_;
      } else {
        statement();
      }
    }
  }

  void columns() {
    while (!next_is(TokenKind::end_of_text)) {
      if (next_is(TokenKind::end_of_statement)) {
        ++at_;
        continue;
      }
      const std::size_t first = peek().place.begin, left = sum();
      std::size_t right = left;
      if (next_is(TokenKind::equals)) {
        ++at_;
        right = sum();
      }
      end_statement("an operator, = or the end of the column");
      tree_.statements.push_back({left, right, {first, tree_.nodes[right].place.end}});
    }
  }

  std::size_t only_expression() {
    const std::size_t root = sum();
    if (peek().kind != TokenKind::end_of_text) throw expected("an operator or the end");
    return root;
  }

 private:
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] bool next_is(TokenKind kind) const { return peek().kind == kind; }
  const Token& take() { return tokens_[at_++]; }
  [[nodiscard]] std::string_view name_of(const Token& token) const { return source_.at(token.name); }

  [[nodiscard]] InputError expected(std::string_view what) const {
    const Token& token = peek();
    if (token.kind == TokenKind::end_of_text)
      return source_.mistake(token.place, fmt::format("expected {}, but the text ends here", what));
    if (token.kind == TokenKind::end_of_statement)
      return source_.mistake(token.place, fmt::format("expected {}, but the equation ends here", what));
    return source_.mistake(token.place, fmt::format("expected {}", what));
  }

  void statement() {
    if (begins_initial_value()) return initial_value();
    if (begins_conserved()) return conserved();
    const std::size_t first = peek().place.begin, left = sum();
    if (is_relation(peek().kind)) return condition(first, left);
    if (!next_is(TokenKind::equals)) throw expected("an operator or =");
    ++at_;
    const std::size_t right = sum();
    if (next_is(TokenKind::equals))
      throw source_.mistake(peek().place, "an equation must have exactly one sign =");
    end_statement("an operator or the end of the equation");
    tree_.statements.push_back({left, right, {first, tree_.nodes[right].place.end}});
  }
  void end_statement(std::string_view what) {
    if (!next_is(TokenKind::end_of_statement) && !next_is(TokenKind::end_of_text)) throw expected(what);
  }

  static bool is_relation(TokenKind kind) {
    return kind == TokenKind::at_least || kind == TokenKind::at_most || kind == TokenKind::above ||
           kind == TokenKind::below;
  }
  void condition(std::size_t first, std::size_t left) {
    const TokenKind relation = take().kind;
    const std::size_t right = sum();
    end_statement("an operator or the end of the condition");
    tree_.conditions.push_back({left, relation, right, {first, tree_.nodes[right].place.end}});
  }

  // Is the next statement `conserved expression`? The expression has no sign of an equation or condition,
  // except comparisons within brackets.
  [[nodiscard]] bool begins_conserved() const {
    if (!next_is(TokenKind::name) || name_of(peek()) != "conserved" || peek().primes > 0) return false;
    int depth = 0;
    for (std::size_t ahead = 1;; ++ahead) {
      const TokenKind kind = peek(ahead).kind;
      if (kind == TokenKind::end_of_text || kind == TokenKind::end_of_statement) return ahead > 1;
      depth += kind == TokenKind::open ? 1 : kind == TokenKind::close ? -1 : 0;
      if (depth == 0 && (kind == TokenKind::equals || is_relation(kind))) return false;
    }
  }
  void conserved() {
    ++at_;
    tree_.conserved.push_back(sum());
    end_statement("an operator or the end of what is conserved");
  }

  // Is the next statement x'(0) = ...? A name that is not a function, directly followed by a bracket, and =
  // after the bracket.
  [[nodiscard]] bool begins_initial_value() const {
    if (!next_is(TokenKind::name) || peek(1).kind != TokenKind::open || peek(1).after_blank) return false;
    if (function_by_name(name_of(peek()))) return false;
    const std::size_t behind = behind_bracket(1);
    return behind > 0 && peek(behind).kind == TokenKind::equals;
  }
  // Number of tokens to the token after the closing bracket; 0: it is not closed.
  [[nodiscard]] std::size_t behind_bracket(std::size_t ahead) const {
    for (int depth = 0;; ++ahead) {
      const TokenKind kind = peek(ahead).kind;
      if (kind == TokenKind::end_of_text || kind == TokenKind::end_of_statement) return 0;
      depth += kind == TokenKind::open ? 1 : kind == TokenKind::close ? -1 : 0;
      if (depth == 0) return ahead + 1;
    }
  }
  void initial_value() {
    const Token& name = take();
    ++at_;  // bracket
    const std::size_t time = sum();
    if (!next_is(TokenKind::close)) throw expected("an operator or )");
    const Place place{name.place.begin, take().place.end};
    ++at_;  // sign
    const std::size_t value = sum();
    end_statement("an operator or the end of the initial value");
    tree_.initial_values.push_back({std::string(name_of(name)), name.primes, place, time, value});
  }

  std::size_t add(Syntax node) {
    tree_.nodes.push_back(std::move(node));
    return tree_.nodes.size() - 1;
  }
  [[nodiscard]] Place span(std::size_t first, std::size_t last) const {
    return {tree_.nodes[first].place.begin, tree_.nodes[last].place.end};
  }
  std::size_t gathered(SyntaxKind kind, std::vector<Syntax::Operand> operands) {
    if (operands.size() == 1) return operands.front().node;
    const Place place = span(operands.front().node, operands.back().node);
    return add({.kind = kind, .place = place, .operands = std::move(operands)});
  }

  std::size_t sum() {
    std::vector<Syntax::Operand> terms = {{product()}};
    while (next_is(TokenKind::plus) || next_is(TokenKind::minus)) {
      const bool minus = take().kind == TokenKind::minus;
      terms.push_back({product(), minus});
    }
    return gathered(SyntaxKind::sum, std::move(terms));
  }

  // Does the next token start a factor without a sign before it?
  [[nodiscard]] bool stands_beside() const {
    if (next_is(TokenKind::number))
      throw source_.mistake(peek().place, "a number must precede what it multiplies; else write * or ^");
    if (conditions_ > 0 && (next_is_word("and") || next_is_word("or"))) return false;
    return next_is(TokenKind::name) || next_is(TokenKind::open);
  }

  std::size_t product() {
    std::vector<Syntax::Operand> factors = {{signed_factor()}};
    for (;;) {
      if (next_is(TokenKind::times) || next_is(TokenKind::over)) {
        const bool divisor = take().kind == TokenKind::over;
        factors.push_back({signed_factor(), divisor});
      } else if (stands_beside()) {
        if (factors.back().inverse && !is_fraction(factors)) throw ambiguous_division(factors);
        factors.push_back({power()});
      } else {
        return gathered(SyntaxKind::product, std::move(factors));
      }
    }
  }
  // `1/2 x` means (1/2) x; `a/b x` is ambiguous.
  [[nodiscard]] bool is_fraction(const std::vector<Syntax::Operand>& factors) const {
    if (factors.size() != 2 || tree_.nodes[factors[1].node].kind != SyntaxKind::number) return false;
    const Syntax& first = tree_.nodes[factors[0].node];
    const bool negative = first.kind == SyntaxKind::negative;
    return (negative ? tree_.nodes[first.operands[0].node] : first).kind == SyntaxKind::number;
  }
  [[nodiscard]] InputError ambiguous_division(const std::vector<Syntax::Operand>& factors) const {
    const std::string_view a = source_.at(tree_.nodes[factors[factors.size() - 2].node].place),
                           b = source_.at(tree_.nodes[factors.back().node].place),
                           c = source_.at(peek().place);
    const auto part = [](std::string_view text) { return quoted_input(text, 20); };
    return source_.mistake(
        peek().place, fmt::format("is this ({0}/{1}) {2} or {0}/({1} {2})? Set brackets, or write *", part(a),
                                  part(b), next_is(TokenKind::open) ? "(...)" : part(c)));
  }

  // Counts the depth of nested brackets, signs and exponents.
  class Nested {
   public:
    Nested(Parser& parser) : parser_(parser) {
      if (++parser.depth_ > most_nested)
        throw parser.source_.mistake(parser.peek().place,
                                     fmt::format("nested more than {} deep", most_nested));
    }
    ~Nested() { --parser_.depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;

   private:
    Parser& parser_;
  };

  std::size_t signed_factor() {
    if (!next_is(TokenKind::minus) && !next_is(TokenKind::plus)) return power();
    const Nested nested(*this);
    const Token& sign = take();
    const std::size_t operand = signed_factor();
    if (sign.kind == TokenKind::plus) return operand;
    return add({.kind = SyntaxKind::negative,
                .place = {sign.place.begin, tree_.nodes[operand].place.end},
                .operands = {{operand}}});
  }

  std::size_t power() {
    const std::size_t base = primary();
    if (!next_is(TokenKind::power)) return base;
    const Nested nested(*this);
    ++at_;
    const std::size_t exponent = signed_factor();
    return add({.kind = SyntaxKind::power, .place = span(base, exponent), .operands = {{base}, {exponent}}});
  }

  std::size_t primary() {
    const Token& token = peek();
    if (token.kind == TokenKind::number) {
      ++at_;
      return add({.kind = SyntaxKind::number, .place = token.place, .number = token.number});
    }
    if (token.kind == TokenKind::name) return name_or_call();
    if (token.kind == TokenKind::open) return bracket();
    throw expected("a number, a name or (");
  }
  std::size_t bracket() {
    const Nested nested(*this);
    const std::size_t begin = take().place.begin, inside = sum();
    if (!next_is(TokenKind::close)) throw expected("an operator or )");
    tree_.nodes[inside].place = {begin, take().place.end};
    return inside;
  }

  [[nodiscard]] bool next_is_word(std::string_view word) const {
    return next_is(TokenKind::name) && source_.at(peek().place) == word;
  }
  // Increasing precedence: or, and, not, comparison. In conditions these words are not names.
  std::size_t condition() {
    ++conditions_;
    const std::size_t root = alternatives();
    --conditions_;
    return root;
  }
  std::size_t alternatives() {
    std::vector<Syntax::Operand> all = {{conjunction()}};
    while (next_is_word("or")) {
      ++at_;
      all.push_back({conjunction()});
    }
    return gathered(SyntaxKind::either, std::move(all));
  }
  std::size_t conjunction() {
    std::vector<Syntax::Operand> all = {{single_condition()}};
    while (next_is_word("and")) {
      ++at_;
      all.push_back({single_condition()});
    }
    return gathered(SyntaxKind::both, std::move(all));
  }
  std::size_t single_condition() {
    const Nested nested(*this);
    if (next_is_word("not")) {
      const std::size_t begin = take().place.begin, inside = single_condition();
      return add({.kind = SyntaxKind::opposite,
                  .place = {begin, tree_.nodes[inside].place.end},
                  .operands = {{inside}}});
    }
    if (next_is(TokenKind::open) && bracket_is_condition()) {
      ++at_;
      const std::size_t inside = alternatives();
      if (!next_is(TokenKind::close)) throw expected("and, or or )");
      ++at_;
      return inside;
    }
    const std::size_t left = sum();
    if (!is_relation(peek().kind)) throw expected("an operator or one of < <= > >=");
    const TokenKind relation = take().kind;
    const std::size_t right = sum();
    if (is_relation(peek().kind)) throw source_.mistake(peek().place, "join two comparisons by and");
    return add({.kind = SyntaxKind::comparison,
                .place = span(left, right),
                .relation = relation,
                .operands = {{left}, {right}}});
  }
  // Is the bracket a condition? The bracket of an expression is followed by an operator or a relation.
  [[nodiscard]] bool bracket_is_condition() const {
    const std::size_t behind = behind_bracket(0);
    if (behind == 0) return false;
    const Token& next = peek(behind);
    return next.kind == TokenKind::comma || next.kind == TokenKind::close ||
           (next.kind == TokenKind::name &&
            (source_.at(next.place) == "and" || source_.at(next.place) == "or"));
  }

  std::size_t name_or_call() {
    const Token& token = take();
    const std::string_view name = name_of(token);
    if (const auto function = function_by_name(name)) return call(token, *function);
    if (next_is(TokenKind::open) && !peek().after_blank) throw no_function(token);
    return add(
        {.kind = SyntaxKind::name, .place = token.place, .name = std::string(name), .primes = token.primes});
  }
  // The error for a name that is no function, directly followed by a bracket.
  [[nodiscard]] InputError no_function(const Token& token) const {
    const std::string name = quoted_input(source_.at(token.place));
    const std::string product =
        fmt::format("for a product write {}*(...), or a blank before the bracket", name);
    if (is_unknown(token) && bracket_has_time())
      return source_.mistake(
          token.place, peek(2).kind == TokenKind::close
                           ? fmt::format("write an unknown as {}, without the time", name)
                           : fmt::format("{} at another time: delays are not supported; {}", name, product));
    if (!is_name(token)) {
      if (const std::string there = function_hint(name); !there.empty())
        return source_.mistake(token.place, fmt::format("{} is not a function here; {}", name, there));
    }
    return source_.mistake(token.place, fmt::format("{} is no function; {}", name, product));
  }
  [[nodiscard]] bool is_unknown(const Token& token) const {
    return std::ranges::any_of(tokens_, [&](const Token& other) {
      return other.kind == TokenKind::name && other.primes > 0 && name_of(other) == name_of(token);
    });
  }
  // Does the name occur anywhere without a bracket directly after it?
  [[nodiscard]] bool is_name(const Token& token) const {
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
      const bool alone = tokens_[i + 1].kind != TokenKind::open || tokens_[i + 1].after_blank;
      if (tokens_[i].kind == TokenKind::name && name_of(tokens_[i]) == name_of(token) && alone) return true;
    }
    return false;
  }
  [[nodiscard]] bool bracket_has_time() const {
    for (std::size_t ahead = 1; ahead < behind_bracket(0); ++ahead) {
      if (peek(ahead).kind == TokenKind::name && source_.at(peek(ahead).place) == "t") return true;
    }
    return false;
  }
  std::size_t call(const Token& token, const FunctionInfo& function) {
    const Nested nested(*this);
    if (token.primes > 0)
      throw source_.mistake(token.place,
                            fmt::format("{} is a function and cannot have a prime", function.name));
    if (next_is(TokenKind::power))
      throw source_.mistake(peek().place,
                            fmt::format("write a power of a function as {}(...)^2", function.name));
    if (!next_is(TokenKind::open))
      throw source_.mistake(
          token.place,
          fmt::format("{0} is a function, and needs its argument in brackets: {0}(...)", function.name));
    ++at_;
    if (function.function == Function::table) return table(token);
    std::vector<Syntax::Operand> arguments = {{function.function == Function::choose ? condition() : sum()}};
    while (next_is(TokenKind::comma)) {
      ++at_;
      arguments.push_back({sum()});
    }
    if (!next_is(TokenKind::close)) throw expected("an operator or )");
    const Place place{token.place.begin, take().place.end};
    if (static_cast<int>(arguments.size()) != function.arguments)
      throw source_.mistake(place,
                            fmt::format("{} takes {} argument{}, not {}", function.name, function.arguments,
                                        function.arguments == 1 ? "" : "s", arguments.size()));
    return add({.kind = SyntaxKind::call,
                .place = place,
                .function = function.function,
                .operands = std::move(arguments)});
  }

  // table("load.csv") or table("load.csv", steps)
  std::size_t table(const Token& token) {
    if (!next_is(TokenKind::text)) throw expected("the name of a file in quotation marks");
    const std::string_view quoted = source_.at(take().place);
    Function function = Function::table;
    if (next_is(TokenKind::comma)) {
      ++at_;
      if (!next_is_word("steps")) throw expected("the word steps");
      ++at_;
      function = Function::stepped_table;
    }
    if (!next_is(TokenKind::close)) throw expected(")");
    return add({.kind = SyntaxKind::call,
                .place = {token.place.begin, take().place.end},
                .name = std::string(quoted.substr(1, quoted.size() - 2)),
                .function = function});
  }

  const SourceText& source_;
  SyntaxTree& tree_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0, conditions_ = 0;
};

void check_length(const SourceText& source) {
  if (source.text().size() > most_bytes)
    throw source.mistake({most_bytes, most_bytes + 1}, fmt::format("longer than {} bytes", most_bytes));
}

}  // namespace

SyntaxTree parse(const SourceText& source, Separator separator) {
  check_length(source);
  SyntaxTree tree;
  Parser(source, tree, separator).statements();
  return tree;
}

SyntaxTree parse_columns(const SourceText& source) {
  check_length(source);
  SyntaxTree tree;
  Parser(source, tree, Separator::semicolon).columns();
  return tree;
}

std::size_t parse_expression(const SourceText& source, SyntaxTree& tree) {
  check_length(source);
  return Parser(source, tree, Separator::semicolon).only_expression();
}

}  // namespace nlmech::program
