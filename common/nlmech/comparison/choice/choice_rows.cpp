#include "nlmech/comparison/choice/choice_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "nlmech/comparison/rows.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// "not stiff (0.8 an accurate step)": how far the fastest motion goes within a step as the solution asks
/// for.
std::string stiffness(const Features& f) {
  const double turned = std::pow(10, f.stiffness);
  const char* word = "not stiff";
  if (f.stiffness > 1) word = f.decay > 0.5 ? "mildly stiff" : "fast vibrations";
  if (f.stiffness > 1.7) word = f.decay > 0.5 ? "stiff" : "very fast vibrations";
  return fmt::format("{} (the fastest motion goes {:.2g} of its units of time in an accurate step)", word,
                     turned);
}

std::string smoothness(const Features& f) {
  if (f.switches) return "switches";
  return f.operations > 0 ? "smooth" : "smooth but not recorded as series";
}

std::string accuracy(const Chosen& c) {
  if (!(c.condition_seen > 0)) return fmt::format("{:.3g} digits", c.digits);
  return fmt::format("{:.3g} digits where errors grow {}{:.2g} times", c.digits,
                     c.condition_is_bound ? "more than " : "", c.condition);
}

std::string form(const Features& f) {
  switch (f.form) {
    case Form::conservative: return "accelerations without velocities";
    case Form::accelerations: return "accelerations";
    case Form::first_order: break;
  }
  return "first order";
}

std::string runs(const Ranked& r, const Chosen& c) {
  const double percent = 100 * r.seen;
  std::string text = percent > 99.9 ? "ran the whole way"
                                    : fmt::format("ran {:.{}g} % of the way", percent, percent < 10 ? 1 : 2);
  if (r.short_of > 0.05)
    text += fmt::format("; its tightest tolerance lacks {}{:.1g} digits",
                        c.condition_is_bound ? "more than " : "", r.short_of);
  return text;
}

}  // namespace

std::string choice_rows(const Chosen& c) {
  if (!c.status.ok()) throw Failure(c.status);
  if (c.ranked.empty())
    throw Failure(failed_with(Outcome::outside_validity, "no method of this build is for the problem"));
  const Features& f = c.look.features;
  const Ranked& first = c.ranked.front();
  const double second_a_unit = first.seconds / (first.cost * first.seen);
  std::string text = "rank,method,tolerance,seconds,reason\n";
  for (std::size_t i = 0; i < c.ranked.size(); ++i) {
    const Ranked& r = c.ranked[i];
    std::string reason;
    if (i == 0)
      reason = fmt::format("{}; {}; {}; {}; a right-hand side takes {:.2g} s; like {}; {}", accuracy(c),
                           stiffness(f), smoothness(f), form(f), c.right_hand_side, fmt::join(c.alike, ", "),
                           runs(r, c));
    else
      reason = fmt::format("{:.2g} times as long as {}; on problems alike {:.2g} times the fastest; {}",
                           r.cost / first.cost, first.method, r.behind, runs(r, c));
    text += fmt::format("{},{},{:.1e},{:.3g},{}\n", i + 1, r.method, r.tolerance, r.cost * second_a_unit,
                        quoted_cell(reason));
  }
  return text;
}

std::string choice_remark(const Chosen& c) {
  if (c.digits <= c.possible) return "";
  return fmt::format(
      "the problem multiplies errors by {}{:.2g}, so that rounding alone leaves {} {:.2g} of the {:.3g} "
      "digits",
      c.condition_is_bound ? "more than " : "", c.condition, c.condition_is_bound ? "less than" : "about",
      std::max(0.0, c.possible), c.digits);
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
