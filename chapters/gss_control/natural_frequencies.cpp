#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/finite_elements.hpp"
#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr int modes = 10;
using Ten = std::array<double, modes>;

// Poles and hub-locked frequencies, 13 digits. oracle: gss_control_plant * pole *, * locked *
constexpr Ten bare_poles = {12.85700141881, 72.75595661757, 202.3917222511, 396.146445565,  654.6049452155,
                            977.6991513854, 1365.424532083, 1817.777712238, 2334.757073177, 2916.361705513};
constexpr Ten tip_poles = {6.452959965749, 52.08177896598, 156.1145680847, 297.5963940072, 466.7083006532,
                           697.9022473906, 1006.323399114, 1386.371948014, 1834.27051019,  2348.423457947};
constexpr Ten bare_zeros = {11.51094878903, 72.13788468598, 201.988165951,  395.816189037,  654.3125215595,
                            977.42960858,   1365.170290015, 1817.534409283, 2334.521974614, 2916.13298559};
constexpr Ten tip_zeros = {4.372658473946, 51.39836909583, 155.7182855807, 297.3174784595, 466.4585312923,
                           697.6424805754, 1006.066778865, 1386.123663541, 1834.030353588, 2348.190198895};

double worst(const std::vector<double>& ours, const Ten& theirs) {
  double error = ours.size() == theirs.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < theirs.size() && i < ours.size(); ++i)
    error = std::max(error, std::abs(ours[i] / theirs.at(i) - 1));
  return error;
}

/// A discretisation whose poles are drawn.
struct Drawn {
  const char *legend, *look;
  bool elements;
  int size;
};
constexpr std::array drawn = {Drawn{"10 assumed modes", "b1", false, 10},
                              Drawn{"40 assumed modes", "b2", false, 40}, Drawn{"5 elements", "b4", true, 5},
                              Drawn{"20 elements", "b5", true, 20}};

Eigen::VectorXd frequencies(const spacecraft::Parameters& p, const Drawn& d) {
  return diagonalise(d.elements ? spacecraft::finite_elements(p, d.size)
                                : spacecraft::assumed_modes(p, d.size))
      .omega;
}

scene::Showing show() {
  Plot plot("With tips, assumed modes stop at percents, elements do not", "number of the mode");
  scene::Table table({{"model"},
                      {"mode"},
                      {"pole (rad/s)", 13},
                      {"hub-locked (rad/s)", 13},
                      {"10 assumed modes, relative error", 2},
                      {"40 assumed modes", 2},
                      {"5 elements", 2},
                      {"20 elements", 2}});
  std::vector<scene::Quantity> quantities;
  plot.x_range(0.5, 10.5);
  for (const bool tip : {false, true}) {
    const char* model = tip ? "with tips" : "no tips";
    const spacecraft::Plant plant(craft(tip));
    const auto poles = spacecraft::poles(plant, modes), zeros = spacecraft::hub_zeros(plant, modes);
    plot.panel(fmt::format("relative error, {}", model));
    plot.log_y(1e-9, 1);
    std::array<Eigen::VectorXd, drawn.size()> found;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      found.at(k) = frequencies(plant.parameters(), drawn.at(k));
      plot.begin(tip ? "" : drawn.at(k).legend, drawn.at(k).look);
      for (int i = 0; i < modes; ++i)
        plot.add(i + 1, std::max(1e-9, std::abs(found.at(k)[i] / poles.omega.at(std::size_t(i)) - 1)));
    }
    for (std::size_t i = 0; i < modes; ++i) {
      const auto error = [&](std::size_t k) {
        return found.at(k)[static_cast<Eigen::Index>(i)] / poles.omega.at(i) - 1;
      };
      table.add({model, std::int64_t(i) + 1, poles.omega.at(i), zeros.omega.at(i), error(0), error(1),
                 error(2), error(3)});
    }
    const char* reason = "tools/oracles/gss_control_plant.py, 13 digits";
    quantities.push_back(scene::at_most(fmt::format("largest relative difference of a pole, {}", model), "1",
                                        worst(poles.omega, tip ? tip_poles : bare_poles), 1e-12, reason));
    quantities.push_back(
        scene::at_most(fmt::format("largest relative difference of a hub-locked frequency, {}", model), "1",
                       worst(zeros.omega, tip ? tip_zeros : bare_zeros), 1e-12, reason));
    quantities.push_back(scene::near(fmt::format("first pole, {}", model), "rad/s", poles.omega.front(),
                                     tip ? tip_poles.front() : bare_poles.front(), 1e-12, reason));
    quantities.push_back(scene::near(fmt::format("second pole, {}", model), "rad/s", poles.omega.at(1),
                                     tip ? tip_poles.at(1) : bare_poles.at(1), 1e-12, reason));
    // oracle: gss_control_plant * error of assumed mode 10
    const double tenth = found.at(0)[9] / poles.omega.at(9) - 1, known_tenth = tip ? 0.17 : 0.015;
    quantities.push_back({fmt::format("error of mode 10 by ten assumed modes, {}", model), "1", tenth,
                          known_tenth - (tip ? 0.005 : 0.0005), known_tenth + (tip ? 0.005 : 0.0005),
                          "tools/oracles/gss_control_plant.py, two digits"});
    double upper = 0;
    for (int i = 3; i < modes; ++i)
      upper = std::max(upper, found.at(1)[i] / poles.omega.at(std::size_t(i)) - 1);
    if (tip)
      quantities.push_back({"largest error of modes 4 to 10 by 40 assumed modes, with tips", "1", upper, 0.03,
                            0.05,
                            "such modes bend no tip body, and converge like 1/N: some percents with 40"});
    // Hermite's cubics: errors of a frequency grow like (q h)^4/1440, q h the wave number times the length.
    const double q = std::sqrt(poles.omega.at(9) / std::sqrt(plant.parameters().bending_stiffness() /
                                                             plant.parameters().mass_per_length)) *
                     plant.parameters().length / 20;
    quantities.push_back({fmt::format("error of mode 10 by 20 elements, {}", model), "1",
                          found.at(3)[9] / poles.omega.at(9) - 1, 0.5 * std::pow(q, 4) / 1440,
                          2 * std::pow(q, 4) / 1440,
                          "dispersion of a long beam of Hermite's cubics, (q h)^4/1440, within a factor 2"});
  }
  return {plot.with("key1", "bottom right maxrows 2").with("height", "600").take(), table, quantities};
}

}  // namespace

void add_natural_frequencies(scene::Chapter& chapter) {
  chapter.add({.name = "natural-frequencies",
               .title = "Poles and hub-locked frequencies, exact and by truncated models",
               .place = "our own",
               .needs = {},
               .show = [](Workshop&) { return show(); }});
}

}  // namespace nlmech::chapters
