/// @file
/// The picture of `--plot FILE.svg`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "nlmech/scene/show.hpp"

namespace nlmech::scene {

/// Escapes a text for gnuplot's markup, so that "k_1 x^2" is drawn literally. Apostrophes become primes.
[[nodiscard]] std::string without_markup(const std::string& text);

/// A picture in a file chosen by the user.
class Picture {
 public:
  /// @param file empty: no picture
  /// @throws InputError naming `--plot` if the name does not end with .svg, the folder does not exist, or the
  /// file exists and was not drawn by a Picture
  explicit Picture(std::filesystem::path file);

  /// Was a picture requested?
  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  /// Draws the figure that @p make returns. Call it after printing the results, so that a failure does not
  /// lose them.
  /// @throws Failure naming the file
  void draw(const std::function<Figure()>& make) const;

 private:
  std::filesystem::path file_;
};

}  // namespace nlmech::scene
