/// @file
/// The picture that a user of a command asks for by `--plot FILE.svg`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "nlmech/scene/show.hpp"

namespace nlmech::scene {

/// Words as they stand, in a text that gnuplot reads with its markup: "k_1 x^2" has no subscript. Apostrophes
/// become primes.
[[nodiscard]] std::string without_markup(const std::string& text);

/// A picture in a file of the user's choice.
class Picture {
 public:
  /// @param file empty: no picture is wanted
  /// @throws InputError naming `--plot` unless the name ends with .svg, in a folder that is there, and for a
  /// file that is there and that no Picture has drawn
  explicit Picture(std::filesystem::path file);

  /// Is one wanted?
  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  /// Draws what @p make gives. To be called when the numbers have been printed, which a failure leaves where
  /// they are.
  /// @throws Failure naming the file
  void draw(const std::function<Figure()>& make) const;

 private:
  std::filesystem::path file_;
};

}  // namespace nlmech::scene
