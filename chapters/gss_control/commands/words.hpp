/// @file
/// What a user types for this chapter's commands, understood.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/program/options.hpp"
#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// What every command takes.
struct Craft {
  std::string file;           ///< empty: Table 3.1
  std::vector<double> gains;  ///< empty: no feedback
};

/// Options --spacecraft and, where it is wanted, --gains.
void declare_craft(scene::Options& options, Craft& craft, bool with_gains = true);

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

/// The closed loop of three gains. @throws InputError naming them, if they are not three or out of range
[[nodiscard]] spacecraft::ClosedLoop typed_loop(const spacecraft::Parameters& craft,
                                                const std::vector<double>& gains);

/// Times 0, DT, 2 DT, ... and T itself, which is the last; without DT the first and the last.
/// @throws InputError for more than ten million
[[nodiscard]] std::vector<double> typed_times(double until, const std::optional<double>& every);

}  // namespace nlmech::chapters::gss_control
