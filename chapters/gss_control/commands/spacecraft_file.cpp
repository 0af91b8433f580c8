#include "chapters/gss_control/commands/spacecraft_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "chapters/toml_file.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Parameters;

/// Key of the TOML file.
struct Key {
  std::string_view name;
  double Parameters::*field;
  bool may_vanish;  ///< whether 0 is allowed
};

constexpr std::array keys = {Key{"hub_inertia", &Parameters::hub_inertia, true},
                             Key{"mass_per_length", &Parameters::mass_per_length, false},
                             Key{"youngs_modulus", &Parameters::youngs_modulus, false},
                             Key{"length", &Parameters::length, false},
                             Key{"hub_radius", &Parameters::hub_radius, true},
                             Key{"second_moment", &Parameters::second_moment, false},
                             Key{"tip_mass", &Parameters::tip_mass, true},
                             Key{"tip_inertia", &Parameters::tip_inertia, true}};

std::string names_of_keys() {
  std::string all;
  for (const Key& k : keys) all += fmt::format("{}, ", k.name);
  return all + "root_stiffness, tip_support";
}

/// Words of tip_support, in the order of TipSupport.
constexpr std::array supports = {"free", "pinned", "guided", "clamped"};

/// Number of a key. @throws InputError if it is out of range
double number(const toml::node& node, const Key& key, const std::string& file) {
  const double value = number_of(file, node, key.name);
  if (key.may_vanish && value < 0) complain(file, node, key.name, "must not be negative");
  if (!key.may_vanish && value <= 0) complain(file, node, key.name, "must be positive");
  return value;
}

/// The stiffness of the roots: a number, or infinite for "clamped".
double stiffness(const toml::node& node, const std::string& file) {
  if (node.value<std::string>() == "clamped") return std::numeric_limits<double>::infinity();
  if (node.is_string()) complain(file, node, "root_stiffness", "neither a number nor 'clamped'");
  return number(node, Key{"root_stiffness", nullptr, true}, file);
}

spacecraft::TipSupport support(const toml::node& node, const std::string& file) {
  const auto word = std::ranges::find(supports, node.value_or(std::string()));
  if (word == supports.end())
    complain(file, node, "tip_support", "must be 'free', 'pinned', 'guided' or 'clamped'");
  return static_cast<spacecraft::TipSupport>(word - supports.begin());
}

}  // namespace

spacecraft::Parameters parse_spacecraft(std::string_view text, const std::string& name) {
  Parameters parameters = spacecraft::table_3_1();
  for (const auto& [key, node] : parse_toml(text, name)) {
    if (key.str() == "root_stiffness") {
      parameters.root_stiffness = stiffness(node, name);
      continue;
    }
    if (key.str() == "tip_support") {
      parameters.tip_support = support(node, name);
      continue;
    }
    const auto known = std::ranges::find(keys, key.str(), &Key::name);
    if (known == keys.end()) complain(name, node, key.str(), "no such key; the keys are " + names_of_keys());
    parameters.*(known->field) = number(node, *known, name);
  }
  try {
    spacecraft::require_physical(parameters);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  return parameters;
}

spacecraft::Parameters read_spacecraft(const std::string& path) {
  if (path.empty()) return spacecraft::table_3_1();
  return parse_spacecraft(scene::read_whole(path), path == "-" ? "standard input" : path);
}

}  // namespace nlmech::chapters::gss_control
