/// @file
/// What a user types for this chapter's commands, understood.
#pragma once

#include <string>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// Of the option --spacecraft, on every command.
inline constexpr const char* spacecraft_help =
    "TOML file, - for standard input, with hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, "
    "second_moment, tip_mass, tip_inertia in any consistent units, which are those of all options and "
    "results; "
    "without it, and for a key that is missing, Table 3.1 in slug, ft, lb, s";
/// Of the option --gains.
inline constexpr const char* gains_help =
    "k1,k2,k3 of u = -k1 (theta - theta_f) - k2 (r S0 - M0) - k3 theta'";

/// Frequencies: "w1,w2,..." or "LO:HI:N", N of them from LO to HI, spaced logarithmically.
/// @throws InputError
[[nodiscard]] std::vector<double> typed_frequencies(const char* option, const std::string& text);

/// A place on an appendage, with the text that headers repeat.
struct Place {
  std::string text;  ///< as typed
  double x = 0;      ///< from the hub's rim
};

/// Places "x1,x2,..."; none for an empty text. @throws InputError for one off the appendage
[[nodiscard]] std::vector<Place> typed_places(const char* option, const std::string& text,
                                              const spacecraft::Parameters& craft);

/// The closed loop of gains "k1,k2,k3". @throws InputError naming the gains, if they are not three numbers or
/// out of range
[[nodiscard]] spacecraft::ClosedLoop typed_loop(const spacecraft::Parameters& craft,
                                                const std::string& gains);

/// Times 0, DT, 2 DT, ... and T itself, which is the last; without DT the first and the last.
/// @throws InputError for more than ten million
[[nodiscard]] std::vector<double> typed_times(const std::string& until, const std::string& every);

}  // namespace nlmech::chapters::gss_control
