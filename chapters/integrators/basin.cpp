#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::basin {
namespace {

/// x'' + d x' - x + x^3 = F cos(t): two wells, and a load that lets neither keep all that starts in it.
struct TwoWells {
  static constexpr int dimension = 2;
  double damping = 0.25, load = 0.2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    using std::cos;
    dxdt[0] = x[1];
    dxdt[1] = load * cos(t) - damping * x[1] + x[0] - x[0] * x[0] * x[0];
  }
};

constexpr int periods = 24, steps_a_period = 160;
constexpr double period = 2 * std::numbers::pi, until = periods * period;

/// A start, and the side on which it is after all periods.
struct Start {
  double x, v;
  bool right;
};

struct Outcome {
  std::vector<Start> starts;
  int judged = 0,
      otherwise = 0;  ///< by a method of another kind: how many, and how many end on the other side
  double share = 0;   ///< of the starts that end to the right
};

ivp::State start_of(int i, int j, int side) {
  const double step = 5.0 / (side - 1);
  return {-2.5 + step * i, -2.5 + step * j};
}

Outcome compute(bool quick) {
  const int side = quick ? 21 : 101;
  std::vector<ivp::State> states;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) states.push_back(start_of(i, j, side));
  }
  const auto ends = ivp::integrate_all(ivp::System(TwoWells{}), std::span<const ivp::State>(states), 0, until,
                                       ivp::Rk4{.step = period / steps_a_period}, 1);
  Outcome o;
  for (std::size_t k = 0; k < states.size(); ++k) {
    o.starts.push_back({states[k][0], states[k][1], ends[k].x[0] > 0});
    o.share += (ends[k].x[0] > 0 ? 1.0 : 0.0) / static_cast<double>(states.size());
    if (k % 97 != 0) continue;
    const auto exact = ivp::integrate(ivp::Direct(TwoWells{}), states[k], 0, until,
                                      ivp::Ode45{.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9});
    ++o.judged;
    o.otherwise += (exact.x[0] > 0) != (ends[k].x[0] > 0) ? 1 : 0;
  }
  return o;
}

void put(const Outcome& o, scene::Show& show) {
  scene::Table data({{"line", 3, true}, {"x"}, {"v"}});
  for (const bool right : {false, true}) {
    for (const Start& s : o.starts) {
      if (s.right == right) data.add({right ? "right" : "left", s.x, s.v});
    }
  }
  scene::Plot& plot = show.plots("Blue: starts whose motion ends in the left well");
  plot.size(640, 640).data(std::move(data));
  scene::Panel& panel = plot.panel("x at t = 0", "x' at t = 0");
  panel.x_range(-2.6, 2.6).y_range(-2.6, 2.6).key("off");
  panel.columns("ends to the left", "x:v", {"points pointtype 5 pointsize 0.42", 1}, 0);
  show.at_most(
      "share of the starts that ode45 sends to the other side", static_cast<double>(o.otherwise) / o.judged,
      0.05,
      "the boundary is folded finely: what starts within the error of a run of it is decided by that error");
  show.between(
      "share of the starts that end to the right", o.share, 0.4, 0.6,
      "x and -x half a period later obey one equation: neither side is preferred, but for the phase");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcome("basin", "d = 0.25, F = 0.2; rk4, 160 steps a period, 24 periods", compute);
  return {{.name = "basin",
           .title = "Basins of an oscillator with two wells",
           .content = scene::Content(put, outcome)}};
}

}  // namespace nlmech::chapters::integrators::basin
