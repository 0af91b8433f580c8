#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::symmetry {
namespace {

constexpr double end = 600, step = 0.1, window = 20;
const ivp::State begin{1, 0}, inside{1, 0.3};

/// The free oscillator x'' + x + x^3 = 0.
problems::TextProblem free_oscillator() { return problems::TextProblem("driven-duffing", {{"force", 0}}); }

double energy(const ivp::State& x) { return (x[1] * x[1] + x[0] * x[0]) / 2 + std::pow(x[0], 4) / 4; }

/// Long run of a method.
struct Long {
  std::string name;
  std::vector<double> errors;  ///< largest relative energy error in each time window
  double back = 0;             ///< distance from the start after integration to t = 60 and back
  double area = 0;             ///< determinant of the Jacobian of one block's map, minus 1

  [[nodiscard]] double greatest() const { return *std::max_element(errors.begin(), errors.end()); }
  /// Largest energy error of the last third over that of the first: 1 without drift, 3 for linear drift.
  [[nodiscard]] double growth() const {
    const auto third = static_cast<std::ptrdiff_t>(errors.size() / 3);
    return *std::max_element(errors.end() - third, errors.end()) /
           *std::max_element(errors.begin(), errors.begin() + third);
  }
};

ivp::State after(const ivp::NamedIntegrator& method, const ivp::State& x, double t0, double t1) {
  return method(ivp::System(free_oscillator()), x, t0, t1, {}, {}).x;
}

Long long_run(const std::string& name, const ivp::NamedIntegrator& method, int block) {
  Long l{name, {}, 0, 0};
  const Course c = course(free_oscillator(), begin, end, method, nullptr);
  const double first = energy(begin);
  l.errors.assign(static_cast<std::size_t>(end / window), 0);
  // Only the ends of blocks; points within a block have only order p + 1.
  for (std::size_t i = 0; i < c.points.size(); i += static_cast<std::size_t>(block)) {
    const Point& p = c.points[i];
    const auto bin = std::min(static_cast<std::size_t>(p.t / window), l.errors.size() - 1);
    l.errors[bin] = std::max(l.errors[bin], std::abs(energy(p.x) / first - 1));
  }
  l.back = (after(method, after(method, begin, 0, 60), 60, 0) - begin).cwiseAbs().maxCoeff();
  Eigen::Matrix2d map;
  constexpr double change = 1e-5;  // central differences: truncation and rounding errors of 1e-10
  for (int i = 0; i < 2; ++i) {
    const ivp::State d = change * ivp::State::Unit(2, i);
    map.col(i) = (after(method, inside + d, 0, block * step) - after(method, inside - d, 0, block * step)) /
                 (2 * change);
  }
  l.area = map.determinant() - 1;
  return l;
}

std::vector<Long> all_runs() {
  std::vector<Long> all;
  for (int p = 1; p <= 5; ++p) all.push_back(long_run(fmt::format("p = {}", p), mtl(step, p), p));
  all.push_back(long_run("rk4", classical("rk4", step), 1));
  all.push_back(long_run("rk6", classical("rk6", step), 1));
  return all;
}

void put(const std::vector<Long>& all, scene::Show& show) {
  scene::Panel& panel =
      show.plot("Energy error: no drift of MTL, which is symmetric in time; rk4 and rk6 drift", "time",
                "relative error of the energy");
  panel.x_range(0, end).log_y(1e-8, 1e-1).key("outside right center");
  show.figure().columns({"series", "t", "error"});
  std::vector<double> middles;
  for (std::size_t i = 0; i < all[0].errors.size(); ++i)
    middles.push_back((static_cast<double>(i) + 0.5) * window);
  for (const Long& l : all) panel.curve(l.name, middles, l.errors, scene::linespoints());
  show.table(all, {{"method", &Long::name},
                   {"greatest relative error of the energy", &Long::greatest, 2},
                   {"last third over first", &Long::growth},
                   {"there and back", &Long::back, 1},
                   {"determinant - 1", &Long::area, 2}});
  const double energies[] = {1.4e-3, 3.8e-5, 4.4e-5, 4.8e-6, 2.3e-6}, areas[] = {-2.0e-4, -2.5e-6, -1.3e-6};
  const char* recorded = "regression value, two digits";
  for (std::size_t i = 0; i < 5; ++i) {
    show.near("error of the energy, " + all[i].name, all[i].greatest(), energies[i], 0.04, recorded);
    show.between("growth of that error, " + all[i].name, all[i].growth(), 0.95, 1.05,
                 "a symmetric method on a reversible oscillator: no drift");
    show.at_most("there and back, " + all[i].name, all[i].back, 1e-11,
                 "roundings of 1200 steps, 2e-16 each, growing linearly with time");
  }
  for (std::size_t i = 0; i < 3; ++i)
    show.near("determinant of a block less 1, " + all[i].name, all[i].area, areas[i], 0.04,
              "tools/oracles/transversal_motions.py, two digits");
  show.between("growth of the error of the energy, rk4", all[5].growth(), 2.5, 3.5,
               "a drift, linear in time: three times the first third's");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result runs(
      "long-runs", "x'' + x + x^3 = 0 from (1, 0), h = 0.1, to t = 600; K = 1; the determinant at (1, 0.3)",
      all_runs);
  return {{.name = "symmetry",
           .title = "Energy error over a long time, area in the phase plane, reversed runs",
           .content = scene::Content(put, runs)}};
}

}  // namespace nlmech::chapters::transversal::symmetry
