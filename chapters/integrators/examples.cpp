#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::integrators::examples {
namespace {

constexpr const char* independent = "two independent methods at a tolerance of 1e-13";

/// A solution at some times and its difference from an independent one at the end.
struct ExampleRun {
  std::vector<std::string> names;            ///< component names
  std::vector<double> t;                     ///< times
  std::vector<std::vector<double>> columns;  ///< values, one column per component
  /// Largest difference of the end states of two methods, relative to the largest value of the component; 0
  /// with one method.
  double difference = 0;

  /// The column of a component.
  [[nodiscard]] const std::vector<double>& operator[](const std::string& name) const {
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    return columns.at(static_cast<std::size_t>(place));
  }
};

/// The equations of chapters/integrators/examples/<name>.ode. @throws Failure if the file is not there
program::Equations example(const std::string& name) {
  const std::string file = name + ".ode";
  const auto path = scene::data_folder() / "chapters" / "integrators" / "examples" / file;
  return program::Equations(program::SourceText(file, scene::read_whole(path)));
}

/// The times at(0), at(1), ..., at(count).
template <class At>
std::vector<double> times_of(int count, const At& at) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(at(i));
  return times;
}
std::vector<double> equidistant(double end, int count) {
  return times_of(count, [=](int i) { return end * i / count; });
}

/// Integrates from the initial values of the file to each of @p times (increasing), with tolerance 1e-13 and
/// a restart at each time. @p other is empty if the end state is too ill-conditioned to compare.
/// @throws Failure if one of them fails
ExampleRun course(const program::Equations& equations, const std::vector<double>& times,
                  const std::string& method, const std::string& other) {
  const ivp::System system{program::Problem(equations)};
  const std::vector<double> x0 = program::Equations(equations).initial_state("initial state", "");
  const ivp::State begin = Eigen::Map<const Eigen::VectorXd>(x0.data(), static_cast<Eigen::Index>(x0.size()));
  const ivp::Settings settings{.tolerance = 1e-13};
  ExampleRun made{equations.state_names(), {}, std::vector<std::vector<double>>(x0.size()), 0};
  ivp::State size = begin.cwiseAbs();
  const auto go = [&](const std::string& name, bool keep) {
    const auto run = comparison::any_method(name).with(settings);
    ivp::State x = begin;
    double t = equations.initial_time().value_or(0);
    for (const double next : times) {
      const auto end = run(system, x, t, next, {}, {});
      if (!end.status.ok()) throw Failure(end.status);
      x = end.x;
      t = next;
      size = size.cwiseMax(x.cwiseAbs());
      if (!keep) continue;
      made.t.push_back(t);
      for (Eigen::Index i = 0; i < x.size(); ++i) made.columns[static_cast<std::size_t>(i)].push_back(x[i]);
    }
    return x;
  };
  const ivp::State one = go(method, true);
  if (!other.empty()) made.difference = ((one - go(other, false)).array().abs() / size.array()).maxCoeff();
  return made;
}

/// Largest deviation of a quantity from its first value, relative to @p scale, or to that value for 0.
template <class Quantity>
double drift(const ExampleRun& c, Quantity quantity, double scale = 0) {
  const double first = quantity(0U);
  double worst = 0;
  for (std::size_t i = 0; i < c.t.size(); ++i) worst = std::max(worst, std::abs(quantity(i) - first));
  return worst / (scale > 0 ? scale : std::abs(first));
}

void agree(const ExampleRun& c, double bound, scene::Show& show) {
  show.at_most("difference of two methods at the end", c.difference, bound, independent);
}

void double_pendulum(const ExampleRun& c, scene::Show& show) {
  std::vector<double> x, y;
  const auto &a = c["a"], &b = c["b"], &p = c["a'"], &q = c["b'"];
  for (std::size_t i = 0; i < c.t.size(); ++i) {
    x.push_back(std::sin(a[i]) + std::sin(b[i]));
    y.push_back(-std::cos(a[i]) - std::cos(b[i]));
  }
  show.plot("A double pendulum: where the lower bob goes in 10 s", "to the side (m)", "above the pivot (m)")
      .x_range(-2.1, 2.1)
      .y_range(-2.1, 1.1)
      .set("size ratio -1")
      .curve("", x, y);
  show.figure().size(620, 480);
  const auto energy = [&](std::size_t i) {
    return p[i] * p[i] + q[i] * q[i] / 2 + p[i] * q[i] * std::cos(a[i] - b[i]) -
           9.81 * (2 * std::cos(a[i]) + std::cos(b[i]));
  };
  show.at_most("drift of the energy, relative to 2 g l", drift(c, energy, 2 * 9.81), 1e-11,
               "it is conserved");
  agree(c, 1e-8, show);
}

void duffing_attractor(const ExampleRun& c, scene::Show& show) {
  // The first sections are the transient.
  const auto after = [](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + 20, all.end());
  };
  show.plot("Poincare section of Ueda's oscillator: a folded attractor", "{/:Italic x}", "{/:Italic x}'")
      .curve("", after(c["x"]), after(c["x'"]), {"points pointtype 7 pointsize 0.2", 1});
  show.figure().size(620, 480);
  const auto [low, high] = std::ranges::minmax(after(c["x"]));
  show.between("least position of a section", low, 0.8, 2.2,
               "Ueda's figure of the attractor: x from about 1 to 4");
  show.between("greatest position of a section", high, 3.2, 4.2, "the same");
}

void three_bodies(const ExampleRun& c, scene::Show& show) {
  show.plot("Arenstorf's orbit closes after one period", "{/:Italic x}, distances of the Moon",
            "{/:Italic y}")
      .set("size ratio -1")
      .x_range(-1.5, 2)
      .y_range(-1.4, 1.4)
      .curve("satellite", c["x"], c["y"])
      .curve("Earth", std::vector<double>{-0.012277471}, {0.0}, scene::large_points(2))
      .curve("Moon", std::vector<double>{1 - 0.012277471}, {0.0}, scene::large_points(3));
  double gap = 0;
  for (const std::string name : {"x", "y"}) gap = std::max(gap, std::abs(c[name].back() - c[name].front()));
  // Perturbations of the start grow by a factor of some 1e4 to 1e5 in a period.
  show.at_most(
      "distance from the start after one period", gap, 1e-8,
      "the orbit is closed (Hairer, Norsett and Wanner I, II.0.2); passages of the Moon multiply errors");
}

void robertson(const ExampleRun& c, scene::Show& show) {
  std::vector<double> scaled = c["b"];
  for (double& b : scaled) b *= 1e4;
  show.plot("Robertson: b rises at once, a turns to c over ten decades", "time", "concentration")
      .log_x()
      .key("at graph 0.03, graph 0.9 left")
      .curve("{/:Italic a}", c.t, c["a"])
      .curve("10^4 {/:Italic b}", c.t, scaled)
      .curve("{/:Italic c}", c.t, c["c"]);
  const auto sum = [&](std::size_t i) { return c["a"][i] + c["b"][i] + c["c"][i]; };
  show.at_most("drift of a + b + c", drift(c, sum), 1e-12, "the equations add up to 0");
  agree(c, 1e-8, show);
}

void impact(const ExampleRun& c, scene::Show& show) {
  show.plot("A driven mass rebounds from a stiff stop", "time", "position")
      .level(1, "stop")
      .curve("", c.t, c["x"]);
  show.between("greatest position", *std::ranges::max_element(c["x"]), 1.0, 1.5, "the stop is elastic");
  agree(c, 1e-8, show);
}

void friction(const ExampleRun& c, scene::Show& show) {
  show.plot("Dry friction: stick and slip", "time", "velocity of the mass")
      .level(0.2, "belt")
      .curve("", c.t, c["x'"]);
  // It sticks until the spring has the friction's strength, x = F = 1, and moves with the belt up to there.
  double stuck = 0;
  for (std::size_t i = 0; i < c.t.size(); ++i) {
    if (std::abs(c["x'"][i] - 0.2) < 1e-9) stuck = std::max(stuck, c["x"][i]);
  }
  show.between("greatest position while it sticks", stuck, 1 - 0.2 * 0.0101, 1 + 1e-9,
               "F = 1, minus the motion of the belt between two points of the figure");
  agree(c, 1e-9, show);
}

void van_der_pol(const ExampleRun& c, scene::Show& show) {
  show.plot("Van der Pol, mu = 1000: drift and jump", "time", "{/:Italic x}").curve("", c.t, c["x"]);
  agree(c, 1e-6, show);
}

void lorenz(const ExampleRun& c, scene::Show& show) {
  show.plot("Lorenz's attractor: two wings, and no period", "{/:Italic u}", "{/:Italic w}")
      .curve("", c["u"], c["w"], scene::thin_lines());
  show.figure().size(620, 480);
  agree(c, 1e-4, show);
}

void spring_pendulum(const ExampleRun& c, scene::Show& show) {
  scene::Plot& plot = show.plots("Spring pendulum: energy exchanged between spring and swing");
  plot.stacked();
  plot.panel("time (s)", "angle (rad)").curve("", c.t, c["a"]);
  plot.panel("time (s)", "stretch (m)").curve("", c.t, c["s"]);
  const double g = 9.81, k = 4 * 9.81;
  const auto energy = [&](std::size_t i) {
    const double r = 1 + c["s"][i], spring = c["s"][i] + g / k;
    return (c["s'"][i] * c["s'"][i] + r * r * c["a'"][i] * c["a'"][i] + k * spring * spring) / 2 -
           g * r * std::cos(c["a"][i]);
  };
  show.at_most("drift of the energy, relative to g l", drift(c, energy, g), 1e-12, "it is conserved");
  agree(c, 1e-9, show);
}

void loudspeaker(const ExampleRun& c, scene::Show& show) {
  scene::Plot& plot = show.plots("A loudspeaker: one equation of first order, one of second");
  plot.stacked();
  std::vector<double> ms, mm;
  for (const double t : c.t) ms.push_back(1000 * t);
  for (const double x : c["x"]) mm.push_back(1000 * x);
  plot.panel("time (ms)", "current (A)").curve("", ms, c["i"]);
  plot.panel("time (ms)", "position (mm)").curve("", ms, mm);
  agree(c, 1e-9, show);
}

/// A shipped .ode file with its figure.
struct Drawn {
  const char* name;
  const char* title;
  std::vector<double> times;
  const char *method, *other;
  void (*put)(const ExampleRun&, scene::Show&);
};

}  // namespace

std::vector<scene::Scene> scenes() {
  const std::vector<Drawn> all = {
      {"double-pendulum", "A double pendulum, coupled in its accelerations", equidistant(10, 1000), "series",
       "adaptive-collocation", double_pendulum},
      {"duffing-attractor", "Sections of Ueda's oscillator",
       times_of(4000, [](int i) { return 2 * std::numbers::pi * i; }), "series", "", duffing_attractor},
      {"three-bodies", "A closed orbit of the restricted three bodies",
       equidistant(17.0652165601579625588917206249, 1500), "series", "odeint-fehlberg78", three_bodies},
      {"robertson", "A stiff reaction", times_of(160, [](int i) { return 1e-5 * std::pow(1e16, i / 160.); }),
       "adaptive-collocation", "cvode-bdf", robertson},
      {"impact", "A one-sided stop: max", equidistant(60, 1500), "series", "adaptive-collocation", impact},
      {"friction", "Stick-slip friction: sign", equidistant(30, 3000), "series", "ode45", friction},
      {"van-der-pol", "A relaxation oscillation", equidistant(3000, 1500), "adaptive-collocation",
       "odeint-rosenbrock4", van_der_pol},
      {"lorenz", "Lorenz's attractor", equidistant(25, 2500), "series", "odeint-fehlberg78", lorenz},
      {"spring-pendulum", "A spring pendulum in resonance", equidistant(60, 1500), "series",
       "adaptive-collocation", spring_pendulum},
      {"loudspeaker", "A voice coil: orders one and two", equidistant(0.1, 1000), "series",
       "adaptive-collocation", loudspeaker}};
  std::vector<scene::Scene> scenes;
  for (const Drawn& d : all) {
    const scene::Result result(
        d.name, std::string("examples/") + d.name + ".ode by " + d.method + ", tolerance 1e-13",
        [d](bool quick) {
          std::vector<double> times = d.times;
          if (quick && std::string(d.other).empty()) times.resize(300);
          return course(example(d.name), times, d.method, d.other);
        });
    scenes.push_back({.name = d.name, .title = d.title, .content = scene::Content(d.put, result)});
  }
  return scenes;
}

}  // namespace nlmech::chapters::integrators::examples
