#include <algorithm>
#include <iterator>
#include <vector>

#include "chapters/homotopy/solvers/results.hpp"

namespace nlmech::chapters::homotopy::element_results {
namespace {

/// @param cycle relative residual after Newton's iterations with A_nd as printed
/// @param tolerance of all homotopy rows, relative
void check(const Results& all, double least, double most, double cycle, double tolerance, scene::Show& show) {
  show.between("iterations of Newton", all.count(0), least, most, "regression value");
  show.equals("iterations of Newton, A_nd as printed", all.other_count(0), 1000,
              "a cycle: tools/oracles/homotopy_williams.py");
  show.near("relative residual of Newton, A_nd as printed",
            all.misprinted[0]->count.residual / all.misprinted[0]->scale, cycle, 2e-4,
            "tools/oracles/homotopy_williams.py");
  for (std::size_t i = 1; i < all.printed.size(); ++i)
    show.at_most("relative residual of " + all.printed[i].method,
                 all.exact[i]->count.residual / all.exact[i]->scale, tolerance, "the tolerance");
}

// oracle: homotopy_williams cycle under 44 lb: larger residual
void check_near_load(const Results& all, scene::Show& show) { check(all, 8, 8, 0.100228, 1e-6, show); }
void check_last_load(const Results& all, scene::Show& show) { check(all, 39, 40, 0.30373, 1e-3, show); }

}  // namespace

std::vector<scene::Scene> scenes() {
  // oracle: homotopy_frames toggle 0.44 of 1 drop under *
  constexpr double near_root = 0.621922545486, last_root = 0.623070489;
  using enum Scheme;
  const std::vector<History> figures = {
      {"fig-2.16", "Newton's residual, element, l sin(beta) = 0.44 in, W = 43.79 lb",
       "Newton's residual: oscillates with the tangent as printed", "table-2.4", newton, true, 40, near_root,
       40},
      {"fig-2.17", "Residual of the scalar fixed-point homotopy, element, W = 43.79 lb, tolerance 1e-6",
       "Fixed-point homotopy, 43.79 lb: erratic residual, then convergence", "table-2.4", fixed_point, true,
       200, near_root, 40},
      {"fig-2.18", "Residual of the scalar Newton homotopy, element, W = 43.79 lb, tolerance 1e-6",
       "Newton homotopy, 43.79 lb: erratic residual, then convergence", "table-2.4", newton_homotopy, true,
       200, near_root, 40},
      {"fig-2.19", "Residual of the scalar fixed-point homotopy, element, W = 44 lb, tolerance 0.1 %",
       "Fixed-point homotopy, 44 lb: erratic residual, then below 0.1 %", "table-2.5", fixed_point, true, 80,
       last_root, 40},
      {"fig-2.20", "Residual of the scalar Newton homotopy, element, W = 44 lb, tolerance 0.1 %",
       "Newton homotopy, 44 lb: erratic residual, then below 0.1 %", "table-2.5", newton_homotopy, true, 200,
       last_root, 40}};
  std::vector<scene::Scene> all = {
      result_table("table-2.4", "Elements near the limit point, 43.79 lb, tolerance 1e-6", check_near_load),
      result_table("table-2.5", "Elements near the limit point, 44 lb, tolerance 0.1 %", check_last_load)};
  std::ranges::transform(figures, std::back_inserter(all), history);
  return all;
}

}  // namespace nlmech::chapters::homotopy::element_results
