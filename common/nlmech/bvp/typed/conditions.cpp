#include "nlmech/bvp/typed/conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>
#include <utility>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/functions.hpp"
#include "nlmech/program/tokens.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using program::Place;
using program::SourceText;
using program::Token;
using program::TokenKind;

/// x'(0.3) or integral(x^2) in a text.
struct Reference {
  Place place;       ///< of the whole
  Place name;        ///< of the name without primes
  int primes;        ///< of the name
  Place inner;       ///< of the text in the brackets
  bool is_integral;  ///< an integral, else a value
};

/// The tokens of one statement, without its end.
using Statement = std::vector<Token>;

std::vector<Statement> statements_of(const SourceText& source) {
  std::vector<Statement> all(1);
  for (const Token& token : program::tokens_of(source, program::Separator::semicolon)) {
    if (token.kind == TokenKind::end_of_statement || token.kind == TokenKind::end_of_text)
      all.emplace_back();
    else
      all.back().push_back(token);
  }
  std::erase_if(all, [](const Statement& s) { return s.empty(); });
  return all;
}

/// Index of the bracket that closes the one at @p open; the number of tokens if there is none.
std::size_t closing(const Statement& tokens, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    depth += (tokens[i].kind == TokenKind::open) - (tokens[i].kind == TokenKind::close);
    if (depth == 0) return i;
  }
  return tokens.size();
}

/// The references of a statement; calls rest(i) for each token outside of them.
template <class Rest>
std::vector<Reference> references_of(const SourceText& source, const Statement& tokens, const Rest& rest) {
  std::vector<Reference> all;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const bool is_called = token.kind == TokenKind::name && i + 1 < tokens.size() &&
                           tokens[i + 1].kind == TokenKind::open &&
                           !program::function_by_name(source.at(token.name));
    const bool is_integral = is_called && token.primes == 0 && source.at(token.name) == "integral";
    const std::size_t close = is_called ? closing(tokens, i + 1) : tokens.size();
    if ((!is_integral && is_called && tokens[i + 1].after_blank) || close == tokens.size()) {
      rest(i);
      continue;
    }
    all.push_back({{token.place.begin, tokens[close].place.end},
                   token.name,
                   token.primes,
                   {tokens[i + 1].place.end, tokens[close].place.begin},
                   is_integral});
    i = close;
  }
  return all;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

bool is_condition(const SourceText& source, const Statement& tokens, const std::set<std::string>& unknowns) {
  bool has_derivative = false, is_equation = false;
  const std::vector<Reference> references = references_of(source, tokens, [&](std::size_t i) {
    has_derivative |= tokens[i].kind == TokenKind::name && tokens[i].primes > 0;
    is_equation |= tokens[i].kind == TokenKind::equals;
  });
  const bool defines = tokens.size() > 1 && tokens[0].kind == TokenKind::name &&
                       tokens[1].kind == TokenKind::equals &&
                       !unknowns.contains(std::string(source.at(tokens[0].name)));
  return !references.empty() && is_equation && !has_derivative && !defines;
}

bool defines(const SourceText& source, const Statement& tokens, const std::string& name) {
  return tokens.size() > 1 && tokens[0].kind == TokenKind::name && tokens[0].primes == 0 &&
         tokens[1].kind == TokenKind::equals && source.at(tokens[0].name) == name;
}

/// An unknown constant cannot be defined too.
void check_definition(const SourceText& source, const Statement& tokens,
                      const std::vector<std::string>& constants) {
  const auto is_defined = [&](const std::string& name) { return defines(source, tokens, name); };
  if (std::ranges::any_of(constants, is_defined))
    throw source.mistake(tokens[0].place, "defined here, and given by --unknown; remove one of both");
}

bool is_name(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }) &&
         std::isalpha(static_cast<unsigned char>(text[0])) != 0;
}

/// A name for something new is neither that of a function nor that of the time.
void check_is_free(const std::string& option, const std::string& name) {
  if (program::function_by_name(name))
    throw input_error("{} {}: is the name of a function; choose another", option, name);
  if (name == "t") throw input_error("{} t: is the time; choose another name", option);
}

}  // namespace

std::vector<std::string> names_in(const std::string& option, const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + ",") {
    if (c != ',' && c != ' ' && c != ';') {
      name += c;
    } else if (!name.empty()) {
      if (!is_name(name)) throw input_error("{} {}: is no name, such as k", option, quoted_input(name));
      check_is_free(option, name);
      names.push_back(std::exchange(name, {}));
    }
  }
  return names;
}

std::string free_end_name(const std::string& equations, const program::Settings& settings,
                          const std::string& until) {
  if (until.empty() || !is_name(until) || settings.contains(until)) return {};
  if (until == "inf" || until == "pi") return {};
  check_is_free("--until", until);
  const SourceText source("--equation", equations);
  const std::vector<Statement> all = statements_of(source);
  const bool is_known = std::ranges::any_of(all, [&](const Statement& tokens) {
    return defines(source, tokens, until) || std::ranges::any_of(tokens, [&](const Token& token) {
             return token.kind == TokenKind::name && token.primes > 0 && source.at(token.name) == until;
           });
  });
  return is_known ? std::string() : until;
}

std::vector<ConditionText> conditions_of(const std::string& name, const std::string& text) {
  std::string separated = text;
  int depth = 0;
  for (char& c : separated) {
    depth += (c == '(') - (c == ')');
    if (c == ',' && depth == 0) c = ';';
  }
  const SourceText source(name, separated);
  std::vector<ConditionText> all;
  for (const Statement& s : statements_of(source)) {
    const Place place{s.front().place.begin, s.back().place.end};
    if (std::ranges::none_of(s, [](const Token& t) { return t.kind == TokenKind::equals; }))
      throw input_error("{} {}: is no condition; give an equation, such as x(0) = 0", name,
                        quoted_input(source.at(place)));
    all.push_back({name, std::string(source.at(place))});
  }
  return all;
}

bool mentions(const std::string& text, const std::string& name) {
  const SourceText source(name, text);
  for (const Statement& statement : statements_of(source)) {
    const auto is_name = [&](const Token& t) {
      return t.kind == TokenKind::name && source.at(t.name) == name;
    };
    if (std::ranges::any_of(statement, is_name)) return true;
  }
  return false;
}

DividedText divide(const std::string& name, const std::string& text,
                   const std::vector<std::string>& constants, const std::string& parameter) {
  const SourceText source(name, text);
  const std::vector<Statement> all = statements_of(source);
  std::set<std::string> unknowns(constants.begin(), constants.end());
  for (const Statement& statement : all) {
    for (const Token& token : statement) {
      if (token.kind == TokenKind::name && token.primes > 0) unknowns.emplace(source.at(token.name));
    }
  }
  DividedText result{std::string(source.text()), {}};
  for (const Statement& statement : all) {
    const Place place{statement.front().place.begin, statement.back().place.end};
    if (is_condition(source, statement, unknowns)) {
      result.conditions.push_back({name, std::string(source.at(place))});
    } else if (!defines(source, statement, parameter)) {
      check_definition(source, statement, constants);
      continue;
    }
    for (std::size_t i = place.begin; i < place.end; ++i) {
      if (result.equations[i] != '\n') result.equations[i] = ' ';
    }
  }
  return result;
}

program::Equations equations_of(const std::string& name, const std::string& text, const DividedText& divided,
                                const program::Settings& settings) {
  try {
    return program::Equations(SourceText(name, divided.equations), settings);
  } catch (const InputError& error) {
    // The second line of a message quotes a part of the text.
    std::string message = error.what();
    const std::size_t first = message.find("\n  "), last = message.find('\n', first + 1);
    if (first == std::string::npos || last == std::string::npos) throw;
    const std::string quoted = message.substr(first + 3, last - first - 3);
    const std::size_t at = divided.equations.find(quoted);
    const SourceText before(name, text);
    if (at == std::string::npos || at + quoted.size() > before.text().size()) throw;
    throw InputError(message.replace(first + 3, quoted.size(), before.text().substr(at, quoted.size())));
  }
}

void differentiate(const program::Program& program, double t, const Eigen::VectorXd& x, bool with_time,
                   const std::function<void(int output, int component, double value)>& put) {
  constexpr int lanes = 4;
  using D = Dual<double, lanes>;
  const int n = static_cast<int>(x.size()), variables = n + (with_time ? 1 : 0);
  Vector<D, Eigen::Dynamic> at(n);
  for (int first = 0; first < variables; first += lanes) {
    const auto seeded = [first](double value, int i) {
      const int lane = i - first;
      return lane >= 0 && lane < lanes ? D::variable(value, lane) : D(value);
    };
    for (int i = 0; i < n; ++i) at[i] = seeded(x[i], i);
    program.run(with_time ? seeded(t, n) : D(t), at, 0, program.outputs(), [&](int output, const D& value) {
      for (int lane = 0; lane < std::min(lanes, variables - first); ++lane)
        put(output, first + lane, value.partial[static_cast<std::size_t>(lane)]);
    });
  }
}

/// Reads conditions. Each reference becomes a variable with a name of the same length, so that messages point
/// at the right place; the residuals are read as expressions of these variables.
class Conditions::Reader {
 public:
  Reader(Conditions& made, program::Equations& equations, std::string end_name)
      : made_(made), equations_(equations), end_name_(std::move(end_name)) {
    for (std::size_t i = 0; i < equations.state_names().size(); ++i) {
      // x' of x'' = 0 stays a state.
      const bool is_constant = equations.graph().is_number(equations.slopes()[i], 0) &&
                               !equations.state_names()[i].ends_with('\'');
      if (!is_constant) continue;
      made.constants_.push_back(static_cast<int>(i));
      constants_.insert(equations.state_names()[i]);
    }
    for (const auto& [name, value] : equations.parameters()) taken_.insert(name);
    taken_.insert(constants_.begin(), constants_.end());
  }

  void read(const ConditionText& condition) {
    const SourceText source(condition.name, condition.text);
    std::string text(source.text());
    std::size_t known = 0;
    for (const Statement& tokens : statements_of(source)) {
      const std::vector<Reference> references = references_of(source, tokens, [&](std::size_t i) {
        if (tokens[i].kind == TokenKind::name) known += check_name(source, tokens[i]);
      });
      for (const Reference& reference : references) {
        constexpr std::size_t longest = 40;  // names have a limit; integrals may be long
        const std::size_t length = reference.place.end - reference.place.begin;
        const std::string name = new_name(std::min(length, longest));
        if (reference.is_integral)
          add_integral(source, condition.name, reference, name);
        else
          add_value(source, condition.name, reference, name);
        text.replace(reference.place.begin, length, name + std::string(length - name.size(), ' '));
      }
      known += references.size();
    }
    if (known == 0)
      throw input_error("{} {}: contains no value of the solution, such as x(0), and no unknown constant",
                        condition.name, quoted_input(condition.text));
    texts_.push_back({condition, std::move(text)});
  }

  void finish() {
    std::string definitions;
    std::vector<std::string> constants;
    for (const int i : made_.constants_)
      constants.push_back(equations_.state_names()[static_cast<std::size_t>(i)]);
    for (const auto* names : {&value_names_, &integral_names_, &constants}) {
      for (const std::string& name : *names) definitions += fmt::format("{}' = 0; ", name);
    }
    if (definitions.empty()) return;
    for (const auto& [name, value] : equations_.parameters())
      definitions += fmt::format("{} = {:.17g}; ", name, value);
    program::Equations arguments(SourceText("conditions", definitions));
    std::vector<program::NodeId> nodes;
    for (const auto& [condition, text] : texts_) {
      try {
        nodes.push_back(arguments.expression(condition.name, text));
      } catch (const InputError& error) {
        throw InputError(replaced(error.what(), text, condition.text));
      }
    }
    made_.residuals_ = program::Program(arguments.graph(), nodes);
    made_.residual_graph_ = arguments.graph();
    made_.residual_nodes_ = std::move(nodes);
  }

 private:
  static std::string replaced(std::string message, const std::string& from, const std::string& to) {
    if (const std::size_t at = message.find(from); at != std::string::npos)
      message.replace(at, from.size(), to);
    return message;
  }

  /// Checks a name outside of references. @return whether it is an unknown constant
  bool check_name(const SourceText& source, const Token& token) const {
    const std::string name(source.at(token.name));
    if (constants_.contains(name) && token.primes == 0) return true;
    const bool is_unknown =
        std::ranges::any_of(equations_.unknowns(), [&](const auto& u) { return u.name == name; });
    if (is_unknown || token.primes > 0)
      throw source.mistake(token.place,
                           fmt::format("a value needs its time, as in {}(0)", source.at(token.place)));
    if (name == "t")
      throw source.mistake(token.place, "a condition holds at points of time: it cannot contain t");
    return false;
  }

  std::string new_name(std::size_t length) {
    std::string name;
    do {
      name = fmt::format("v{:0{}}", counter_++, length - 1);
    } while (taken_.contains(name));
    return name;
  }

  void add_integral(const SourceText& source, const std::string& option, const Reference& reference,
                    const std::string& name) {
    const std::string inner(source.at(reference.inner));
    const SourceText integrand(option, inner);
    for (const Statement& tokens : statements_of(integrand)) {
      for (const Reference& value : references_of(integrand, tokens, [](std::size_t) {})) {
        const std::string time = trimmed(integrand.at(value.inner));
        if (time.find_first_not_of("0123456789.+-*/ ") == std::string::npos)
          throw integrand.mistake(value.place, "a value cannot be in an integral; for a product write *");
      }
    }
    made_.integrands_.push_back(equations_.expression(option, inner));
    integral_names_.push_back(name);
  }

  void add_value(const SourceText& source, const std::string& option, const Reference& reference,
                 const std::string& name) {
    const std::string time = trimmed(source.at(reference.inner));
    if (time == "inf" && end_name_ != "inf")
      throw source.mistake(reference.inner, "a value at infinity needs --until inf");
    const double at = !end_name_.empty() && time == end_name_ ? std::numeric_limits<double>::infinity()
                                                              : equations_.number(option, time);
    made_.values_.push_back({expression_of(source, option, reference), at});
    value_names_.push_back(name);
  }

  program::NodeId expression_of(const SourceText& source, const std::string& option,
                                const Reference& reference) {
    const std::string name(source.at(reference.name));
    const auto& all = equations_.unknowns();
    const auto unknown = std::ranges::find_if(all, [&](const auto& u) { return u.name == name; });
    if (unknown != all.end() && reference.primes == unknown->order) {
      // The highest derivative is the slope of the one before.
      const auto& names = equations_.state_names();
      const auto place = std::ranges::find(names, program::with_primes(name, unknown->order - 1));
      return equations_.slopes()[static_cast<std::size_t>(place - names.begin())];
    }
    return equations_.expression(option, program::with_primes(name, reference.primes));
  }

  Conditions& made_;
  program::Equations& equations_;
  std::string end_name_;
  std::set<std::string> constants_, taken_;
  std::vector<std::string> value_names_, integral_names_;
  std::vector<std::pair<ConditionText, std::string>> texts_;  // with variables for references
  int counter_ = 0;
};

Conditions::Conditions(program::Equations& equations, const std::vector<ConditionText>& texts,
                       const std::string& end_name) {
  Reader reader(*this, equations, end_name);
  for (const ConditionText& text : texts) reader.read(text);
  reader.finish();
}

}  // namespace nlmech::bvp
