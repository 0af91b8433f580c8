/// @file
/// What a user types for this chapter's commands, understood.
#pragma once

#include <string>
#include <vector>

#include "nlmech/spacecraft/closed_loop.hpp"
#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters {

/// Frequencies: "w1,w2,..." or "LO:HI:N", N of them from LO to HI, spaced logarithmically.
/// @throws InputError
[[nodiscard]] std::vector<double> typed_frequencies(const char* option, const std::string& text);

/// A place on an appendage, with the text that headers repeat.
struct Place {
  std::string text;  ///< as typed
  double x = 0;      ///< ft from the hub's rim
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

}  // namespace nlmech::chapters
