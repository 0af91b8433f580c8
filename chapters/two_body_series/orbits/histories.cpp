#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/published_runs.hpp"

namespace nlmech::chapters::two_body_series::histories {
namespace {

double greatest(const EnergyRecord& record) { return std::ranges::max(record.error); }

/// Adds the largest error of each twenty-fifth of an orbit with its time, the resolution of the figure.
void add_curve(scene::Table& data, int number, const EnergyRecord& record, double period) {
  const double bin = period / 25;
  const auto bin_of = [&](std::size_t k) { return static_cast<int>(record.t[k] / bin - 1e-9); };
  std::size_t best = 0;
  for (std::size_t i = 1; i <= record.t.size(); ++i) {
    if (i == record.t.size() || bin_of(i) != bin_of(best)) {
      data.add({number, record.t[best] / period, record.error[best]});
      best = i;
    } else if (record.error[i] > record.error[best]) {
      best = i;
    }
  }
}

/// Fraction of the points with an energy error of exactly 0.
double share_of_zeros(const EnergyRecord& record) {
  return static_cast<double>(std::ranges::count(record.error, 0.0)) /
         static_cast<double>(record.error.size());
}

/// The drawn records, in this order.
struct Records {
  const EnergyRecord &ode45, &series, &f_and_g, &rkn1210;
};

/// Draws the errors; those of exactly 0 are drawn at 2e-17 on the logarithmic axis.
void draw(const Records& r, const Orbit& orbit, scene::Show& show) {
  scene::Panel& panel = show.plot(
      fmt::format("{} energy error: ode45 to {}, Analytic-Cont to {}, others at rounding", orbit.name,
                  scene::format_number(greatest(r.ode45), 1), scene::format_number(greatest(r.series), 1)),
      "orbits", "|{/:Italic E}_k − {/:Italic E}_0|/|{/:Italic E}_0|");
  panel.x_range(0, 20).log_y(1e-17, std::pow(10, std::ceil(std::log10(greatest(r.ode45)))));
  panel.set("ytics 1e-16,100").set("ytics add ('0' 2e-17)").set("title offset 0,1.4");
  panel.set("margins screen 0.13, screen 0.97, screen 0.13, screen 0.83");
  panel.key("at screen 0.545, screen 0.9 center top horizontal maxrows 1 samplen 2.5 width -3");
  scene::Table data({{"curve", 3, true}, {"orbit"}, {"error"}});
  int number = 0;
  const auto add = [&](const char* name, const EnergyRecord& record, const scene::CurveStyle& look) {
    panel.columns(name, "orbit:(column('error') > 0 ? column('error') : 2e-17)", look, number);
    add_curve(data, ++number, record, period_of(orbit));
  };
  add("ode45", r.ode45, {"lines dashtype solid linewidth 1.6", 5});
  add("Analytic-Cont", r.series, {"lines linewidth 1.6", 1});
  add("F and G", r.f_and_g, {"points pointtype 7 pointsize 0.28", 4});
  add("RKN12(10)", r.rkn1210, {"points pointtype 5 pointsize 0.28", 2});
  show.figure().data(std::move(data));
}

void check(const Records& r, const Orbit& orbit, scene::Show& show) {
  const auto at_rounding = [&](Propagator p, const EnergyRecord& record, double most, const char* reason) {
    const std::string name = name_of(p);
    show.at_most("greatest energy error of " + name, greatest(record), most, reason);
    show.between("share of points at which " + name + " errs by 0", share_of_zeros(record), 0, 0.3,
                 "errors of a few eps: now and then the nearest double is the same");
  };
  at_rounding(Propagator::f_and_g, r.f_and_g, 2e-12, "eps t/G in Lagrange's G with t up to 20 orbits");
  at_rounding(Propagator::rkn1210, r.rkn1210, 1e-13, "rounding of some thousand steps, 2 eps each by chance");
  // For errors that grow linearly over 500 or 2000 points, the last error is sqrt(3/points) times the norm.
  // It oscillates by less than a factor of three.
  const auto by_norm = [&](const char* name, const EnergyRecord& record, double norm) {
    const double last = norm * std::sqrt(3. / (orbit.steps * 20));
    show.between(std::string("greatest energy error of ") + name, greatest(record), last / 3, 3 * last,
                 "the regression value of the norm over points whose errors grow with time");
  };
  const bool low = orbit.order == low_orbit().order;
  by_norm("Analytic-Cont", r.series, low ? 1.19e-7 : 1.02e-11);
  by_norm("ode45", r.ode45, low ? 9.42e-5 : 1.44e-3);
}

scene::Scene history(const Orbit& orbit, const std::string& number) {
  const auto put = [orbit](const EnergyRecord& ode45, const EnergyRecord& series, const EnergyRecord& f_and_g,
                           const EnergyRecord& rkn1210, scene::Show& show) {
    const Records records{ode45, series, f_and_g, rkn1210};
    draw(records, orbit, show);
    check(records, orbit, show);
  };
  const auto over_20 = [&](Propagator p) { return followed(orbit, 20, p); };
  return {.name = "fig-" + number,
          .title = fmt::format("{}: relative energy error over 20 orbits", orbit.name),
          .place = "Figure " + number,
          .content = scene::Content(put, over_20(Propagator::ode45), over_20(Propagator::series),
                                    over_20(Propagator::f_and_g), over_20(Propagator::rkn1210))};
}

}  // namespace

std::vector<scene::Scene> scenes() { return {history(low_orbit(), "3.22"), history(high_orbit(), "3.23")}; }

}  // namespace nlmech::chapters::two_body_series::histories
