#include "nlmech/comparison/choice/choice_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// "9 digits where errors grow 4.8 times"
std::string accuracy(const Chosen& c) {
  if (!(c.growth.covered > 0)) return fmt::format("{:.3g} digits", c.digits);
  return fmt::format("{:.3g} digits where errors grow {:.2g} times", c.digits, c.condition);
}

/// "not stiff (...); smooth, operations: 5": what the rules ask.
std::string features(const Features& f) {
  const std::string operations =
      f.operations > 0 ? fmt::format("operations: {}", f.operations) : "not recorded as series";
  return fmt::format("{} (the fastest motion goes {:.2g} of its units of time in an accurate step); {}, {}",
                     f.stiffness > stiff_from ? "stiff" : "not stiff", f.stiffness,
                     f.switches ? "switches" : "smooth", operations);
}

/// "280 right-hand sides; ran 12 % of the time"
std::string run(const Ranked& r, const Chosen& c) {
  const double percent = 100 * r.covered;
  std::string text = fmt::format("about {:.2g} right-hand sides; ran ", r.right_hand_sides);
  text += percent > 99.9 ? "to the end" : fmt::format("{:.{}g} % of the time", percent, percent < 10 ? 1 : 2);
  if (c.missing > 0.05) text += fmt::format("; its tightest tolerance lacks {:.1g} digits", c.missing);
  return text;
}

}  // namespace

std::string choice_rows(const Chosen& c) {
  if (!c.status.ok()) throw Failure(c.status);
  if (c.ranked.empty())
    throw Failure(failed_with(Outcome::outside_validity, "no method of this build is for the problem"));
  const Rule& rule = choice_rule(c.features, c.digits);
  std::string why = fmt::format("{}; {}; {}: {}; a right-hand side takes {:.2g} s", accuracy(c),
                                features(c.features), rule.name, rule.reason, c.right_hand_side);
  if (c.ranked.front().method != rule.methods.front())
    why += fmt::format("; {} fails or is not in this build", rule.methods.front());
  std::string text = "rank,method,tolerance,seconds,reason\n";
  for (std::size_t i = 0; i < c.ranked.size(); ++i) {
    const Ranked& r = c.ranked[i];
    text += fmt::format("{},{},{:.1e},{:.3g},{}\n", i + 1, r.method, r.tolerance, r.seconds,
                        scene::quoted_field(fmt::format("{}; {}", why, run(r, c))));
    why = "next by the same rule";
  }
  return text;
}

std::string choice_remark(const Chosen& c) {
  if (c.digits <= c.possible) return "";
  return fmt::format(
      "the problem multiplies errors by {:.2g}, so that rounding alone leaves about {:.2g} of the {:.3g} "
      "digits",
      c.condition, std::max(0.0, c.possible), c.digits);
}

std::string shell_line(const std::vector<std::string>& words) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
    } else if (word.find_first_of("\"$`\\!") == std::string::npos) {
      line += '"' + word + '"';
    } else {
      line += '\'';
      for (const char c : word) line += c == '\'' ? "'\\''" : std::string(1, c);
      line += '\'';
    }
  }
  return line;
}

}  // namespace nlmech::comparison
