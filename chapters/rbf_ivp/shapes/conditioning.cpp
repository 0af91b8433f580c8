#include "chapters/rbf_ivp/shapes/conditioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using conditioning::Sample;
using conditioning::Setting;
using conditioning::Study;
using scene::Workshop;

/// The least error of the solved D in the scan.
const Sample& best(const Study& study) {
  return *std::min_element(study.scan.begin(), study.scan.end(), [](const Sample& a, const Sample& b) {
    return a.solve.value_or(HUGE_VAL) < b.solve.value_or(HUGE_VAL);
  });
}

scene::Table table_of(const std::vector<Study>& all) {
  scene::Table table({{"N"},
                      {"h (P)", 2},
                      {"c h of the dissertation", 4},
                      {"condition"},
                      {"error, inverse"},
                      {"error, solve"},
                      {"error, 50 digits"},
                      {"least error, solve"},
                      {"at c h"},
                      {"error, polynomials"}});
  for (const Study& study : all) {
    const Sample &given = study.dissertation, &least = best(study);
    table.add({std::int64_t(study.setting.nodes), study.setting.periods, given.shape,
               scene::to_cell(given.exact.condition), scene::to_cell(given.inverse),
               scene::to_cell(given.solve), scene::to_cell(given.exact.error), scene::to_cell(least.solve),
               least.shape, study.flat});
  }
  return table;
}

scene::Table data_of(const std::vector<Study>& all) {
  scene::Table data({{"nodes", 3, true},
                     {"shape"},
                     {"inverse"},
                     {"solve"},
                     {"exact"},
                     {"flat"},
                     {"condition"},
                     {"dissertation_shape"}});
  for (const Study& study : all) {
    for (const Sample& s : study.scan)
      data.add({std::int64_t(study.setting.nodes), s.shape, scene::to_cell(s.inverse),
                scene::to_cell(s.solve), scene::to_cell(s.exact.error), study.flat,
                scene::to_cell(s.exact.condition), study.setting.shape});
  }
  return data;
}

std::vector<scene::Quantity> quantities(const std::vector<Study>& all) {
  // oracle: rbf_ivp_shapes N = ? polynomials, N = 15 polynomials, N = 35 polynomials, N = 7 c h = 0.05, N = 7
  // c h = 0.367, N = 7 c h = 1, N = 7 c h = 2, N = 15 c h = 2, N = 15 c h = 4, N = 35 c h = 4, N = 35 c h =
  // 6, N = 35 c h = 8.5, N = 35 c h = 12, N = 60 c h = 14.75
  constexpr double three_digits = 0.01;
  const char* program = "tools/oracles/rbf_ivp_shapes.py, three digits";
  std::vector<scene::Quantity> list;
  constexpr std::array flat = {1.89e-6, 2.04e-5, 3.65e-8};
  for (std::size_t i = 0; i < flat.size(); ++i) {
    list.push_back(scene::near(fmt::format("error of polynomials, N = {}", all[i].setting.nodes), "1",
                               all[i].flat, flat[i], three_digits, program));
  }
  struct Known {
    std::size_t setting;
    double shape, error;
  };
  for (const Known& k :
       {Known{0, 0.05, 1.84e-6}, Known{0, 0.367, 9.99e-7}, Known{0, 1, 8.71e-4}, Known{0, 2, 3.90e-2},
        Known{1, 2, 1.81e-6}, Known{1, 4, 2.37e-4}, Known{2, 4, 2.05e-9}, Known{2, 6, 5.44e-9},
        Known{2, 8.5, 5.90e-5}, Known{2, 12, 3.89e-3}, Known{3, 14.75, 3.09e-5}}) {
    const Setting& s = conditioning::settings[k.setting];
    const double error = conditioning::exact(s, k.shape).error.value_or(NAN);
    list.push_back(scene::near(fmt::format("error with 50 digits, N = {}, c h = {}", s.nodes, k.shape), "1",
                               error, k.error, three_digits, program));
  }
  list.push_back(scene::near("condition, N = 7, c h = 0.37", "1",
                             conditioning::exact(conditioning::settings[0], 0.37).condition.value_or(NAN),
                             8.6e12, 0.01, "recorded, two digits"));
  list.push_back(scene::near("error by solving, N = 35, c h = 8.5", "1",
                             all[2].dissertation.solve.value_or(NAN), 6.1e-5, 0.25,
                             "recorded: truncation 5.9e-5 and rounding"));
  return list;
}

scene::Showing show(const std::vector<Study>& all) {
  scene::Showing showing;
  showing.table = table_of(all);
  showing.figure = {data_of(all),
                    "rbf_ivp-conditioning",
                    {{"heading", "Rounding from the left, truncation from the right: 1e-7 is left between"},
                     {"height", "660"}}};
  showing.quantities = quantities(all);
  return showing;
}

}  // namespace

void add_conditioning(scene::Chapter& chapter) {
  const auto& scans = chapter.add_run<std::vector<Study>>(
      "differentiation-against-shape",
      "Gaussians at Legendre-Gauss-Lobatto nodes on an arc of the free Duffing oscillator from t = 1.1 s; "
      "largest error at a node relative to the largest derivative",
      {}, [](Workshop& w) { return conditioning::studies(w.quick()); });
  chapter.add({.name = "conditioning",
               .title = "Error of the differentiation matrix and condition of its basis against the shape",
               .place = "our own",
               .needs = {&scans},
               .show = [&scans](Workshop& w) { return show(w.result(scans)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
