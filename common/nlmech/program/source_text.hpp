/// @file
/// A text of a user, and error messages with positions in it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "nlmech/support/errors.hpp"

namespace nlmech::program {

/// A range of bytes in a text: from `begin` to below `end`.
struct Place {
  std::size_t begin = 0;  ///< first byte
  std::size_t end = 0;    ///< one past the last
};

/// A text with its name in messages: "--equation", "pendulum.ode". Line ends may be those of Windows; a byte
/// order mark is removed.
class SourceText {
 public:
  /// @param name of an option or a file
  /// @param text from the command line or the file
  SourceText(std::string name, std::string text);

  /// The whole text; a line end is one byte.
  [[nodiscard]] std::string_view text() const { return text_; }
  /// The text at a place.
  [[nodiscard]] std::string_view at(const Place& place) const {
    return std::string_view(text_).substr(place.begin, place.end - place.begin);
  }
  /// The error "name:line:column: sentence", followed by the line and a caret under the place. Columns are
  /// counted in characters, from 1.
  [[nodiscard]] InputError mistake(const Place& place, std::string_view sentence) const;

 private:
  std::string name_, text_;
};

}  // namespace nlmech::program
