/// @file
/// Who is fastest, by how much, and which methods are therefore in colour.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/cost/lines.hpp"

namespace nlmech::scene {

/// Digits at which work-precision diagrams say who is fastest.
inline constexpr std::array asked_digits = {3.0, 6.0, 9.0, 12.0};

/// Who gives so many digits in the least time, see Front. Of equal times the first counts.
struct Lead {
  double digits;                     ///< as asked
  std::optional<std::size_t> first;  ///< index of the fastest line; nothing: nobody has so many digits
  std::optional<std::size_t> next;   ///< of the fastest line of another family; nothing: no other arrives
  double time = 0;                   ///< s, of the first
  double factor = 0;                 ///< time of the next over that of the first; 0: there is none

  /// "2.1 times before ode45"; "level with ode45" up to 5 %; "alone"; "nobody" without a first
  [[nodiscard]] std::string margin(const ProblemLines& problem) const;
};

/// The lead at each of asked_digits, among all but Side::floor.
[[nodiscard]] std::vector<Lead> leads_of(const ProblemLines& problem);

/// "series is fastest at 3, 6 and 9 digits"; "ode45 is fastest at 3, series at 6 and 9 digits"; "no method
/// has three digits".
[[nodiscard]] std::string who_leads(const ProblemLines& problem);

/// How a method in colour is drawn.
struct MethodLook {
  const char* colour;  ///< "#D55E00"
  int symbol;          ///< gnuplot's point type
};

/// Okabe and Ito's eight colours, their yellow darkened for white paper, each with its own symbol.
inline constexpr std::array method_looks = {
    MethodLook{"#000000", 7},  MethodLook{"#D55E00", 13}, MethodLook{"#0072B2", 5}, MethodLook{"#009E73", 9},
    MethodLook{"#CC79A7", 11}, MethodLook{"#E69F00", 15}, MethodLook{"#56B4E9", 6}, MethodLook{"#8F7F00", 4}};

/// A line in colour.
struct InColour {
  std::size_t line;    ///< its index
  std::size_t colour;  ///< index of method_looks
};

/// The lines in colour, the most important ones first: all, if there are no more than looks; else at most so
/// many: of subjects, floors and peers the best of each group; who leads at asked_digits; then those that are
/// fastest of ours somewhere. The best of a group is fastest in it at most digits, or else comes closest; a
/// group's first has the group's colour if it is free.
/// @param problems several: what counts is all of them together
/// @param least digits that count, and what is below them not: where the ordinate begins
[[nodiscard]] std::vector<InColour> foreground(const std::vector<MethodGroup>& groups,
                                               const std::vector<ProblemLines>& problems, double least = 0);

}  // namespace nlmech::scene
