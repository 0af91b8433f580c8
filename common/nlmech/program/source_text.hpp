/// @file
/// A text that a user typed, and how a mistake in it is pointed at.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "nlmech/support/errors.hpp"

namespace nlmech::program {

/// Where something stands in a text: bytes from `begin` to below `end`.
struct Place {
  std::size_t begin = 0;  ///< first byte
  std::size_t end = 0;    ///< one past the last
};

/// A text with the name that messages give it: "--equation", "pendulum.ode". Lines may end as on Windows; a
/// byte order mark is left out.
class SourceText {
 public:
  /// @param name of an option or a file
  /// @param text what was typed, or what the file holds
  SourceText(std::string name, std::string text);

  /// All of it, a line end being one byte.
  [[nodiscard]] std::string_view text() const { return text_; }
  /// What stands at a place.
  [[nodiscard]] std::string_view at(const Place& place) const {
    return std::string_view(text_).substr(place.begin, place.end - place.begin);
  }
  /// To throw: "name:line:column: sentence", and below it the line with a caret under the place. Columns are
  /// counted in characters, from 1.
  [[nodiscard]] InputError mistake(const Place& place, std::string_view sentence) const;

 private:
  std::string name_, text_;
};

}  // namespace nlmech::program
