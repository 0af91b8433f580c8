#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Of the extremals' largest errors at the nodes, the least.
double least_error(const FromGuesses& all) {
  double least = HUGE_VAL;
  for (const bvp::GlobalResult& r : all) {
    const NodeErrors errors = node_errors(r);
    if (r.extremal.solution.status.ok()) least = std::min(least, std::max(errors.states, errors.costates));
  }
  return least;
}

/// What one case makes of its guesses at one final time.
void add_row(scene::Table& table, const DuffingSubject& subject, double final_time, const FromGuesses& all) {
  const double cheapest = known_extremal(subject.which, final_time).cost;
  const GuessCounts counts = count_of(all, cheapest);
  const std::vector<const bvp::Extremal*> found = distinct_of(all);
  const auto count = static_cast<std::int64_t>(all.size());
  const auto if_found = [&](double value) { return found.empty() ? scene::Cell() : scene::Cell(value); };
  const bool any = !found.empty();
  table.add({final_time, subject.title, counts.good, counts.cheapest, counts.spurious,
             count - counts.good - counts.spurious, static_cast<std::int64_t>(found.size()),
             any ? scene::Cell(guess_name(drawn_of(all))) : scene::Cell(),
             if_found(any ? all[drawn_of(all)].extremal.cost : 0), if_found(any ? found.back()->cost : 0),
             cheapest, if_found(least_error(all))});
}

/// Of the six extremals that the figures draw, those that are no minimum.
double saddles(const DuffingRuns& runs, Workshop& w) {
  return static_cast<double>(
      std::count_if(duffing_subjects().begin(), duffing_subjects().end(), [&](const DuffingSubject& subject) {
        const FromGuesses& all = w.result(run_of(runs.printed, subject.which));
        return all[drawn_of(all)].extremal.second_order.kind == bvp::Kind::saddle;
      }));
}

scene::Showing show(const DuffingRuns& runs, Workshop& w) {
  scene::Table table({{"T"},
                      {"case"},
                      {"extremals, of 11"},
                      {"the cheapest"},
                      {"roots that are no solutions"},
                      {"failures"},
                      {"different extremals"},
                      {"the first is from"},
                      {"its cost", 5},
                      {"highest cost", 5},
                      {"cheapest known", 5},
                      {"least error at the nodes", 2}});
  std::array<GuessCounts, final_times.size()> sums;
  double tried = 0;
  for (std::size_t time = 0; time < final_times.size(); ++time) {
    tried = 0;
    for (const DuffingSubject& subject : duffing_subjects()) {
      const FromGuesses& all = w.result(run_of(runs.printed, subject.which, time));
      add_row(table, subject, final_times[time], all);
      const GuessCounts c = count_of(all, known_extremal(subject.which, final_times[time]).cost);
      sums[time].good += c.good;
      sums[time].cheapest += c.cheapest;
      sums[time].spurious += c.spurious;
      tried += static_cast<double>(all.size());
    }
  }
  // 66 guesses: three deviations of a share are 0.18 at most; a share is never beyond 0 and 1.
  const auto share = [&](std::size_t time, double known) {
    return scene::Quantity{fmt::format("share of guesses that find an extremal, T = {:g}", final_times[time]),
                           "1",
                           double(sums[time].good) / tried,
                           std::max(0.0, known - 0.2),
                           known + 0.2,
                           "recorded of 600 other guesses; sampling"};
  };
  const double good = double(sums[inferred].good) / tried;
  return {{},
          std::move(table),
          {share(0, 0.80),
           share(1, 0.42),
           share(2, 0.01),
           {"saddles among the six that are drawn, T = 2", "1", saddles(runs, w), 1, 6,
            "x1x1 from zeros at least, by the second variation"},
           {"share of guesses that find the cheapest, T = 2", "1", double(sums[inferred].cheapest) / tried, 0,
            good, "some of those that find an extremal"},
           {"share of guesses that end on no solution, T = 2", "1", double(sums[inferred].spurious) / tried,
            0, 1 - good, "some of the others"}}};
}

}  // namespace

void add_from_guesses(scene::Chapter& chapter, const DuffingRuns& runs) {
  std::vector<const scene::AnyRun*> needs;
  for (const auto& at_time : runs.printed)
    for (const DuffingSubject& subject : duffing_subjects())
      needs.push_back(at_time[static_cast<std::size_t>(subject.which)]);
  chapter.add({.name = "from-guesses",
               .title = "What the printed method finds from zeros and ten random guesses, and at what cost",
               .place = "our own",
               .needs = needs,
               .show = [runs](Workshop& w) { return show(runs, w); }});
}

}  // namespace nlmech::chapters
