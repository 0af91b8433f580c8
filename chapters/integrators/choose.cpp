#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/integrators/problem_set.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/choice/expectation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::choose {
namespace {

using comparison::Evidence;
using comparison::SolvedProblem;

constexpr std::array asked = {3, 6, 9, 12};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double close = 2;  // times the fastest, for a good choice

/// What a method costs; infinite if it does not deliver.
double cost_of(const SolvedProblem& p, const std::string& method, double digits) {
  const auto m = p.measured(method, digits);
  if (!m) return infinity;
  return m->cost;
}

/// A choice, judged by what was measured.
struct Judged {
  std::string problem;
  int digits;
  std::string chosen, fastest;
  double behind;     ///< factor of the chosen one
  double alike;      ///< factor of the one that problems alike speak for, before any runs
  double series;     ///< factor of series, for everything
  double condition;  ///< as the command finds it
  double delivered;  ///< digits at the end, with the tolerance that is named
};

/// Digits at the end of a run as the command names it.
double delivered(const SetProblem& p, const comparison::Ranked& first) {
  const ivp::Settings settings{.tolerance = first.tolerance,
                               .absolute_tolerance = first.tolerance * p.absolute};
  const auto run = comparison::any_integrator(comparison::any_method(first.method), settings);
  const ivp::Solution end = run(p.system, p.x0, p.t0, p.t1, {}, {});
  if (!end.status.ok()) return 0;
  return std::clamp(-std::log10(p.error(end.x, p.times.size() - 1)), 0.0, 16.0);
}

/// What the command says of a problem when nobody has solved it.
void judge(const SetProblem& p, const Evidence& all, std::vector<Judged>& judged) {
  const auto solved = std::ranges::find(all.problems, p.name, &SolvedProblem::name);
  if (solved == all.problems.end()) return;
  const Evidence others = all.without(p.name);
  const comparison::Question question{p.system, p.x0, p.t0, p.t1, 9, p.absolute};
  const comparison::Chosen looked = comparison::looked_at(question, others);
  for (const int digits : asked) {
    double best = infinity;
    std::string fastest;
    for (const auto& [method, runs] : solved->runs) {
      const double cost = cost_of(*solved, method, digits);
      if (cost < best) fastest = method;
      best = std::min(best, cost);
    }
    if (fastest.empty()) continue;
    const comparison::Chosen c = comparison::choose(question, digits, others, looked);
    const std::string first = c.ranked.empty() ? "none" : c.ranked.front().method;
    const auto expected = comparison::expectations(others, c.look.features, digits + std::log10(c.condition));
    judged.push_back({p.name, digits, first, fastest, cost_of(*solved, first, digits) / best,
                      cost_of(*solved, expected.front().method, digits) / best,
                      cost_of(*solved, "series", digits) / best, c.condition,
                      c.ranked.empty() ? 0 : delivered(p, c.ranked.front())});
  }
}

std::vector<Judged> measure(bool /*quick*/) {
  const Evidence all = comparison::read_evidence();
  std::vector<Judged> judged;
  for (const SetProblem& p : problem_set()) judge(p, all, judged);
  return judged;
}

double share_within(const std::vector<Judged>& all, double Judged::*factor, double bound) {
  const auto good = std::ranges::count_if(all, [&](const Judged& j) { return j.*factor <= bound; });
  return static_cast<double>(good) / static_cast<double>(all.size());
}

void put(const std::vector<Judged>& all, scene::Show& show) {
  scene::Panel& panel =
      show.plot(fmt::format("Within twice the fastest: the first choice in {:.0f} % of cases",
                            100 * share_within(all, &Judged::behind, 2 * (1 + 1e-9))),
                "factor behind the fastest", "share of problems and digits, %");
  panel.log_x(1, 20).y_range(0, 100).key("bottom right");
  for (const auto& [name, factor] : {std::pair("chosen", &Judged::behind),
                                     std::pair("by problems alike, without runs on this one", &Judged::alike),
                                     std::pair("always series", &Judged::series)}) {
    std::vector<double> x, y;
    for (int k = 0; k <= 130; ++k) {
      x.push_back(std::pow(10, 0.01 * k));
      y.push_back(100 * share_within(all, factor, x.back() * (1 + 1e-9)));
    }
    panel.curve(name, x, y);
  }
  show.table(all, {{"problem", &Judged::problem},
                   {"digits", &Judged::digits},
                   {"chosen", &Judged::chosen},
                   {"fastest", &Judged::fastest},
                   {"chosen over fastest", &Judged::behind},
                   {"by problems alike", &Judged::alike},
                   {"condition", &Judged::condition, 2},
                   {"digits delivered", &Judged::delivered, 3}});
  show.between("problems and digits", static_cast<double>(all.size()), 78, 88,
               "22 problems at four digits; twelve are not delivered on each, and rounding decides on which");
  const auto few = [](const Judged& j) { return j.digits < 12; };
  const auto meets = [](const Judged& j) { return j.digits < 12 && j.delivered > j.digits - 0.5; };
  show.between("share of 3, 6 and 9 digits that are delivered, up to half a digit, %",
               100. * static_cast<double>(std::ranges::count_if(all, meets)) /
                   static_cast<double>(std::ranges::count_if(all, few)),
               90, 100, "tolerances are chosen to deliver in all likelihood; at 12 digits rounding decides");
  show.between("share of series within a factor of two, %", 100 * share_within(all, &Judged::series, close),
               0, 100, "what is won by choosing");
  show.between("share within a factor of two of the fastest, %",
               100 * share_within(all, &Judged::behind, close), 80, 100,
               "what the chapter asks for, each problem judged without itself in the evidence");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result judged(
      "judged",
      "every problem of the set at 3, 6, 9 and 12 digits as if nobody had solved it; times "
      "from tables/reference/method_costs.csv",
      measure);
  return {{.name = "choose",
           .title = "Whether the choice of a method is a good one",
           .content = scene::Content(put, judged)}};
}

}  // namespace nlmech::chapters::integrators::choose
