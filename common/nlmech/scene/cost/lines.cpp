#include "nlmech/scene/cost/lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace nlmech::scene {

std::optional<double> Attempt::digits() const {
  if (!error || !std::isfinite(*error)) return {};
  return -std::log10(std::max(*error, std::numeric_limits<double>::epsilon() / 2));
}

const Attempt* MethodLine::best() const {
  const Attempt* best = nullptr;
  for (const Attempt& a : attempts) {
    if (a.digits() && (best == nullptr || *a.error < *best->error)) best = &a;
  }
  return best;
}

double MethodLine::least_error() const {
  const Attempt* found = best();
  return found != nullptr ? *found->error : HUGE_VAL;
}

const MethodLine& ProblemLines::of(const std::string& method) const {
  const auto found = std::ranges::find(lines, method, &MethodLine::method);
  if (found == lines.end()) throw std::out_of_range("there is no line of " + method);
  return *found;
}

Front::Front(const MethodLine& line) {
  for (const Attempt& a : line.attempts) {
    const auto digits = a.digits();
    if (digits && a.time.median > 0 && std::isfinite(a.time.median))
      runs_.emplace_back(*digits, a.time.median);
  }
  // In the order of decreasing digits a run stays if it is cheaper than all runs with more digits.
  std::ranges::sort(runs_, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::vector<std::pair<double, double>> cheapest;
  for (const auto& run : runs_) {
    if (cheapest.empty() || run.second < cheapest.back().second) cheapest.push_back(run);
  }
  runs_.assign(cheapest.rbegin(), cheapest.rend());
}

std::optional<double> Front::time(double digits) const {
  constexpr double rounding =
      1e-9;  // an error of 1e-9 counts as nine digits although its logarithm is rounded
  const auto above =
      std::ranges::find_if(runs_, [&](const auto& run) { return run.first >= digits - rounding; });
  if (above == runs_.end()) return {};
  if (above == runs_.begin() || above->first <= digits) return above->second;
  const auto& [low, low_time] = *std::prev(above);
  const auto& [high, high_time] = *above;
  return low_time * std::pow(high_time / low_time, std::min((digits - low) / (high - low), 1.0));
}

namespace {

using Lines = std::vector<std::size_t>;

std::vector<Front> fronts_of(const ProblemLines& problem) {
  std::vector<Front> fronts;
  for (const MethodLine& line : problem.lines) fronts.emplace_back(line);
  return fronts;
}

/// The fastest line among the allowed ones.
template <class Allowed>
std::optional<std::pair<std::size_t, double>> fastest(const std::vector<Front>& fronts, double digits,
                                                      const Allowed& allowed) {
  std::optional<std::pair<std::size_t, double>> found;
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    if (!allowed(i)) continue;
    const auto time = fronts[i].time(digits);
    if (time && (!found || *time < found->second)) found = {i, *time};
  }
  return found;
}

/// Comparison of lines over all problems.
class LineComparison {
 public:
  LineComparison(const std::vector<ProblemLines>& problems, double least)
      : problems_(problems), least_(least) {
    for (const ProblemLines& p : problems) fronts_.push_back(fronts_of(p));
  }

  /// Number of problems and whole numbers of digits at which each of these lines is the fastest of them.
  [[nodiscard]] std::map<std::size_t, int> wins(const Lines& of) const {
    std::map<std::size_t, int> wins;
    for (const auto& fronts : fronts_) {
      for (int digits = static_cast<int>(std::floor(least_)) + 1; digits <= 16; ++digits) {
        const auto first =
            fastest(fronts, digits, [&](std::size_t i) { return std::ranges::count(of, i) > 0; });
        if (first) ++wins[first->first];
      }
    }
    return wins;
  }

  /// The best of these lines, see foreground(); nothing if none has a point.
  [[nodiscard]] std::optional<std::size_t> best(const Lines& of) const {
    const auto counts = wins(of);
    std::optional<std::size_t> best;
    const auto merit = [&](std::size_t i) {
      return std::pair(counts.contains(i) ? counts.at(i) : 0, -least_error(i));
    };
    for (const std::size_t i : of) {
      if (drawn(i) && (!best || merit(i) > merit(*best))) best = i;
    }
    return best;
  }

  /// Does the line have a point?
  [[nodiscard]] bool drawn(std::size_t line) const {
    return std::ranges::any_of(problems_, [&](const auto& p) { return p.lines[line].best() != nullptr; });
  }

 private:
  [[nodiscard]] double least_error(std::size_t line) const {
    double least = problems_.front().lines[line].least_error();
    for (const ProblemLines& p : problems_) least = std::min(least, p.lines[line].least_error());
    return least;
  }

  const std::vector<ProblemLines>& problems_;
  double least_;
  std::vector<std::vector<Front>> fronts_;
};

/// "3", "3 and 6", "3, 6 and 9"
std::string listed(const std::vector<double>& digits) {
  const auto first = digits.begin(), last = digits.end() - 1;
  if (first == last) return fmt::format("{:g}", *last);
  return fmt::format("{:g} and {:g}", fmt::join(first, last, ", "), *last);
}

Lines lines_where(const std::vector<MethodLine>& lines,
                  const std::function<bool(const MethodLine&)>& wanted) {
  Lines found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (wanted(lines[i])) found.push_back(i);
  }
  return found;
}

/// The lines of foreground() in their order, without a limit of their number.
Lines ranked(const std::vector<MethodGroup>& groups, const std::vector<ProblemLines>& problems,
             double least) {
  const std::vector<MethodLine>& lines = problems.front().lines;
  const LineComparison lines_compared(problems, least);
  Lines chosen;
  const auto choose = [&](std::optional<std::size_t> line) {
    if (line && std::ranges::count(chosen, *line) == 0) chosen.push_back(*line);
  };
  for (const Side side : {Side::subject, Side::floor, Side::peer}) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      choose(lines_compared.best(
          lines_where(lines, [&](const auto& l) { return l.side == side && l.group == g; })));
  }
  for (const ProblemLines& p : problems) {
    for (const Ranking& ranking : rankings_of(p)) choose(ranking.first);
  }
  const auto wins = lines_compared.wins(
      lines_where(lines, [](const auto& l) { return l.side == Side::library || l.side == Side::subject; }));
  std::vector<std::pair<int, std::size_t>> ranked_counts;
  for (const auto& [line, count] : wins) ranked_counts.emplace_back(-count, line);
  std::ranges::sort(ranked_counts);
  for (const auto& [count, line] : ranked_counts) choose(line);
  const Lines all = lines_where(lines, [&](const auto& l) {
    return lines_compared.drawn(static_cast<std::size_t>(&l - lines.data()));
  });
  if (all.size() > method_styles.size()) return chosen;
  for (const std::size_t line : all) choose(line);  // the colours suffice for all lines
  return chosen;
}

}  // namespace

std::string Ranking::margin(const ProblemLines& problem) const {
  if (!first) return "no method";
  if (!next) return "alone";
  const std::string& other = problem.lines[*next].method;
  if (factor <= 1.05) return "as fast as " + other;
  return fmt::format("{:.{}f} times as fast as {}", factor, factor < 9.95 ? 1 : 0, other);
}

std::vector<Ranking> rankings_of(const ProblemLines& problem) {
  const std::vector<Front> fronts = fronts_of(problem);
  const auto is_ranked = [&](std::size_t i) { return problem.lines[i].side != Side::floor; };
  std::vector<Ranking> rankings;
  for (const double digits : asked_digits) {
    Ranking& ranking = rankings.emplace_back(Ranking{digits, {}, {}});
    const auto first = fastest(fronts, digits, is_ranked);
    if (!first) continue;
    ranking.first = first->first;
    ranking.time = first->second;
    const std::string family = problem.lines[first->first].family();
    const auto next = fastest(
        fronts, digits, [&](std::size_t i) { return is_ranked(i) && problem.lines[i].family() != family; });
    if (!next) continue;
    ranking.next = next->first;
    ranking.factor = next->second / ranking.time;
  }
  return rankings;
}

std::string fastest_by_digits(const ProblemLines& problem) {
  std::vector<std::pair<std::string, std::vector<double>>> fastest_methods;
  for (const Ranking& ranking : rankings_of(problem)) {
    if (!ranking.first) continue;
    const std::string& name = problem.lines[*ranking.first].method;
    const auto known =
        std::ranges::find(fastest_methods, name, &decltype(fastest_methods)::value_type::first);
    (known == fastest_methods.end() ? fastest_methods.emplace_back(name, std::vector<double>{}) : *known)
        .second.push_back(ranking.digits);
  }
  if (fastest_methods.empty()) return "no method has three digits";
  std::string text;
  for (const auto& [name, digits] : fastest_methods)
    text +=
        fmt::format(fmt::runtime(text.empty() ? "{} is fastest at {}" : ", {} at {}"), name, listed(digits));
  return text + " digits";
}

std::vector<InColour> foreground(const std::vector<MethodGroup>& groups,
                                 const std::vector<ProblemLines>& problems, double least) {
  if (problems.empty()) return {};
  std::vector<InColour> chosen;
  std::vector<bool> taken(method_styles.size());
  Lines waiting;
  const auto give = [&](std::size_t line, std::size_t colour) {
    taken[colour] = true;
    chosen.push_back({line, colour});
  };
  // Groups get their colours first, so that other lines cannot take them.
  Lines best = ranked(groups, problems, least);
  best.resize(std::min(best.size(), method_styles.size()));
  for (const std::size_t line : best) {
    const std::size_t wanted = groups.at(problems.front().lines[line].group).colour;
    if (taken.at(wanted))
      waiting.push_back(line);
    else
      give(line, wanted);
  }
  for (const std::size_t line : waiting)
    give(line, static_cast<std::size_t>(std::ranges::find(taken, false) - taken.begin()));
  return chosen;
}

}  // namespace nlmech::scene
