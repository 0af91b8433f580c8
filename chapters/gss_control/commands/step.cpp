#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "chapters/gss_control/commands/commands.hpp"
#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/gss_control/commands/words.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

/// What was typed.
struct Words {
  Craft craft;
  std::string at;
  std::optional<double> angle, every;
  double until = 0;
};

void declare(scene::Options& options, Words& words) {
  declare_craft(options, words.craft);
  options.add("--final-angle", words.angle, "theta_f, rad; 1 without it");
  options.add("--until", words.until, "last time").positive().required();
  options.add("--every", words.every, "rows at this distance in time; without it the first and the last")
      .positive();
  options.add("--at", words.at, "places on the appendage x1,x2,..., their distances from the rim");
}

spacecraft::TimeResponse respond(const Words& words, const spacecraft::Parameters& craft,
                                 const std::vector<double>& places) {
  if (!words.craft.gains.empty())
    return step_response(typed_loop(craft, words.craft.gains), words.angle.value_or(1), places);
  if (words.angle)
    throw InputError(fmt::format("--final-angle {}: means nothing without --gains k1,k2,k3", *words.angle));
  return torque_response(spacecraft::Plant(craft), 1, places);
}

std::string step(const Words& words) {
  const spacecraft::Parameters craft = read_spacecraft(words.craft.file);
  const std::vector<double> times = typed_times(words.until, words.every);
  const std::vector<Place> places = typed_places("--at", words.at, craft);
  std::vector<double> x;
  std::string text = "t,theta,theta_dot";
  for (const Place& p : places) {
    text += fmt::format(",y@{0},ydot@{0}", p.text);
    x.push_back(p.x);
  }
  text += '\n';
  const spacecraft::TimeResponse r = respond(words, craft, x);
  if (!r.status.ok()) throw Failure(r.status);
  for (const double t : times) {
    if (const Status certain = certain_at(r, t); !certain.ok()) throw Failure(certain);
    text += fmt::format("{:.17g},{:.17g},{:.17g}", t, r.theta.value(t), r.theta_dot.value(t));
    for (std::size_t i = 0; i < x.size(); ++i)
      text += fmt::format(",{:.17g},{:.17g}", r.deflection[i].value(t), r.deflection_dot[i].value(t));
    text += '\n';
  }
  return text;
}

}  // namespace

void add_step_command(scene::Commands& all) {
  all.add("step",
          "Motion from rest under a unit torque, or with gains to a target angle, by residues, as CSV: "
          "t,theta,theta_dot,y@X,ydot@X; in the spacecraft's units, s, rad and ft for Table 3.1",
          declare, step);
}

}  // namespace nlmech::chapters::gss_control
