/// @file
/// What becomes of methods of fixed step on the stand-in oscillators, step by step.
#pragma once

#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// One method with one step.
struct Fate {
  std::string method;  ///< "rk6", "mtl 3"
  double step;         ///< h
  std::string status;  ///< how it ended
  double error;        ///< greatest error of x; infinite if it failed
  double largest;      ///< greatest |x|
};

/// All of them on one oscillator.
struct Fates {
  std::vector<Fate> fates;  ///< by method, then by step
  double amplitude = 0;     ///< greatest |x| of the solution

  /// The shortest step with which a method overflows; NaN if none does.
  [[nodiscard]] double overflow_from(const std::string& name) const;
  /// @throws std::out_of_range if there is no such run
  [[nodiscard]] const Fate& at(const std::string& name, double step) const;
};

}  // namespace nlmech::chapters
