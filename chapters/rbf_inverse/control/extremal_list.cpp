#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse::extremal_list {
namespace {

using bvp::DuffingCase;

/// Row of the table: an extremal of a case at a final time.
struct Row {
  double final_time;
  DuffingCase which;
  const bvp::Found* found;

  [[nodiscard]] std::string_view name() const { return to_string(which); }
  [[nodiscard]] const bvp::Extremal& extremal() const { return found->extremal; }
  [[nodiscard]] double cost() const { return extremal().cost; }
  [[nodiscard]] bvp::Kind kind() const { return extremal().second_order.kind; }
  /// Initial value of component i; values of the size of rounding are shown as 0.
  [[nodiscard]] double first(Eigen::Index i) const {
    const double value = extremal().solution.first()[i];
    return std::abs(value) < 1e-12 ? 0.0 : value;
  }
};
/// Ordered by final time, then by case, then by cost.
using Rows = std::vector<Row>;

void tabulate(const Rows& rows, scene::Show& show) {
  show.table(rows, {{"T", &Row::final_time},
                    {"case", &Row::name},
                    {"cost", [](const Row& r) { return r.cost() < 1e-20 ? 0.0 : r.cost(); }, 10},
                    {"kind", [](const Row& r) { return to_string(r.kind()); }},
                    {"least eigenvalue", [](const Row& r) { return r.extremal().second_order.least; }, 3},
                    {"starts that led to it", [](const Row& r) { return r.found->hits; }},
                    {"x1(0)", [](const Row& r) { return r.first(0); }, 8},
                    {"x2(0)", [](const Row& r) { return r.first(1); }, 8},
                    {"lambda1(0)", [](const Row& r) { return r.first(2); }, 10},
                    {"lambda2(0)", [](const Row& r) { return r.first(3); }, 10},
                    {"miss of the integrated end", [](const Row& r) { return r.extremal().miss; }, 2}});
}

/// Compares the extremals of least cost with the known ones.
void check_known(const Rows& rows, scene::Show& show) {
  const auto best = [&](DuffingCase which, double time) {
    return *std::ranges::find_if(rows, [&](const Row& r) {
      return r.which == which && r.final_time == time;
    });  // the first match has the least cost
  };
  double worst_first = 0, worst_miss = 0;
  for (const KnownExtremal& k : known_extremals()) {
    const Row r = best(k.which, k.final_time);
    show.at_most(fmt::format("lowest cost, {}, T = {:g}", r.name(), k.final_time), r.cost(),
                 k.cost * (1 + 1e-9), "the lowest of 270 starts, tools/oracles/rbf_inverse_extremals.py");
    worst_first = std::max(worst_first, k.error_of(r.extremal()));
  }
  show.at_most("largest error of their initial states and co-states", worst_first, 1e-10,
               "the same; relative where above 1");
  for (const Row& r : rows)
    worst_miss = std::max(worst_miss, r.extremal().miss / (1 + r.extremal().solution.first().norm()));
  show.at_most("largest miss of all extremals over their initial values", worst_miss, 1e-9,
               "the tolerance of the collocation");
  // oracle: rbf_inverse_extremals fixed T = 5 cost
  show.at_most("cost of the fixed case, T = 5", best(DuffingCase::fixed, 5).cost(), 46.608623 * (1 + 1e-7),
               "the best known, tools/oracles/rbf_inverse_extremals.py");
  show.at_most("cost of a free start, T = 2", best(DuffingCase::final_only, 2).cost(), 1e-12,
               "integrated backward from the target without force: J = 0");
}

void put(const std::vector<const bvp::Multistart*>& all, scene::Show& show) {
  Rows rows;
  std::size_t i = 0;
  for (const double time : final_times)
    for (const DuffingCase which : bvp::duffing_cases()) {
      if (all[i]->found.empty())
        throw Failure(fmt::format("case {}, T = {:g}: no extremal is found", to_string(which), time));
      for (const bvp::Found& f : all[i]->found) rows.push_back({time, which, &f});
      ++i;
    }
  tabulate(rows, show);
  check_known(rows, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Result<bvp::Multistart>> all;
  for (const double time : final_times)
    for (const DuffingCase which : bvp::duffing_cases()) all.push_back(extremals(which, time));
  return {{.name = "extremals",
           .title = "All extremals that the program's own starts find, with cost and kind",
           .place = "our own, for the cheapest extremals of Figures 5.1 to 5.16",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::rbf_inverse::extremal_list
