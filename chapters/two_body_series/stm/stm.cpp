#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/orbit/transition.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::two_body_series::stm {
namespace {

using orbit::State;
using orbit::TransitionMatrix;
using Digits50 = ExtendedReal<50>;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// Central differences of a motion by the changes @p step of the components of its start.
template <class T, class Move>
Matrix<T, 6> differences(const orbit::BasicState<T>& start, const T& step, const Move& move) {
  Matrix<T, 6> m;
  for (Eigen::Index j = 0; j < 6; ++j) {
    const auto end = [&](const T& change) {
      auto s = start;
      (j < 3 ? s.position[j] : s.velocity[j - 3]) += change;
      return move(s);
    };
    const auto above = end(step), below = end(-step);
    m.col(j) << above.position - below.position, above.velocity - below.velocity;
  }
  return m / (2 * step);
}

/// The matrix to 30 digits: differences of 1e-17 in 50 digits.
TransitionMatrix exact(const State& start, double time) {
  const orbit::BasicState<Digits50> s{start.position.cast<Digits50>(), start.velocity.cast<Digits50>()};
  return differences<Digits50>(
             s, Digits50("1e-17"),
             [&](const auto& x) { return orbit::kepler_state<Digits50>(x, Digits50(time), Digits50(1)); })
      .cast<double>();
}

/// |Phi^T J Phi - J|/|Phi|^2 in Frobenius' norm.
double symplectic_defect(const TransitionMatrix& phi) {
  TransitionMatrix j = TransitionMatrix::Zero();
  j.topRightCorner<3, 3>().setIdentity();
  j.bottomLeftCorner<3, 3>() = -j.topRightCorner<3, 3>();
  return (phi.transpose() * j * phi - j).norm() / phi.squaredNorm();
}

/// A matrix after some orbits.
struct Row {
  std::string method;
  double e, orbits, error, defect, bound;  ///< relative error; 8 kappa eps
};

std::vector<Row> measure(bool quick) {
  std::vector<Row> all;
  for (const double e : {0.1, 0.7, 0.99}) {
    const State start = on_ellipse(e);
    for (int i = -4; i <= 16; i += quick ? 4 : 1) {
      const double orbits = 1.1 * std::pow(10, i / 4.0), time = orbits * revolution;
      const TransitionMatrix reference = exact(start, time);
      const auto kappa = orbit::kepler_condition(start, time, 1);
      const auto add = [&](const char* method, const TransitionMatrix& phi) {
        all.push_back({method, e, orbits, (phi - reference).norm() / reference.norm(), symplectic_defect(phi),
                       8 * eps * std::max(kappa.position, kappa.velocity)});
      };
      add("closed form", orbit::kepler_transition(start, time, 1).transition);
      if (e != 0.7) continue;
      if (i <= 12) {
        const auto c = orbit::propagate_transition(start, 0, time, {.zonal = {1e-40}}, {.tolerance = 1e-17});
        if (!c.end.status.ok()) throw Failure(c.end.status);
        add("series", c.transition);
      }
      add("central differences", differences<double>(start, 1e-6, [&](const State& s) {
            return orbit::propagate_kepler(s, time, 1).state;
          }));
    }
  }
  return all;
}

void put(const std::vector<Row>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Transition matrix: error as of rounded data, symplectic to rounding");
  plot.size(1000, 470).columns({"panel", "curve", "orbits", "value"});
  struct Line {
    const char* method;
    double e;
    int style;
  };
  const std::vector<Line> lines = {{"closed form", 0.1, 1},
                                   {"closed form", 0.7, 3},
                                   {"closed form", 0.99, 2},
                                   {"series", 0.7, 4},
                                   {"central differences", 0.7, 5}};
  for (const bool errors : {true, false}) {
    scene::Panel& panel = plot.panel("orbits", errors ? "relative error of Φ" : "|Φ^TJΦ − J| / |Φ|^2");
    panel.log_x(0.1, 1.2e4).log_y(errors ? 1e-16 : 1e-20, errors ? 1 : 1e-6);
    panel.key(errors ? "off" : "at graph 0.98, graph 0.76 right font 'sans-serif,11'");
    for (const Line& line : lines) {
      std::vector<double> x, y;
      for (const Row& r : all) {
        if (r.method != line.method || r.e != line.e) continue;
        x.push_back(r.orbits);
        y.push_back(std::max(errors ? r.error : r.defect, 1e-20));
      }
      panel.curve(fmt::format("{}, e = {:g}", line.method, line.e), x, y, scene::linespoints(line.style));
    }
  }
  double worst = 0, defect = 0, series_defect = 0, gain = HUGE_VAL;
  for (const Row& r : all) {
    if (r.method == "closed form") worst = std::max(worst, r.error / r.bound);
    if (r.method == "closed form") defect = std::max(defect, r.defect);
    if (r.method == "series") series_defect = std::max(series_defect, r.defect);
    if (r.method == "central differences") gain = std::min(gain, r.error);
  }
  show.at_most("largest error of the closed form over 8 kappa eps", worst, 1,
               "kappa of the state, which phase errors of the matrix share; reference in 50 digits");
  show.at_most("largest symplectic defect of the closed form", defect, 1e-13,
               "rounding of products of |Phi|^2");
  show.at_most("largest symplectic defect of the series", series_defect, 4.4e-13,
               "1e3 orbits of some forty steps: ten times a random walk of 4e4 roundings");
  show.between("least error of central differences", gain, 1e-13, 1e-8,
               "differences of 1e-6: its square times third derivatives, and rounding over it");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result all(
      "stm",
      "units a = 1, mu = 1, from the periapsis; errors in Frobenius' norm against central "
      "differences in 50 digits; series of a zonal field with J2 = 1e-40, which has no "
      "effect, and the tolerance 1e-17, up to 1000 orbits",
      measure);
  return {{.name = "stm",
           .title = "State-transition matrix: error and symplectic defect over ten thousand orbits",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::two_body_series::stm
