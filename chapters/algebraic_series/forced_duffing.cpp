#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

struct Motions {
  std::vector<Sample<2>> printed, accurate;  ///< every twentieth to t = 100
  Departure departure;                       ///< of the printed steps, to t = 100
};

Motions move() {
  const auto& c = forced_duffing_example();
  const auto printed = published_series(0.35, 20);
  return {sampled<2>(c.system, c.x0, 0, 100, printed, 0.05),
          sampled<2>(c.system, c.x0, 0, 100, accurate_series(), 0.05), departure(c, printed, 100)};
}

scene::Table data_of(const Motions& m, double end) {
  scene::Table data({{"tau"}, {"u"}, {"v"}, {"u_printed"}, {"v_printed"}});
  for (std::size_t i = 0; i < m.accurate.size() && m.accurate[i].t <= end + 1e-9; ++i) {
    const auto &x = m.accurate[i].x, &y = m.printed[i].x;
    data.add({m.accurate[i].t / 0.35, x[0], x[1], y[0], y[1]});
  }
  return data;
}

scene::Showing show_time(const Motions& m) {
  scene::Showing showing;
  showing.figure = {data_of(m, 50),
                    "algebraic_series-duffing-time",
                    {{"heading", "Forced Duffing oscillator: the printed steps are right to the eye"}}};
  const Sample<2>&half = m.accurate.at(1000), &full = m.accurate.back();
  // oracle: algebraic_series_motions Duffing u(*, Duffing v(*, Duffing T = 0.35: greatest error, Duffing T =
  // 0.35: above 1e-3 from
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding grows to 1e-11 on the way";
  showing.quantities = {
      scene::near("u(50)", "1", half.x[0], 1.221946638567542, 1e-10, known),
      scene::near("u'(50)", "1", half.x[1], 5.565479787665349, 1e-10, known),
      scene::near("u(100)", "1", full.x[0], 0.694891370844674, 1e-8, known),
      scene::near("u'(100)", "1", full.x[1], 3.554260292257302, 1e-8, known),
      scene::near("greatest error of the printed steps to t = 100", "1", m.departure.greatest(100), 0.63,
                  0.01, "tools/oracles/algebraic_series_motions.py: 0.63; half a unit of its last digit"),
      scene::near("time at which the printed steps err by more than 1e-3", "1",
                  m.departure.first_above(1e-3).value_or(NAN), 1.75, 1e-9,
                  "tools/oracles/algebraic_series_motions.py: the fifth step")};
  return showing;
}

scene::Showing show_phase(const Motions& m) {
  scene::Showing showing;
  showing.figure = {data_of(m, 100),
                    "algebraic_series-duffing-phase",
                    {{"heading", "Its phase plane: bounded, and never twice the same way"},
                     {"width", "620"},
                     {"height", "600"}}};
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const auto& s : m.accurate) {
    least = std::min(least, s.x[0]);
    most = std::max(most, s.x[0]);
  }
  // oracle: algebraic_series_motions Duffing least, Duffing greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.05 miss a peak by 0.02 or less";
  showing.quantities = {scene::near("least u", "1", least, -3.354, 0.006, known),
                        scene::near("greatest u", "1", most, 3.344, 0.006, known)};
  return showing;
}

/// The oscillator beside the linear equations of a small distance from its motion.
struct WithDistance {
  static constexpr int dimension = 4;
  problems::ForcedDuffing duffing;

  template <class T>
  void operator()(const T& t, const Vector<T, 4>& x, Vector<T, 4>& dxdt) const {
    Vector<T, 2> state(x[0], x[1]), slope;
    duffing(t, state, slope);
    dxdt[0] = slope[0];
    dxdt[1] = slope[1];
    dxdt[2] = x[3];
    dxdt[3] = -duffing.damping * x[3] - 3 * duffing.hardening * (x[0] * x[0] * x[2]);
  }
};

struct Starts {
  std::vector<Sample<2>> near;  ///< from (3.1, 4.1), every twentieth to t = 100
  std::vector<double> apart;    ///< distance in the plane of u and u' from the motion from (3, 4)
  double growth;                ///< ln of the factor by which a small distance grows to t = 100
};

Starts start_nearby(const Motions& m) {
  const auto& c = forced_duffing_example();
  Starts starts{sampled<2>(c.system, {3.1, 4.1}, 0, 100, accurate_series(), 0.05), {}, 0};
  for (std::size_t i = 0; i < starts.near.size(); ++i)
    starts.apart.push_back((starts.near[i].x - m.accurate[i].x).norm());
  const ivp::State<4> x0 = {3, 4, 1, 1};
  const auto end = ivp::integrate(ivp::System<4>(WithDistance{}), x0, 0, 100, accurate_series());
  if (!end.status.ok()) throw Failure(end.status);
  starts.growth = std::log(end.x.tail<2>().norm() / x0.tail<2>().norm());
  return starts;
}

scene::Showing show_starts(const Motions& m, const Starts& starts) {
  scene::Table data({{"t"}, {"u"}, {"u_near"}, {"distance"}});
  double first_above_1 = NAN, greatest = 0;
  for (std::size_t i = 0; i <= 1000; ++i) {
    data.add({m.accurate[i].t, m.accurate[i].x[0], starts.near[i].x[0], starts.apart[i]});
    greatest = std::max(greatest, starts.apart[i]);
    if (std::isnan(first_above_1) && starts.apart[i] > 1) first_above_1 = m.accurate[i].t;
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data),
      "algebraic_series-duffing-starts",
      {{"heading", "Forced Duffing oscillator: starts 0.14 apart part within one period of the load"}}};
  const Sample<2>&half = starts.near.at(1000), &full = starts.near.back();
  // oracle: algebraic_series_starts
  const char* known =
      "tools/oracles/algebraic_series_starts.py; rounding grows by e^8 to t = 100, some more between";
  showing.quantities = {
      scene::near("u(50) from (3.1, 4.1)", "1", half.x[0], 1.254152050872493, 1e-10, known),
      scene::near("u'(50) from (3.1, 4.1)", "1", half.x[1], 0.9521933087271156, 1e-10, known),
      scene::near("u(100) from (3.1, 4.1)", "1", full.x[0], 0.2992477399516473, 1e-8, known),
      scene::near("u'(100) from (3.1, 4.1)", "1", full.x[1], 2.943136901297957, 1e-8, known),
      scene::near("distance at t = 0", "1", starts.apart.front(), std::sqrt(0.02), 1e-12, "0.1 in both"),
      scene::near("distance at t = 50", "1", starts.apart[1000], 4.61340, 1e-5, known),
      scene::near("greatest distance to t = 50", "1", greatest, 8.06175, 1e-5, known),
      scene::near("time at which the distance exceeds 1", "1", first_above_1, 5.50, 1e-9, known),
      scene::near("ln of the growth of a small distance to t = 100", "1", starts.growth, 8.33467, 1e-5,
                  known)};
  return showing;
}

}  // namespace

void add_forced_duffing(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Motions>(
      "forced-duffing",
      "T = 0.35 and N = 20 as printed, beside order and steps by the radius of convergence; the figure's end "
      "is not printed: 50 in time, 100 in the phase plane",
      {}, [](Workshop&) { return move(); });
  chapter.add({.name = "fig-4a",
               .title = "Forced Duffing oscillator: displacement in time",
               .place = "Figure 4a",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_time(w.result(run)); }});
  chapter.add({.name = "fig-4b",
               .title = "Forced Duffing oscillator: phase plane",
               .place = "Figure 4b",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_phase(w.result(run)); }});
  const auto& starts =
      chapter.add_run<Starts>("forced-duffing-starts", "from u = 3.1, u' = 4.1, to t = 100", {&run},
                              [&run](Workshop& w) { return start_nearby(w.result(run)); });
  chapter.add(
      {.name = "duffing-starts",
       .title = "Forced Duffing oscillator from (3, 4) and from (3.1, 4.1)",
       .place = "our own",
       .needs = {&run, &starts},
       .show = [&run, &starts](Workshop& w) { return show_starts(w.result(run), w.result(starts)); }});
}

}  // namespace nlmech::chapters
