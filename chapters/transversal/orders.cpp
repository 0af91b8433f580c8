#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "chapters/transversal/scenes.hpp"
#include "nlmech/ivp/mtl.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double end = 12;

/// The error at the end with steps of a length.
struct Sample {
  double step, error;
};

/// A basis with p points, and how its error falls.
struct Fall {
  std::string name;
  int expected;
  std::vector<Sample> samples;  ///< each step half as long as the one before

  /// Slope of the last two.
  [[nodiscard]] double observed() const {
    return std::log2(samples[samples.size() - 2].error / samples.back().error);
  }
};

Fall fall_of(const Truth& truth, const problems::DrivenDuffing& problem, int p, ivp::MtlBasis basis,
             int halvings) {
  Fall fall{basis == ivp::MtlBasis::lagrange ? fmt::format("p = {}", p) : fmt::format("hats p = {}", p),
            ivp::mtl_order(basis, p),
            {}};
  // Steps that errors of the higher orders do not take below 1e-12, where roundings are.
  for (int k = 0; k < halvings; ++k) {
    const ivp::Mtl method{.step = 0.2 / (1 << k), .points = p, .basis = basis, .error_tolerance = 0};
    const auto s = ivp::integrate(ivp::System<2>(problem), {1, 0}, 0, end, method);
    if (!s.status.ok()) throw Failure(s.status);
    fall.samples.push_back({method.step, (s.x - truth(end).cast<double>()).cwiseAbs().maxCoeff()});
  }
  return fall;
}

std::vector<Fall> falls() {
  const problems::DrivenDuffing problem{.damping = 0.1};
  const Truth truth(problem, {1, 0}, 0, end);
  std::vector<Fall> all;
  const int halvings[] = {7, 6, 6, 5, 5, 4};
  for (int p = 1; p <= 6; ++p)
    all.push_back(fall_of(truth, problem, p, ivp::MtlBasis::lagrange, halvings[p - 1]));
  all.push_back(fall_of(truth, problem, 4, ivp::MtlBasis::interpolet, 7));
  return all;
}

scene::Showing show(const std::vector<Fall>& all) {
  scene::Table data({{"series", 3, true}, {"step"}, {"error"}, {"overflow"}});
  scene::Table table({{"basis"}, {"order by theory"}, {"observed order", 4}, {"least error", 2}});
  scene::Showing showing;
  std::string legend;
  std::int64_t number = 0;
  for (const Fall& f : all) {
    ++number;
    for (const Sample& s : f.samples) data.add({number, s.step, s.error, {}});
    legend += (legend.empty() ? "" : "|") + f.name;
    table.add({f.name, std::int64_t{f.expected}, f.observed(), f.samples.back().error});
    showing.quantities.push_back(
        {"observed order of " + f.name, "1", f.observed(), f.expected - 0.12, f.expected + 0.12,
         "quadrature at equidistant points; 0.12 for the next term of the error at these steps"});
  }
  showing.table = std::move(table);
  showing.figure = {std::move(data),
                    "transversal-steps",
                    {{"heading", "Order p + 1 for odd p, p + 2 for even p"},
                     {"legend", legend},
                     {"xrange", "[2e-3:0.3]"},
                     {"yrange", "[1e-13:1]"},
                     {"xlabel", "step \u200b{/:Italic h}"},
                     {"ylabel", "largest error at \u200b{/:Italic t}\u200b = 12"}}};
  return showing;
}

}  // namespace

void add_transversal_orders(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Fall>>(
      "falls", "x'' + 0.1 x' + x + x^3 = cos t from (1, 0) to t = 12, K = 1, C = 0.1, the load exact", {},
      [](Workshop&) { return falls(); });
  chapter.add({.name = "orders",
               .title = "Observed orders for p = 1 to 6, and of hat functions",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
