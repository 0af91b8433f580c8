#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::from_guesses {
namespace {

/// Row of the table: outcomes of the guesses of one case at one final time.
struct Row {
  const FromGuesses* all;
  GuessCounts counts;
  std::vector<const bvp::Extremal*> found;

  explicit Row(const FromGuesses* of) : all(of), counts(of->counts()), found(of->distinct()) {}
  [[nodiscard]] bool any() const { return !found.empty(); }
};

void tabulate(const std::vector<Row>& rows, scene::Show& show) {
  const auto first = [](const Row& r) {
    return r.any() ? scene::Cell(guess_name(r.all->chosen())) : scene::Cell();
  };
  const auto cost = [](const Row& r) {
    return r.any() ? scene::Cell(r.all->drawn().extremal.cost) : scene::Cell();
  };
  show.table(
      rows,
      {{"case",
        [](const Row& r) { return fmt::format("T = {}, {}", r.all->final_time, r.all->subject->title); }},
       {"extremals, of 11", [](const Row& r) { return r.counts.good; }},
       {"the cheapest", [](const Row& r) { return r.counts.cheapest; }},
       {"roots that are no solutions", [](const Row& r) { return r.counts.spurious; }},
       {"failures", [](const Row& r) { return r.counts.failed; }},
       {"different extremals", [](const Row& r) { return r.found.size(); }},
       {"the first is from", first},
       {"its cost", cost, 5},
       {"highest cost",
        [](const Row& r) { return r.any() ? scene::Cell(r.found.back()->cost) : scene::Cell(); }, 5},
       {"cheapest known",
        [](const Row& r) { return known_extremal(r.all->subject->which, r.all->final_time).cost; }, 5},
       {"least error at the nodes",
        [](const Row& r) { return r.any() ? scene::Cell(r.all->least_error()) : scene::Cell(); }, 2}});
}

void put(const std::vector<const FromGuesses*>& all, scene::Show& show) {
  const std::vector<Row> rows(all.begin(), all.end());
  tabulate(rows, show);
  std::map<double, GuessCounts> sums;  // by final time
  int saddles = 0;                     // number of saddles among the six plotted extremals
  for (const Row& r : rows) {
    sums[r.all->final_time] += r.counts;
    if (r.all->final_time == inferred)
      saddles += r.all->drawn().extremal.second_order.kind == bvp::Kind::saddle ? 1 : 0;
  }
  // For 66 guesses three standard deviations of a fraction are at most 0.18; the bounds are limited to 0 and
  // 1.
  for (const auto& [time, known] : {std::pair{1, 0.80}, {2, 0.42}, {5, 0.01}})
    show.between(fmt::format("share of guesses that find an extremal, T = {}", time),
                 sums[time].share(&GuessCounts::good), std::max(0.0, known - 0.2), known + 0.2,
                 "regression value of 600 other guesses; sampling");
  const double good = sums[inferred].share(&GuessCounts::good);
  show.between("saddles among the six that are drawn, T = 2", saddles, 1, 6,
               "x1x1 from zeros at least, by the second variation");
  show.between("share of guesses that find the cheapest, T = 2", sums[inferred].share(&GuessCounts::cheapest),
               0, good, "some of those that find an extremal");
  show.between("share of guesses that end on no solution, T = 2",
               sums[inferred].share(&GuessCounts::spurious), 0, 1 - good, "some of the others");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {
      {.name = "from-guesses",
       .title = "Extremals that the printed method finds from zeros and ten random guesses, with their cost",
       .place = "our own, for the claims of section 5.5",
       .content = scene::Content(put, all_printed_results())}};
}

}  // namespace nlmech::chapters::rbf_inverse::from_guesses
