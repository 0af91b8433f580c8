#include "nlmech/program/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Printed signs, with messages that give the typed ones.
constexpr std::array<std::pair<std::string_view, std::string_view>, 20> printed = {{
    {"\u2264", "this is typed <="},
    {"\u2265", "this is typed >="},
    {"\u2212", "a minus sign is typed -"},
    {"\u2013", "a minus sign is typed -"},
    {"\u00b7", "a product is typed *, or with a blank"},
    {"\u22c5", "a product is typed *, or with a blank"},
    {"\u00d7", "a product is typed *, or with a blank"},
    {"\u00f7", "a quotient is typed /"},
    {"\u00b2", "a square is typed ^2"},
    {"\u00b3", "a cube is typed ^3"},
    {"\u00b0", "angles are in radians: write a degree as pi/180"},
    {"\u03c0", "this number is typed pi"},
    {"\u221a", "a root is typed sqrt(...)"},
    {"|", "an absolute value is typed abs(...)"},
    {"\u2032", "a derivative is typed with a straight prime, x'"},
    {"\u2019", "a derivative is typed with a straight prime, x'"},
    {"\u2033", "a second derivative is typed with two straight primes, x''"},
    {"\u201d", "a second derivative is typed with two straight primes, x''"},
    {"\u00a0", "this is not an ordinary blank"},
    {"\u2009", "this is not an ordinary blank"},
}};

/// Splits a text into tokens.
class Reader {
 public:
  Reader(const SourceText& source, Separator separator)
      : source_(source), text_(source.text()), separator_(static_cast<char>(separator)) {}

  std::vector<Token> all() {
    for (;;) {
      const std::size_t before = at_;
      skip_blanks();
      const bool blank = at_ != before || at_ == 0;
      if (at_ == text_.size()) break;
      read(blank);
    }
    add(TokenKind::end_of_text, 0, true);
    return std::move(tokens_);
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      } else if (c != ' ' && c != '\t' && c != '\r' && !(c == '\n' && !ends_statement())) {
        return;
      }
    }
  }
  [[nodiscard]] bool ends_statement() const {
    if (depth_ > 0 || tokens_.empty()) return false;
    const TokenKind last = tokens_.back().kind;
    return last == TokenKind::number || last == TokenKind::name || last == TokenKind::close;
  }

  void add(TokenKind kind, std::size_t length, bool blank) {
    tokens_.push_back({kind, {at_, at_ + length}, 0, 0, {}, blank});
    at_ += length;
  }

  void read(bool blank) {
    const char c = peek();
    if (names_file()) return read_text(blank);
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return read_number(blank);
    if (is_letter(c)) return read_name(blank);
    if (c == '\n' || (c == separator_ && (c == ';' || depth_ == 0))) {
      depth_ = 0;
      return add(TokenKind::end_of_statement, 1, blank);
    }
    switch (c) {
      case '+': return add(TokenKind::plus, 1, blank);
      case '-': return add(TokenKind::minus, 1, blank);
      case '*':
        if (peek(1) == '*') throw source_.mistake({at_, at_ + 2}, "write a power with ^");
        return add(TokenKind::times, 1, blank);
      case '/': return add(TokenKind::over, 1, blank);
      case '^': return add(TokenKind::power, 1, blank);
      case '(': ++depth_; return add(TokenKind::open, 1, blank);
      case ')': depth_ -= depth_ > 0 ? 1 : 0; return add(TokenKind::close, 1, blank);
      case ',': return add(TokenKind::comma, 1, blank);
      case '=': return add(TokenKind::equals, 1, blank);
      case '>': return peek(1) == '=' ? add(TokenKind::at_least, 2, blank) : add(TokenKind::above, 1, blank);
      case '<': return peek(1) == '=' ? add(TokenKind::at_most, 2, blank) : add(TokenKind::below, 1, blank);
      default: throw unexpected();
    }
  }

  [[nodiscard]] bool names_file() const {
    return tokens_.size() > 1 && tokens_.back().kind == TokenKind::open &&
           source_.at(tokens_[tokens_.size() - 2].place) == "table";
  }
  void read_text(bool blank) {
    if (peek() != '"')
      throw source_.mistake({at_, at_ + 1},
                            "the name of a file must be in quotation marks: table(\"load.csv\")");
    const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
    if (end == std::string_view::npos || text_[end] != '"')
      throw source_.mistake({at_, at_ + 1}, "the name of a file must end with a quotation mark");
    add(TokenKind::text, end + 1 - at_, blank);
  }

  [[nodiscard]] InputError unexpected() const {
    std::size_t length = 1;
    while (at_ + length < text_.size() && (static_cast<unsigned char>(text_[at_ + length]) & 0xC0U) == 0x80U)
      ++length;
    const Place place{at_, at_ + length};
    if (peek() == '\'') return source_.mistake(place, "a prime must directly follow the name of an unknown");
    if (peek() == '"') return source_.mistake(place, "a second derivative is written with two primes, x''");
    if (peek() == '[' || peek() == '{') return source_.mistake(place, "only round brackets are allowed");
    for (const auto& [sign, advice] : printed) {
      if (source_.at(place) == sign) return source_.mistake(place, advice);
    }
    return source_.mistake(place, fmt::format("{} has no meaning here", quoted_input(source_.at(place))));
  }

  void read_number(bool blank) {
    double value = 0;
    const char* const first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    const auto length = static_cast<std::size_t>(end - first);
    const Place place{at_, at_ + length};
    if (error == std::errc::result_out_of_range || !std::isfinite(value))
      throw source_.mistake(place, "this number is beyond the range of double precision");
    if (peek(length) == '.') throw source_.mistake(place, "a number must have at most one decimal point");
    add(TokenKind::number, length, blank);
    tokens_.back().number = value;
  }

  void read_name(bool blank) {
    std::size_t letters = 0;
    while (is_letter(peek(letters)) || is_digit(peek(letters))) ++letters;
    if (letters > longest_name)  // messages contain names unabridged
      throw source_.mistake({at_, at_ + letters},
                            fmt::format("a name must have at most {} characters", longest_name));
    std::size_t primes = 0;
    while (peek(letters + primes) == '\'') ++primes;
    const std::size_t begin = at_;
    add(TokenKind::name, letters + primes, blank);
    tokens_.back().name = {begin, begin + letters};
    tokens_.back().primes = static_cast<int>(std::min<std::size_t>(primes, 1000));
  }

  static constexpr std::size_t longest_name = 60;
  const SourceText& source_;
  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(const SourceText& source, Separator separator) {
  return Reader(source, separator).all();
}

}  // namespace nlmech::program
