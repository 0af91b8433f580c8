#include <algorithm>
#include <vector>

#include "chapters/homotopy/solvers/results.hpp"

namespace nlmech::chapters::homotopy::williams_results {
namespace {

const char* const recorded = "regression value";

void check_low_load(const Results& all, scene::Show& show) {
  show.between("iterations of Newton", all.count(0), 6, 7, recorded);
  show.equals("iterations of Newton, d_5 held constant", all.other_count(0), 12, recorded);
  show.equals("iterations of the homotopy", all.count(1), 30,
              "regression value: 30 for steps from 0.883 to 0.906");
}

void check_near_load(const Results& all, scene::Show& show) {
  show.between("iterations of Newton", all.count(0), 20, 399,
               "regression value: 79 to 125 by how the formula is written, 399 at most of 20 001 starts");
  show.at_most("greatest iterations of Newton under 16 loads that differ by roundings",
               std::ranges::max(all.exact[0]->scattered), 600,
               "regression value: 399 at most of 20 001 starts; half as many again for what rounding does");
  show.equals("iterations of Newton, d_5 held constant", all.other_count(0), 1000,
              "no start of 1001 converges: tools/oracles/homotopy_williams.py");
  show.between("iterations of the homotopy", all.count(1), 31, 927,
               "regression value: from 31 to 927 for steps that reproduce Table 2.2");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  // oracle: homotopy_williams Williams 0.32 drop under 27.11, Williams 0.44 drop under 43.79
  constexpr double low = 0.266690787315, near_root = 0.635331561089;
  using enum Scheme;
  return {result_table("table-2.2", "Williams' equation without a limit point, 27.11 lb", check_low_load),
          result_table("table-2.3", "Williams' equation near the limit point, 43.79 lb", check_near_load),
          history({"fig-2.8", "Newton's iterates, l sin(beta) = 0.32 in, W = 27.11 lb",
                   "Newton's iterates without a limit point: fast convergence", "table-2.2", newton, false,
                   10, low, 6}),
          history({"fig-2.9", "Scalar fixed-point homotopy, l sin(beta) = 0.32 in, W = 27.11 lb",
                   "Homotopy iterates without a limit point: slow convergence", "table-2.2", fixed_point,
                   false, 32, low, 6}),
          history({"fig-2.10", "Newton's iterates, l sin(beta) = 0.44 in, W = 43.79 lb",
                   "Newton's iterates: erratic; with the wrong Jacobian no convergence", "table-2.3", newton,
                   true, 150, near_root, 40}),
          history({"fig-2.11", "Scalar fixed-point homotopy, l sin(beta) = 0.44 in, W = 43.79 lb",
                   "Homotopy iterates: erratic, then convergence from beyond the root", "table-2.3",
                   fixed_point, false, 150, near_root, 40})};
}

}  // namespace nlmech::chapters::homotopy::williams_results
