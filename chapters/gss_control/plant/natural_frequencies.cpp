#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"

namespace nlmech::chapters::gss_control::natural_frequencies {
namespace {

constexpr int ten = 10;
using Ten = std::array<double, ten>;

// Poles and hub-locked frequencies, 13 digits. oracle: gss_control_plant * pole *, * locked *
constexpr Ten bare_poles = {12.85700141881, 72.75595661757, 202.3917222511, 396.146445565,  654.6049452155,
                            977.6991513854, 1365.424532083, 1817.777712238, 2334.757073177, 2916.361705513};
constexpr Ten tip_poles = {6.452959965749, 52.08177896598, 156.1145680847, 297.5963940072, 466.7083006532,
                           697.9022473906, 1006.323399114, 1386.371948014, 1834.27051019,  2348.423457947};
constexpr Ten bare_zeros = {11.51094878903, 72.13788468598, 201.988165951,  395.816189037,  654.3125215595,
                            977.42960858,   1365.170290015, 1817.534409283, 2334.521974614, 2916.13298559};
constexpr Ten tip_zeros = {4.372658473946, 51.39836909583, 155.7182855807, 297.3174784595, 466.4585312923,
                           697.6424805754, 1006.066778865, 1386.123663541, 1834.030353588, 2348.190198895};

double worst(const std::vector<double>& computed, const Ten& reference) {
  double error = computed.size() == reference.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < reference.size() && i < computed.size(); ++i)
    error = std::max(error, std::abs(computed[i] / reference.at(i) - 1));
  return error;
}

/// Discretisation with the style of its curve.
struct Drawn {
  const char* legend;
  int style;
  bool elements;
  int size;
};
constexpr std::array drawn = {Drawn{"10 assumed modes", 1, false, 10},
                              Drawn{"40 assumed modes", 2, false, 40}, Drawn{"5 elements", 4, true, 5},
                              Drawn{"20 elements", 5, true, 20}};

Eigen::VectorXd frequencies(const spacecraft::Parameters& p, const Drawn& d) {
  return diagonalise(d.elements ? spacecraft::finite_elements(p, d.size)
                                : spacecraft::assumed_modes(p, d.size))
      .omega;
}

/// Mode with its pole, hub-locked frequency and relative errors of the poles of the discretisations.
struct Mode {
  const char* model;
  int number;
  double pole, locked;
  std::array<double, drawn.size()> error;
};

/// Column of the errors of a discretisation.
scene::ColumnOf<Mode> errors_of(const std::string& heading, std::size_t k) {
  return {heading, [k](const Mode& m) { return m.error.at(k); }, 2};
}

/// Spacecraft with or without tip bodies.
struct Model {
  const char* name;
  spacecraft::Parameters craft;
  std::vector<double> poles, locked;
  std::vector<Mode> modes;

  explicit Model(bool tip) : name(tip ? "with tips" : "no tips"), craft(gss_control::craft(tip)) {
    const spacecraft::Plant plant(craft);
    poles = spacecraft::poles(plant, ten).omega;
    locked = spacecraft::hub_zeros(plant, ten).omega;
    for (std::size_t i = 0; i < ten; ++i)
      modes.push_back({name, static_cast<int>(i) + 1, poles.at(i), locked.at(i), {}});
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      const Eigen::VectorXd found = frequencies(craft, drawn.at(k));
      for (Mode& m : modes) m.error.at(k) = found[m.number - 1] / m.pole - 1;
    }
  }
};

void draw(const std::array<Model, 2>& both, scene::Show& show) {
  scene::Plot& plot =
      show.plots("Errors of the poles: with tips assumed modes stall at percents, elements converge");
  plot.stacked().size(760, 600).columns({"curve", "panel", "x", "y"});
  for (const Model& model : both) {
    scene::Panel& panel = plot.panel("number of the mode", fmt::format("relative error, {}", model.name));
    panel.x_range(0.5, 10.5).log_y(1e-9, 1).key("bottom right maxrows 2");
    for (std::size_t k = 0; k < drawn.size(); ++k)
      panel.curve(
          &model == &both.front() ? drawn.at(k).legend : "", model.modes, &Mode::number,
          [k](const Mode& m) { return std::max(1e-9, std::abs(m.error.at(k))); },
          scene::linespoints(drawn.at(k).style));
  }
}

void check(const Model& model, const Ten& known_poles, const Ten& known_locked, double tenth, double digit,
           scene::Show& show) {
  const std::string of = std::string(", ") + model.name;
  const char* reason = "tools/oracles/gss_control_plant.py, 13 digits";
  show.at_most("largest relative difference of a pole" + of, worst(model.poles, known_poles), 1e-12, reason);
  show.at_most("largest relative difference of a hub-locked frequency" + of,
               worst(model.locked, known_locked), 1e-12, reason);
  show.near("first pole" + of, {model.poles[0], "rad/s"}, known_poles[0], 1e-12, reason);
  show.near("second pole" + of, {model.poles[1], "rad/s"}, known_poles[1], 1e-12, reason);
  show.between("error of mode 10 by ten assumed modes" + of, model.modes[9].error[0], tenth - digit,
               tenth + digit, "tools/oracles/gss_control_plant.py, two digits");
  if (model.craft.tip_mass > 0) {
    double upper = 0;
    for (const Mode& m : model.modes | std::views::drop(3)) upper = std::max(upper, m.error[1]);
    show.between("largest error of modes 4 to 10 by 40 assumed modes" + of, upper, 0.03, 0.05,
                 "such modes bend no tip body, and converge like 1/N: some percents with 40");
  }
  // Cubic Hermite elements: relative frequency errors grow like (q h)^4/1440, with wave number q and element
  // length h.
  const spacecraft::Parameters& p = model.craft;
  const double q =
      std::sqrt(model.poles[9] / std::sqrt(p.bending_stiffness() / p.mass_per_length)) * p.length / 20;
  show.between("error of mode 10 by 20 elements" + of, model.modes[9].error[3], 0.5 * std::pow(q, 4) / 1440,
               2 * std::pow(q, 4) / 1440,
               "dispersion of a long beam of Hermite's cubics, (q h)^4/1440, within a factor 2");
}

void put(scene::Show& show) {
  const std::array both = {Model(false), Model(true)};
  draw(both, show);
  std::vector<Mode> rows = both[0].modes;
  rows.insert(rows.end(), both[1].modes.begin(), both[1].modes.end());
  show.table(rows, {{"model", &Mode::model},
                    {"mode", &Mode::number},
                    {"pole (rad/s)", &Mode::pole, 13},
                    {"hub-locked (rad/s)", &Mode::locked, 13},
                    errors_of("10 assumed modes, relative error", 0),
                    errors_of("40 assumed modes", 1),
                    errors_of("5 elements", 2),
                    errors_of("20 elements", 3)});
  // oracle: gss_control_plant * error of assumed mode 10
  check(both[0], bare_poles, bare_zeros, 0.015, 0.0005, show);
  check(both[1], tip_poles, tip_zeros, 0.17, 0.005, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "natural-frequencies",
           .title = "Poles and hub-locked frequencies, exact and by truncated models",
           .place = "our own, for a claim of section 3.1.3",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::natural_frequencies
