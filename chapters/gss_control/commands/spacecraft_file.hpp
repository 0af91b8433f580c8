/// @file
/// Spacecraft parameters from a TOML file.
#pragma once

#include <string>
#include <string_view>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// Reads `hub_inertia`, `mass_per_length`, `youngs_modulus`, `length`, `hub_radius`, `second_moment`,
/// `tip_mass` and `tip_inertia`; missing keys have the values of Table 3.1. `root_stiffness` is a moment per
/// radian, 0 for pinned roots, or "clamped" (default); `tip_support` is "free" (default), "pinned", "guided"
/// or "clamped".
/// @param name name in messages: the file name, or "standard input"
/// @throws InputError naming file, line, key and value: invalid TOML, an unknown key, or a value that is not
/// a number, not finite or out of range
[[nodiscard]] spacecraft::Parameters parse_spacecraft(std::string_view text, const std::string& name);

/// Reads a file; "-" is standard input, an empty path Table 3.1.
/// @throws InputError as parse_spacecraft(), and if the file cannot be read
[[nodiscard]] spacecraft::Parameters read_spacecraft(const std::string& path);

}  // namespace nlmech::chapters::gss_control
