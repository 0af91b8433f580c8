#include "chapters/gss_control/commands/spacecraft_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/toml_text.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Parameters;

/// A key of the file.
struct Key {
  std::string_view name;
  double Parameters::*field;
  bool may_vanish;  ///< is 0 allowed?
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
  for (const Key& k : keys) all += fmt::format("{}{}", all.empty() ? "" : ", ", k.name);
  return all;
}

/// A value as it stands in the file, near enough to be found there.
std::string text_of(const toml::node& node) {
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return echoed(out.str());
}

/// The number behind a key. @throws InputError
double number(const toml::node& node, const Key& key, const std::string& where) {
  const auto complain = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {} = {}: {}", where, key.name, text_of(node), what));
  };
  if (!node.is_number()) complain("not a number");
  const double value = node.value<double>().value_or(std::nan(""));
  if (!std::isfinite(value)) complain("not a finite number");
  if (key.may_vanish ? value < 0 : value <= 0)
    complain(key.may_vanish ? "must not be negative" : "must be positive");
  return value;
}

}  // namespace

spacecraft::Parameters parse_spacecraft(std::string_view text, const std::string& name) {
  Parameters parameters = spacecraft::table_3_1();
  scene::require_shallow_toml(text, name);
  try {
    const toml::table table = toml::parse(text, name);
    for (const auto& [key, node] : table) {
      const std::string where = fmt::format("{}, line {}", name, node.source().begin.line);
      const Key* known = nullptr;
      for (const Key& k : keys) {
        if (k.name == key.str()) known = &k;
      }
      if (known == nullptr)
        throw InputError(fmt::format("{}: {} = {}: no such key; there are {}", where, echoed(key.str()),
                                     text_of(node), names_of_keys()));
      parameters.*(known->field) = number(node, *known, where);
    }
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}, line {}, column {}: {}", name, error.source().begin.line,
                                 error.source().begin.column, echoed(error.description(), 400)));
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
