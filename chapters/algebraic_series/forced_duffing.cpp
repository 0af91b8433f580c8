#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::forced_duffing {
namespace {

constexpr double T = 0.35, t_end = 100, dt = 0.05;
constexpr std::size_t N = 20;

/// Coefficients a_0 to a_N of u in powers of t - t0 by (69), from u and u' at t0.
std::vector<double> coefficients(double t0, const ivp::State& x) {
  std::vector<double> a = {x[0], x[1]}, square, cosine = {std::cos(t0)}, sine = {std::sin(t0)};
  for (std::size_t i = 0; i + 2 <= N; ++i) {
    const auto k = static_cast<double>(i);
    const auto product = [i](const std::vector<double>& p, const std::vector<double>& q) {
      double sum = 0;
      for (std::size_t j = 0; j <= i; ++j) sum += p[j] * q[i - j];
      return sum;
    };
    square.push_back(product(a, a));
    const double cube = product(square, a);
    a.push_back((7.5 * cosine[i] - 0.05 * (k + 1) * a[i + 1] - cube) / ((k + 1) * (k + 2)));
    cosine.push_back(-sine[i] / (k + 1));
    sine.push_back(cosine[i] / (k + 1));
  }
  return a;
}

/// u by the series, and u' by its derivative (57) with one term less.
ivp::State at(const std::vector<double>& a, double x) {
  double u = 0, v = 0;
  for (std::size_t k = a.size(); k-- > 0;) {
    v = v * x + u;
    u = u * x + a[k];
  }
  return ivp::State{{u, v}};
}

/// Solution and printed steps by (56), (57) and (69).
Motion compute() {
  const auto& c = forced_duffing_example();
  Motion m{{}, {.status = "success", .t = {}, .error = {}}};
  const auto exact = sampled(c.system, c.x0, c.t0, t_end, accurate_series(), dt);
  ivp::State x = c.x0;
  std::size_t sample = 0;
  for (int step = 0; sample < exact.size(); ++step) {
    const double t0 = step * T, t1 = (step + 1) * T;
    const std::vector<double> a = coefficients(t0, x);
    for (; sample < exact.size() && exact[sample].t <= t1; ++sample)
      m.path.push_back({exact[sample].t, exact[sample].x, at(a, exact[sample].t - t0)});
    x = at(a, T);
    if (t1 > t_end) break;
    m.departure.t.push_back(t1);
    m.departure.error.push_back((x - c.reference(t1).cast<double>()).cwiseAbs().maxCoeff());
  }
  return m;
}

scene::Table data_of(const Motion& m, double end) {
  const auto inside = m.path | std::views::take_while([end](const Both& b) { return b.t <= end + 1e-9; });
  return scene::table_of(inside, {{"tau", [](const Both& b) { return b.t / 0.35; }},
                                  {"u", Exact{0}},
                                  {"v", Exact{1}},
                                  {"u_printed", Printed{0}},
                                  {"v_printed", Printed{1}}});
}

void put_time(const Motion& m, scene::Show& show) {
  scene::Plot& plot = show.plots(
      "Forced Duffing: displacement; error of the printed steps above 0.1 before {/:Italic t} = 40");
  plot.stacked({4, 3}).data(data_of(m, 50));
  plot.panel("", "{/:Italic u}").x_range(0, 143).columns("", "tau:u", {"lines linewidth 1.6", 1});
  plot.panel("{/:Italic τ} = {/:Italic t}/{/:Italic T}, {/:Italic T} = 0.35", "error, printed steps")
      .x_range(0, 143)
      .log_y(1e-9, 10)
      .columns("", "tau:(abs(column('u_printed') - column('u')) + 1e-12)",
               {"lines dashtype solid linewidth 1.2", 5});
  const ivp::State &half = m.path.at(1000).exact, &full = m.path.back().exact;
  // oracle: algebraic_series_motions Duffing u(*, Duffing v(*, Duffing T = 0.35: greatest error*
  // oracle: algebraic_series_motions Duffing T = 0.35: above 1e-3 from
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding grows to 1e-11 by then";
  show.near("u(50)", half[0], 1.221946638567542, 1e-10, known);
  show.near("u'(50)", half[1], 5.565479787665349, 1e-10, known);
  show.near("u(100)", full[0], 0.694891370844674, 1e-8, known);
  show.near("u'(100)", full[1], 3.554260292257302, 1e-8, known);
  const char* oracle =
      "tools/oracles/algebraic_series_motions.py, its digits; rounding grows to 1e-11 by then";
  show.near("greatest error of the printed steps to t = 100", m.departure.greatest(100), 4.32, 0.002, oracle);
  show.near("greatest error of the printed steps to t = 50", m.departure.greatest(50), 0.519, 0.002, oracle);
  double greatest = 0;
  for (const Both& b : m.path)
    if (b.t <= 50) greatest = std::max(greatest, std::abs(b.printed[0] - b.exact[0]));
  show.between("greatest error of u by the printed steps to t = 50", greatest, 0.1, 0.2,
               "0.124 at the ends of steps by tools/oracles/algebraic_series_motions.py; more within them");
  show.near("time at which the printed steps err by more than 1e-3",
            m.departure.first_above(1e-3).value_or(NAN), 0.35, 1e-9,
            "tools/oracles/algebraic_series_motions.py: the first step");
}

void put_phase(const Motion& m, scene::Show& show) {
  show.plot("Forced Duffing: phase plane, bounded and aperiodic", "{/:Italic u}",
            "d{/:Italic u}/d{/:Italic t}")
      .x_range(-4, 4)
      .y_range(-7, 7)
      .columns("", "u:v", {"lines linewidth 1.2", 1});
  show.figure().size(620, 600).data(data_of(m, 100));
  const auto [least, most] = std::ranges::minmax(m.path | std::views::transform(Exact{0}));
  // oracle: algebraic_series_motions Duffing least, Duffing greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.05 miss a peak by 0.02 or less";
  show.near("least u", least, -3.354, 0.006, known);
  show.near("greatest u", most, 3.344, 0.006, known);
}

/// The oscillator with its variational equation for a small distance d.
constexpr const char* with_distance = "u'' = 7.5 cos(t) - 0.05 u' - u^3; d'' = -0.05 d' - 3 (u^2 d)";

/// Motions from (3, 4) and (3.1, 4.1) at one time.
struct Pair {
  double t, u, u_near;
  double apart;  ///< distance in the phase plane (u, u')
};

struct Starts {
  std::vector<Pair> pairs;  ///< every 0.05 to t = 100
  ivp::State half, full;    ///< states at t = 50 and 100 of the motion from (3.1, 4.1)
  double growth;            ///< ln of the growth factor of a small distance from t = 0 to 100
};

Starts start_nearby(const Motion& m) {
  const auto& c = forced_duffing_example();
  const auto near = sampled(c.system, {3.1, 4.1}, 0, 100, accurate_series(), 0.05);
  Starts starts{{}, near.at(1000).x, near.back().x, 0};
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Both& b = m.path[i];
    starts.pairs.push_back({b.t, b.exact[0], near[i].x[0], (near[i].x - b.exact).norm()});
  }
  const program::Problem both(program::Equations({"with distance", with_distance}));
  const auto end =
      ivp::integrate(ivp::System(both), {3, 1, 4, 1}, 0, 100, accurate_series());  // u, d, u', d'
  if (!end.status.ok()) throw Failure(end.status);
  starts.growth = std::log(std::hypot(end.x[1], end.x[3]) / std::sqrt(2.0));
  return starts;
}

void put_starts(const Starts& starts, scene::Show& show) {
  const auto to_50 = starts.pairs | std::views::take(1001);
  scene::Plot& plot = show.plots("Forced Duffing: motions from starts 0.14 apart separate within one period");
  plot.stacked({5, 3}).data(scene::table_of(
      to_50, {{"t", &Pair::t}, {"u", &Pair::u}, {"u_near", &Pair::u_near}, {"distance", &Pair::apart}}));
  plot.panel("", "{/:Italic u}")
      .x_range(0, 50)
      .y_range(-4, 6)
      .key("top right horizontal samplen 2")
      .columns("from (3, 4)", "t:u", {"lines linewidth 1.6", 1})
      .columns("from (3.1, 4.1)", "t:u_near", {"lines linewidth 1.6", 5});
  plot.panel("{/:Italic t}", "distance")
      .x_range(0, 50)
      .log_y(0.05, 20)
      .columns("", "t:distance", {"lines linewidth 1.2", 1});
  // oracle: algebraic_series_starts
  const char* known =
      "tools/oracles/algebraic_series_starts.py; rounding grows by e^8 to t = 100, some more between";
  show.near("u(50) from (3.1, 4.1)", starts.half[0], 1.254152050872493, 1e-10, known);
  show.near("u'(50) from (3.1, 4.1)", starts.half[1], 0.9521933087271156, 1e-10, known);
  show.near("u(100) from (3.1, 4.1)", starts.full[0], 0.2992477399516473, 1e-8, known);
  show.near("u'(100) from (3.1, 4.1)", starts.full[1], 2.943136901297957, 1e-8, known);
  show.near("distance at t = 0", starts.pairs[0].apart, std::sqrt(0.02), 1e-12, "0.1 in both");
  show.near("distance at t = 50", starts.pairs[1000].apart, 4.61340, 1e-5, known);
  show.near("greatest distance to t = 50", std::ranges::max(to_50, {}, &Pair::apart).apart, 8.06175, 1e-5,
            known);
  const auto above = std::ranges::find_if(to_50, [](const Pair& p) { return p.apart > 1; });
  show.near("time at which the distance exceeds 1", above == to_50.end() ? NAN : above->t, 5.50, 1e-9, known);
  show.near("ln of the growth of a small distance to t = 100", starts.growth, 8.33467, 1e-5, known);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("forced-duffing",
                             "T = 0.35 and N = 20 as printed, u by (69) and u' by the derivative of its "
                             "series (57), beside order and "
                             "steps by the radius of convergence; the figure's end "
                             "is not printed: 50 in time, 100 in the phase plane",
                             compute);
  const scene::Result starts("forced-duffing-starts", "from u = 3.1, u' = 4.1, to t = 100", start_nearby,
                             result);
  return {{.name = "fig-4a",
           .title = "Forced Duffing oscillator: displacement in time",
           .place = "Figure 4a",
           .content = scene::Content(put_time, result)},
          {.name = "fig-4b",
           .title = "Forced Duffing oscillator: phase plane",
           .place = "Figure 4b",
           .content = scene::Content(put_phase, result)},
          {.name = "duffing-starts",
           .title = "Forced Duffing oscillator from (3, 4) and from (3.1, 4.1)",
           .content = scene::Content(put_starts, starts)}};
}

}  // namespace nlmech::chapters::algebraic_series::forced_duffing
