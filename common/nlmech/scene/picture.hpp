/// @file
/// The picture that a user of a command asks for by `--plot FILE.svg`.
#pragma once

#include <filesystem>
#include <string>

#include "nlmech/scene/show.hpp"

namespace nlmech::scene {

/// Words as they stand, in a text that gnuplot reads with its markup: "k_1 x^2" has no subscript.
[[nodiscard]] std::string without_markup(const std::string& text);

/// A picture in a file of the user's choice.
class Picture {
 public:
  /// @param file empty: no picture is wanted
  /// @throws InputError naming `--plot` unless the name ends with .svg, and for a file that is there and that
  /// no Picture has drawn
  explicit Picture(std::filesystem::path file);

  /// Is one wanted?
  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  /// Draws it. To be called when the numbers have been printed, which a failure leaves where they are.
  /// @throws Failure naming the file
  void draw(const Figure& figure) const;

 private:
  std::filesystem::path file_;
};

}  // namespace nlmech::scene
