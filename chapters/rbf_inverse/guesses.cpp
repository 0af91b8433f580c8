#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "chapters/rbf_inverse/scenes.hpp"
#include "chapters/rbf_inverse/transfer_runs.hpp"

namespace nlmech::chapters {
namespace {

using orbit::CollocatedTransfer;
using orbit::TransferBasis;
using orbit::TransferGuess;
using scene::Workshop;

/// What a number of starts of one kind lead to.
struct Outcomes {
  std::string start, basis;
  int starts = 0, arc = 0, other = 0, spurious = 0, none = 0;
  std::vector<double> iterations;  // of those that found the arc

  [[nodiscard]] double median() const {
    if (iterations.empty()) return 0;
    std::vector<double> sorted = iterations;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// The arc of Table 5.4 is the short way without revolutions; within 1 m/s, a loss of digits may be.
void count(const CollocatedTransfer& t, Outcomes& all) {
  ++all.starts;
  if (t.status.ok()) {
    const bool found = velocity_error(t.v1) < 1;
    ++(found ? all.arc : all.other);
    if (found) all.iterations.push_back(static_cast<double>(t.statistics.newton_iterations));
  } else {
    ++(t.status.outcome() == Outcome::spurious_root ? all.spurious : all.none);
  }
}

std::vector<Outcomes> try_all(Workshop& w) {
  struct Start {
    const char* name;
    TransferGuess guess;
    double length_unit, time_unit;
  };
  const Start starts[] = {{"straight line", TransferGuess::line, 0, 0},
                          {"arc", TransferGuess::arc, 0, 0},
                          {"ones, in metres and seconds", TransferGuess::ones, 1, 1},
                          {"ones, in canonical units", TransferGuess::ones, 0, 0},
                          {"random, in canonical units", TransferGuess::random, 0, 0}};
  std::vector<Outcomes> all;
  for (const TransferBasis basis : {TransferBasis::polynomial, TransferBasis::gaussian}) {
    for (const Start& s : starts) {
      Outcomes outcomes;
      outcomes.start = s.name;
      outcomes.basis = basis == TransferBasis::polynomial ? "polynomials" : "Gaussian, as printed";
      orbit::TransferCollocation method{.basis = basis,
                                        .guess = s.guess,
                                        .length_unit = s.length_unit,
                                        .time_unit = s.time_unit,
                                        .largest_miss = 0.01};
      method.equations = orbit::TransferEquations::positions_and_velocities;
      const int repeats = s.guess != TransferGuess::random ? 1 : w.quick() ? 10 : 60;
      for (int k = 1; k <= repeats; ++k) {
        method.seed = static_cast<std::uint64_t>(k);
        count(orbit::collocate(printed_transfer(), method), outcomes);
      }
      all.push_back(std::move(outcomes));
    }
  }
  return all;
}

scene::Showing show(const scene::Run<std::vector<Outcomes>>& run, Workshop& w) {
  scene::Table table({{"basis"},
                      {"start"},
                      {"starts"},
                      {"the short arc"},
                      {"another arc"},
                      {"no orbit"},
                      {"no solution"},
                      {"median of Newton's iterations", 2}});
  double least_share = 1, others = 0;
  for (const Outcomes& o : w.result(run)) {
    table.add({o.basis, o.start, std::int64_t(o.starts), std::int64_t(o.arc), std::int64_t(o.other),
               std::int64_t(o.spurious), std::int64_t(o.none),
               o.iterations.empty() ? scene::Cell() : o.median()});
    others += o.other;
    if (o.basis == "polynomials") least_share = std::min(least_share, double(o.arc) / o.starts);
  }
  return {{},
          std::move(table),
          {{"least share of starts that polynomials lead to the short arc", "1", least_share, 0.9, 1,
            "recorded: 60 of 60, and all single starts"},
           scene::at_most("starts that lead to another arc", "1", others, 6,
                          "a tenth of the random starts; none was seen among sixty")}};
}

}  // namespace

void add_guesses(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Outcomes>>(
      "lambert-guesses", "47 LGL nodes, 6N equations, Newton's iteration with full steps, at most 60", {},
      try_all);
  chapter.add({.name = "guesses",
               .title = "Which arc each start of Newton's iteration finds",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(run, w); }});
}

}  // namespace nlmech::chapters
