#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy::iteration_study {
namespace {

constexpr int limit = 2500;
/// Step sizes that reproduce Table 2.2, and the smallest and last residuals of Table 2.4 with A_nd as
/// printed.
constexpr double window_low = 0.873, window_high = 0.916;

/// Iteration counts of one row for many step sizes or starts. A count of `limit` means no convergence.
struct Census {
  PrintedRow row;
  std::string jacobian, varied;
  std::vector<double> at;  ///< step sizes or starts
  std::vector<int> counts;
  std::vector<double> residuals;  ///< |F|/|F(0)| of the last iterates

  [[nodiscard]] int quantile(double q) const {
    std::vector<int> sorted = counts;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(std::llround(q * static_cast<double>(sorted.size() - 1)))];
  }
  [[nodiscard]] double share(const std::function<bool(int)>& is) const {
    return static_cast<double>(std::count_if(counts.begin(), counts.end(), is)) /
           static_cast<double>(counts.size());
  }
  [[nodiscard]] double unfinished() const { return at_least(limit); }
  [[nodiscard]] double at_least(int many) const {
    return share([many](int n) { return n >= many; });
  }
};

std::string jacobian_of(Model model) {
  switch (model) {
    case Model::williams_frozen: return "d_5 held constant";
    case Model::element_printed: return "A_nd as printed";
    default: return "derivative of F";
  }
}

/// Iteration counts of a row for @p count + 1 equidistant step sizes; for Newton, starts.
Census census(PrintedRow row, Model model, double low, double high, int count, int most = limit) {
  const bool starts = row.iteration.scheme == Scheme::newton;
  Census c{row, jacobian_of(model), fmt::format("{} {} to {}", starts ? "start" : "step", low, high), {}, {},
           {}};
  LoadedToggle toggle(model, row.height, row.load);
  row.iteration.limit = most;
  for (int i = 0; i <= count; ++i) {
    const double at = low + (high - low) * i / count;
    (starts ? row.iteration.start : row.iteration.step) = at;
    const Count found = iterate(toggle, row.iteration);
    c.at.push_back(at);
    c.counts.push_back(found.converged ? found.iterations : limit);
    c.residuals.push_back(found.residual / toggle.scale());
  }
  return c;
}

/// Largest relative difference of the iterates of Eq. 2.16 from Newton steps times dt/2, for one unknown.
double difference_from_damped_newton() {
  double greatest = 0;
  for (const double step : {0.3, example_step, 1.0, 2.0}) {
    LoadedToggle toggle(Model::williams, 0.44, near_load);
    std::vector<IterationRecord> trace;
    static_cast<void>(
        iterate(toggle, {.scheme = Scheme::newton_homotopy, .step = step, .limit = limit}, &trace));
    const frames::Williams w{.height = 0.44};
    for (std::size_t k = 0; k + 1 < trace.size(); ++k) {
      const double x = trace[k].deflection, f = w.load(x) - near_load, slope = w.stiffness(x);
      const double damped = x - step / 2 * f / slope;
      greatest = std::max(greatest, std::abs(trace[k + 1].deflection - damped) /
                                        (std::abs(x) + std::abs(trace[k + 1].deflection)));
    }
  }
  return greatest;
}

struct Study {
  std::vector<Census> steps;   ///< over the whole range of step sizes; drawn
  std::vector<Census> window;  ///< over the window of step sizes
  std::vector<Census> starts;  ///< over starts of Newton's iteration
  double window_of_30_low = 0, window_of_30_high = 0;
  double difference = 0;  ///< difference_from_damped_newton()
};

Study study(bool quick) {
  const int grid = quick ? 110 : 1650, fine = quick ? 86 : 430, starts = quick ? 1000 : 20'000;
  Study s;
  for (const PrintedRow& row : printed_rows()) {
    const bool williams = row.model == Model::williams;
    if (row.iteration.scheme == Scheme::newton) {
      if (row.table == "table-2.2") continue;
      s.starts.push_back(census(row, row.model, 0, 1, starts));
      if (williams) s.starts.push_back(census(row, Model::williams_frozen, 0, 1, starts / 20, 1000));
      continue;
    }
    s.steps.push_back(census(row, row.model, 0.3, 1.95, grid));
    s.window.push_back(census(row, row.model, window_low, window_high, fine));
    if (williams) continue;
    s.steps.push_back(census(row, Model::element_printed, 0.3, 1.95, grid));
    s.window.push_back(census(row, Model::element_printed, window_low, window_high, fine));
  }
  const Census close = census(printed_rows()[1], Model::williams, 0.8, 1, 400);
  s.window_of_30_low = HUGE_VAL;
  for (std::size_t i = 0; i < close.at.size(); ++i) {
    if (close.counts[i] != 30) continue;
    s.window_of_30_low = std::min(s.window_of_30_low, close.at[i]);
    s.window_of_30_high = close.at[i];
  }
  s.difference = difference_from_damped_newton();
  return s;
}

void put_table(const Study& s, scene::Show& show) {
  std::vector<Census> all;
  for (const auto* list : {&s.steps, &s.window, &s.starts}) all.insert(all.end(), list->begin(), list->end());
  show.table(all,
             {{"table, method", [](const Census& c) { return c.row.table.substr(6) + ", " + c.row.method; }},
              {"Jacobian", &Census::jacobian},
              {"varied", &Census::varied},
              {"printed", [](const Census& c) { return c.row.printed; }},
              {"least", [](const Census& c) { return c.quantile(0); }},
              {"median", [](const Census& c) { return c.quantile(0.5); }},
              {"90 %", [](const Census& c) { return c.quantile(0.9); }},
              {"greatest", [](const Census& c) { return c.quantile(1); }},
              {"as printed (%)",
               [](const Census& c) { return 100 * c.share([&c](int n) { return n == c.row.printed; }); }, 3},
              {"as many or more (%)", [](const Census& c) { return 100 * c.at_least(c.row.printed); }, 3},
              {"not in 2500 (%)", [](const Census& c) { return 100 * c.unfinished(); }, 3}});
}

/// Draws panels for Table 2.2, Table 2.3 and the two homotopies of Table 2.4.
void draw(const Study& s, scene::Show& show) {
  scene::Table data({{"panel"}, {"set", 3, true}, {"step"}, {"count"}, {"printed"}});
  int set = 0;
  for (const Census& c : s.steps) {
    if (c.row.table == "table-2.5") continue;
    ++set;
    const int panel = c.row.table == "table-2.2"                      ? 1
                      : c.row.table == "table-2.3"                    ? 2
                      : c.row.iteration.scheme == Scheme::fixed_point ? 3
                                                                      : 4;
    for (std::size_t i = 0; i < c.at.size(); ++i) data.add({panel, set, c.at[i], c.counts[i], c.row.printed});
  }
  show.draw(std::move(data), "homotopy-counts",
            {{"heading", "Iterations against step: scattered if the load is above the limit load"},
             {"width", "920"},
             {"height", "680"}});
}

const Census& find(const std::vector<Census>& list, const std::string& table, Scheme scheme,
                   const std::string& jacobian) {
  return *std::ranges::find_if(list, [&](const Census& c) {
    return c.row.table == table && c.row.iteration.scheme == scheme && c.jacobian == jacobian;
  });
}

void check_starts(const std::vector<Census>& starts, scene::Show& show) {
  const Census &newton = find(starts, "table-2.3", Scheme::newton, "derivative of F"),
               &held = find(starts, "table-2.3", Scheme::newton, "d_5 held constant"),
               &elements = find(starts, "table-2.4", Scheme::newton, "derivative of F");
  // oracle: homotopy_williams Newton *
  const char* reason = "20 001 starts by tools/oracles/homotopy_williams.py; median 8, nine of ten 70";
  show.between("median of Newton over starts, Williams, 43.79 lb", newton.quantile(0.5), 7, 9, reason);
  show.between("90 % of starts need at most, Williams, 43.79 lb", newton.quantile(0.9), 56, 84, reason);
  show.at_most("greatest count over starts, Williams, 43.79 lb", newton.quantile(1), 600,
               "regression value: 399; half as many again for what rounding does");
  show.at_most("starts that do not converge, Williams, 43.79 lb", newton.unfinished(), 0, reason);
  show.at_most("greatest count over starts, element, 43.79 lb", elements.quantile(1), 430,
               "regression value: 285; half as many again");
  show.at_most("starts that converge with d_5 held constant", 1 - held.unfinished(), 0,
               "no start of 1001 in 1000 iterations: tools/oracles/homotopy_williams.py");
  show.between("median residual after 1000 iterations with d_5 held constant", median(held.residuals), 0.03,
               0.07, "0.04 by tools/oracles/homotopy_williams.py; chaotic");
}

void check_window(const std::vector<Census>& window, scene::Show& show) {
  const Census &lottery = find(window, "table-2.3", Scheme::fixed_point, "derivative of F"),
               &misprint = find(window, "table-2.4", Scheme::fixed_point, "A_nd as printed"),
               &other = find(window, "table-2.4", Scheme::newton_homotopy, "A_nd as printed");
  const auto printed = [&](const std::string& row) {
    return static_cast<int>(show.printed("elgohary/table-" + row + "/iterations"));
  };
  const char* reason = "regression value over the same steps; chaotic counts scatter";
  show.between("median count, Table 2.3, steps 0.873 to 0.916", lottery.quantile(0.5), 70, 140, reason);
  show.between("share of 345 iterations or more, Table 2.3",
               lottery.at_least(printed("2.3/Scalar fixed-point homotopy")), 0.002, 0.08, reason);
  show.between("median count, Table 2.4, A_nd as printed", misprint.quantile(0.5), 50, 85, reason);
  show.between("share of 160 iterations or more, Table 2.4, A_nd as printed",
               misprint.at_least(printed("2.4/Scalar fixed-point homotopy")), 0.06, 0.2, reason);
  show.at_most("share of 500 iterations or more, Newton homotopy, Table 2.4",
               other.at_least(printed("2.4/Scalar Newton homotopy")), 0.03, reason);
}

void put(const Study& s, scene::Show& show) {
  draw(s, show);
  put_table(s, show);
  show.at_most("difference from Newton's step times dt/2, relative", s.difference,
               8 * std::numeric_limits<double>::epsilon(),
               "the same formula for one unknown; eight roundings");
  show.between("least step that takes 30 iterations, Table 2.2", s.window_of_30_low, 0.8825, 0.8840,
               "regression value: 0.883");
  show.between("greatest such step", s.window_of_30_high, 0.9050, 0.9065, "regression value: 0.906");
  check_starts(s.starts, show);
  check_window(s.window, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result counts("counts",
                             "the rows of Tables 2.2 to 2.5 from rest for equally spaced Euler steps, Newton "
                             "for equally spaced starts",
                             study);
  return {{.name = "iteration-study",
           .title = "Iterations against the step of fictitious time, and against the start",
           .content = scene::Content(put, counts)}};
}

}  // namespace nlmech::chapters::homotopy::iteration_study
