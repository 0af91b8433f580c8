#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/integrators/heat_map.hpp"
#include "chapters/integrators/sweep.hpp"
#include "nlmech/comparison/choice/choice.hpp"

namespace nlmech::chapters::integrators::summary {
namespace {

constexpr std::array asked = {3, 6, 9, 12};
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The fastest method of a group.
struct Fastest {
  std::string method = "none";
  double seconds = infinity;
};

template <class Of>
Fastest fastest(const ProblemTrials& p, double digits, Of of) {
  Fastest best;
  for (const MethodTrials& m : p.methods) {
    if (!of(m)) continue;
    const double seconds = m.seconds_for(digits).value_or(infinity);
    if (seconds < best.seconds) best = {m.method, seconds};
  }
  return best;
}

/// A row of the table: the fastest methods for a problem and a number of digits.
struct Row {
  std::string problem;
  int digits;
  const ProblemTrials* trials;
  Fastest own, peer;
  [[nodiscard]] std::string first() const { return own.seconds <= peer.seconds ? own.method : peer.method; }
  [[nodiscard]] std::optional<double> ratio() const {
    if (!std::isfinite(own.seconds) || !std::isfinite(peer.seconds)) return {};
    return peer.seconds / own.seconds;
  }
};

/// The first choices of the rules, each once.
std::vector<std::string> first_choices() {
  std::vector<std::string> names;
  for (const comparison::Rule& rule : comparison::choice_rules()) {
    const std::string name(rule.methods.front());
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::optional<double> milliseconds(double seconds) {
  if (!std::isfinite(seconds)) return {};
  return 1e3 * seconds;
}

std::vector<Row> rows_of(const std::vector<const ProblemTrials*>& problems) {
  std::vector<Row> rows;
  for (const ProblemTrials* p : problems) {
    for (const int digits : asked)
      rows.push_back({p->problem, digits, p,
                      fastest(*p, digits, [](const MethodTrials& m) { return !m.peer; }),
                      fastest(*p, digits, [](const MethodTrials& m) { return m.peer; })});
  }
  return rows;
}

/// Time of a method over that of the fastest; infinite if it does not achieve the digits.
double behind(const ProblemTrials& p, const MethodTrials& method, double digits) {
  const double best = fastest(p, digits, [](const MethodTrials&) { return true; }).seconds;
  return method.seconds_for(digits).value_or(infinity) / best;
}

/// Column of the table: time of the method over that of the fastest.
scene::ColumnOf<Row> column_behind(const std::string& method) {
  return {method + " over fastest", [method](const Row& r) -> std::optional<double> {
            const auto trials = std::ranges::find(r.trials->methods, method, &MethodTrials::method);
            const double factor = behind(*r.trials, *trials, r.digits);
            return std::isfinite(factor) ? std::optional(factor) : std::nullopt;
          }};
}

/// Methods that take at most three times as long as the fastest for some problem and digits.
std::vector<std::size_t> methods_of(const std::vector<const ProblemTrials*>& problems) {
  std::vector<std::size_t> all;
  for (std::size_t m = 0; m < problems.front()->methods.size(); ++m) {
    const bool counts = std::ranges::any_of(problems, [&](const ProblemTrials* p) {
      return std::ranges::any_of(asked, [&](int digits) { return behind(*p, p->methods[m], digits) <= 3; });
    });
    if (counts) all.push_back(m);
  }
  return all;
}

void put(const std::vector<ProblemTrials>& all, scene::Show& show) {
  const auto problems = with_solution(all);
  const auto shown = methods_of(problems);
  HeatMap map{"Which method is fastest on which problem",
              "behind",
              "●  fastest      blank: does not deliver",
              {},
              {},
              {},
              {}};
  for (const int digits : asked) map.captions.push_back(fmt::format("{} digits", digits));
  for (const ProblemTrials* p : problems) map.problems.push_back(p->problem);
  for (const std::size_t m : shown) map.methods.push_back(problems.front()->methods[m].method);
  map.cell = [&](std::size_t panel, std::size_t problem, std::size_t method) -> HeatCell {
    const double factor = behind(*problems[problem], problems[problem]->methods[shown[method]], asked[panel]);
    if (!std::isfinite(factor)) return {};
    return {std::min(2., std::log10(factor)), factor == 1 ? "●" : ""};
  };
  show_heat_map(map, show);

  const std::vector<Row> rows = rows_of(problems);
  scene::ColumnsOf<std::vector<Row>> columns = {
      {"problem", &Row::problem},
      {"digits", &Row::digits},
      {"fastest", &Row::first},
      {"fastest nlmech method", [](const Row& r) { return r.own.method; }},
      {"its time, ms", [](const Row& r) { return milliseconds(r.own.seconds); }},
      {"best peer", [](const Row& r) { return r.peer.method; }},
      {"its time, ms ", [](const Row& r) { return milliseconds(r.peer.seconds); }},
      {"peer / nlmech time", &Row::ratio}};
  for (const std::string& method : first_choices()) columns.push_back(column_behind(method));
  show.table(rows, columns);
  show.equals("problems with a solution", problems.size(), 22, "number of such problems in the list");
  double least = infinity;
  for (const ProblemTrials* p : problems) {
    if (p->kind == Kind::extreme) continue;  // their digits are limited by the bounded work
    double most = 0;
    for (const MethodTrials& m : p->methods) {
      for (const Trial& t : m.trials) most = std::max(most, t.success() ? t.digits() : 0);
    }
    least = std::min(least, most + std::log10(p->condition));
  }
  show.between("fewest digits of the best run on any problem, conditioning removed", least,
               show.quick() ? 6 : 11, 17,
               "the tightest tolerance, 1e-13 (1e-8), accumulated over a hundred steps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "summary",
           .title = "Which method is fastest on which problem, at 3, 6, 9 and 12 digits",
           .content = scene::Content(put, sweep())}};
}

}  // namespace nlmech::chapters::integrators::summary
