/// @file
/// A spacecraft of the user's own from a TOML file.
#pragma once

#include <string>
#include <string_view>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// Reads `hub_inertia`, `mass_per_length`, `youngs_modulus`, `length`, `hub_radius`, `second_moment`,
/// `tip_mass` and `tip_inertia`; keys that are not there keep their value of Table 3.1.
/// @param name what complaints call the text: the file's name, or "standard input"
/// @throws InputError naming file, line, key and value: no TOML, an unknown key, a value that is no number,
/// is not finite, or that no spacecraft can have
[[nodiscard]] spacecraft::Parameters parse_spacecraft(std::string_view text, const std::string& name);

/// The same from a file; "-" is standard input, and without a name it is Table 3.1. @throws InputError also
/// if the file cannot be read
[[nodiscard]] spacecraft::Parameters read_spacecraft(const std::string& path);

}  // namespace nlmech::chapters::gss_control
