/// @file
/// The deck of reference values for frames: its rows, each by two routes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/frame_deck/elements.hpp"
#include "tools/frame_deck/rods.hpp"

namespace nlmech::frame_deck {

/// A row that is to be made.
struct Row {
  std::string frame;     ///< a file of chapters/homotopy/frames, without its ending
  std::string quantity;  ///< "first maximum", "first bifurcation", "load at the displacement"
  Question question;     ///< of elements
  int least = 1;         ///< elements of the coarsest frame, as of `homotopy frame --elements`
  int levels = 5;        ///< of extrapolation
  std::string route;     ///< "elastica" or "closed form"
  /// The load by it. @param steps of shooting, a rod
  std::function<std::optional<Real>(int steps)> independent;
};

/// A row that is made.
struct Made {
  Real load = 0;          ///< by the independent route
  Real elements = 0;      ///< extrapolated
  Real spread = 0;        ///< of the last two extrapolations
  Real displacement = 0;  ///< of the question's motion there, by elements
  int digits = 0;         ///< to which both routes agree, at most 12
};

/// The frame of a file, perfect.
[[nodiscard]] frames::FrameModel model_of(const std::string& frame);

/// Its members as a chain, if each begins where the one before ends.
[[nodiscard]] Chain chain_of(const frames::FrameModel& model);

/// All rows, in the order of the file.
[[nodiscard]] std::vector<Row> rows();

/// Both routes. @param row of rows(). @throws std::runtime_error if one of them ends nowhere
[[nodiscard]] Made make(const Row& row);

/// The file: a line for its columns and one for each row.
[[nodiscard]] std::string deck();

}  // namespace nlmech::frame_deck
