#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/random_guess.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "chapters/rbf_inverse/single_shooting.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Final times that are tried, 0.5 to 3.5.
constexpr int times_tried = 13;
double time_of(int k) { return 0.5 + 0.25 * k; }
/// beta = 0, 0.1, ..., 1.2, and of them those of the text's "0.9 and more".
constexpr int betas = 13, first_of_text = 9;
/// Guesses for all unknowns: zeros, ones, ten random ones.
constexpr int guesses_drawn = 2, guesses_tried = 12;
std::string guess_name(int guess) { return guess == 0 ? "zeros" : guess == 1 ? "ones" : "random"; }

bvp::Start guess_of(int guess, double final_time) {
  return guess < guesses_drawn ? bvp::constant_start(Eigen::VectorXd::Constant(4, guess))
                               : random_guess(guess - guesses_drawn, final_time);
}

/// What "diverges" may mean: no root, or none without an iterate beyond 1000, ten times any extremal's here.
constexpr std::array<double, 2> reaches = {HUGE_VAL, 1e3};

bvp::ExtremalProblem problem_of(double final_time, int beta) {
  bvp::DuffingSettings settings = printed_settings(bvp::DuffingCase::fixed, final_time);
  settings.beta = beta / 10.;
  return duffing_problem(settings);
}

/// The largest iterate on the way to a root; not a number without one.
double shooting_reach(double final_time, int beta, int guess) {
  const bvp::ExtremalProblem problem = problem_of(final_time, beta);
  Eigen::VectorXd first(4);
  guess_of(guess, final_time).states(0, first);
  for (Eigen::Index i = 0; i < 2; ++i) first[i] = *problem.task().begin[static_cast<std::size_t>(i)];
  const SingleShot shot = shoot_once(problem, first);
  return shot.status.ok() ? shot.reach : std::numeric_limits<double>::quiet_NaN();
}

Outcome collocation_ends(double final_time, int beta, int guess) {
  const bvp::ExtremalProblem problem = problem_of(final_time, beta);
  return solve_global(problem, printed_method(problem), guess_of(guess, final_time))
      .extremal.solution.status.outcome();
}

/// Both methods from one guess, by beta.
struct Row {
  std::array<bool, betas> shot{};
  std::array<Outcome, betas> collocated{};
};
/// One final time.
struct Column {
  double final_time = 0;
  std::array<Row, guesses_drawn> rows;
  int readings = 0;  ///< guesses times meanings of divergence
  int fit = 0;       ///< fails for 0.9 and more where collocation finds an extremal at 0.9
  int sharp = 0;     ///< of them, those that converge at 0.8
};
using Map = std::vector<Column>;

/// The least iterate on the way to a root over all beta of 0.9 and more; infinite if shooting fails for all.
double least_reach(double final_time, int guess) {
  double least = HUGE_VAL;
  for (int beta = first_of_text; beta < betas && least > reaches.back(); ++beta)
    least = std::fmin(least, shooting_reach(final_time, beta, guess));  // which passes over NaN
  return least;
}

/// Does shooting fail for 0.9 and more where collocation finds an extremal at 0.9, and does it not at 0.8?
void add_readings(Column& column, int guess) {
  column.readings += static_cast<int>(reaches.size());
  const double least = least_reach(column.final_time, guess);
  if (least <= reaches.back() ||
      collocation_ends(column.final_time, first_of_text, guess) != Outcome::success)
    return;
  const double below = shooting_reach(column.final_time, first_of_text - 1, guess);
  for (const double reach : reaches) {
    if (least < reach) continue;
    ++column.fit;
    if (below <= reach) ++column.sharp;
  }
}

Map compute(bool quick) {
  Map map;
  for (int k = 0; k < times_tried; k += quick ? 6 : 1) {
    Column column;
    column.final_time = time_of(k);
    for (int guess = 0; guess < guesses_drawn; ++guess) {
      Row& row = column.rows[static_cast<std::size_t>(guess)];
      for (int beta = 0; beta < betas; ++beta) {
        const auto b = static_cast<std::size_t>(beta);
        row.shot[b] = shooting_reach(column.final_time, beta, guess) > 0;
        row.collocated[b] = collocation_ends(column.final_time, beta, guess);
      }
    }
    for (int guess = 0; guess < (quick ? guesses_drawn : guesses_tried); ++guess) add_readings(column, guess);
    map.push_back(column);
  }
  return map;
}

/// Of the values of beta, on how many both ways of one guess end so.
std::int64_t count(const Row& row, bool shot, bool collocated) {
  std::int64_t n = 0;
  for (std::size_t b = 0; b < row.shot.size(); ++b)
    if (row.shot[b] == shot && (row.collocated[b] == Outcome::success) == collocated) ++n;
  return n;
}

scene::Table tabulate(const Map& map) {
  scene::Table table({{"T"},
                      {"guess"},
                      {"both converge, of 13 beta"},
                      {"shooting alone"},
                      {"collocation alone"},
                      {"neither"},
                      {"least beta at which shooting fails"},
                      {"readings"},
                      {"that fit the text"},
                      {"and converge at 0.8"}});
  for (const Column& c : map)
    for (int guess = 0; guess < guesses_drawn; ++guess) {
      const Row& r = c.rows[static_cast<std::size_t>(guess)];
      const auto failure = std::find(r.shot.begin(), r.shot.end(), false);
      const auto all = [&](int n) { return guess == 0 ? scene::Cell(std::int64_t{n}) : scene::Cell(); };
      table.add({c.final_time, guess_name(guess), count(r, true, true), count(r, true, false),
                 count(r, false, true), count(r, false, false),
                 failure == r.shot.end() ? scene::Cell()
                                         : scene::Cell(static_cast<double>(failure - r.shot.begin()) / 10),
                 all(c.readings), all(c.fit), all(c.sharp)});
    }
  return table;
}

/// The longest time up to which single shooting converges at all beta, from zeros and from ones; 0 if none.
double always_converges(const Map& map) {
  double longest = 0;
  for (const Column& c : map) {
    for (const Row& r : c.rows)
      if (std::find(r.shot.begin(), r.shot.end(), false) != r.shot.end()) return longest;
    longest = c.final_time;
  }
  return longest;
}

scene::Figure draw(const Map& map) {
  ControlCurves figure(
      fmt::format("Beyond {{/:Italic T}} = {:g} s, chance decides who converges", always_converges(map)));
  struct Look {
    const char *name, *style;
    bool shot, collocated;
  };
  constexpr std::array<Look, 4> looks = {{{"both converge", "o1", true, true},
                                          {"shooting alone", "o4", true, false},
                                          {"collocation alone", "o2", false, true},
                                          {"neither", "p8", false, false}}};
  for (int guess = 0; guess < guesses_drawn; ++guess) {
    figure.panel("final time {/:Italic T} (s)", guess == 0 ? "{/:Italic β} (1/s^{2})" : "",
                 "from " + guess_name(guess));
    for (const Look& look : looks) {
      figure.begin(look.name, look.style);
      figure.add(-1, -1);  // outside: a curve has a point at least
      for (const Column& c : map) {
        const Row& r = c.rows[static_cast<std::size_t>(guess)];
        for (std::size_t b = 0; b < r.shot.size(); ++b)
          if (r.shot[b] == look.shot && (r.collocated[b] == Outcome::success) == look.collocated)
            figure.add(c.final_time, static_cast<double>(b) / 10);
      }
    }
    figure.with("xrange", "[0.3:3.7]").with("yrange", "[-0.08:1.28]");
    figure.with("key", guess == 0 ? "off" : "at screen 0.5, screen 0.01 center bottom maxrows 1 samplen 2");
  }
  figure.overall("bottom", "0.25").overall("width", "1000").overall("height", "480");
  return figure.take();
}

std::vector<scene::Quantity> promises(const Map& map, bool quick) {
  const char* const program = "an independent program, with another integrator";
  std::vector<scene::Quantity> all = {
      {"longest T up to which shooting converges at every beta, from zeros and ones", "s",
       always_converges(map), quick ? 0.5 : 0.75, 1.5, program}};
  if (quick) return all;  // three final times say nothing of the others
  double latest_solved = 0;
  int readings = 0, fit = 0, most = 0, at_2 = 0;
  for (const Column& c : map) {
    readings += c.readings;
    fit += c.fit;
    most = std::max(most, c.fit);
    if (c.final_time == final_times[inferred]) at_2 = c.fit;
    for (const Row& r : c.rows)
      if (r.collocated[first_of_text] == Outcome::success)
        latest_solved = std::max(latest_solved, c.final_time);
  }
  all.push_back({"longest T at which the printed method solves beta = 0.9, from zeros or ones", "s",
                 latest_solved, 2, 3, program});
  all.push_back({"readings tried", "1", double(readings), 312, 312, "13 times, 12 guesses, 2 meanings"});
  all.push_back({"readings that fit the text", "1", double(fit), 0, 31,
                 "chance: nine times with four failures in a row, one in twenty, and a root, one in three"});
  all.push_back({"readings that fit at one final time, at most", "1", double(most), 0, 8,
                 "a claim that determines T is fitted by most of the 24 readings at one T, and this is not"});
  all.push_back({"readings that fit at T = 2", "1", double(at_2), 0, 8, "the same"});
  return all;
}

}  // namespace

void add_shooting(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Map>(
      "single-shooting",
      "fixed final state, S = I; T from 0.5 to 3.5, beta from 0 to 1.2; Newton's iteration on x(0) and "
      "lambda(0), flown by ode45 at 1e-8, 60 iterations at most; the printed collocation from the same "
      "guess, its root flown; a reading is a final time, a guess and what divergence means",
      {}, [](Workshop& w) { return compute(w.quick()); });
  chapter.add({.name = "shooting",
               .title = "Where single shooting converges, and the printed method from the same guess",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const Map& map = w.result(run);
                 return scene::Showing{draw(map), tabulate(map), promises(map, w.quick())};
               }});
  chapter.add(scene::Measurement{
      "elgohary/claim-5.3.5/fixed final state/shooting diverges from beta", {&run}, [&run](Workshop& w) {
        // Neither T nor the guess is stated: T = 2 from zeros is one reading of many.
        for (const Column& c : w.result(run)) {
          if (c.final_time != final_times[inferred]) continue;
          const auto& shot = c.rows[0].shot;
          const auto failure = std::find(shot.begin(), shot.end(), false);
          if (failure != shot.end())
            return scene::Measured{{}, static_cast<double>(failure - shot.begin()) / 10};
        }
        return scene::Measured{};
      }});
}

}  // namespace nlmech::chapters
