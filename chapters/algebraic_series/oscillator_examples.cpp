#include <numbers>

#include "chapters/algebraic_series/example_of.hpp"
#include "chapters/algebraic_series/examples.hpp"

namespace nlmech::chapters::algebraic_series {

const comparison::Example& forced_duffing_example() {
  static const auto example = example_of<problems::BasicForcedDuffing>(0, 50, 50);
  return example;
}

const comparison::Example& oscillator_example() {
  static const auto example =
      example_of<problems::BasicStrongOscillator, long double>(std::numbers::pi_v<long double>, 375, 375);
  return example;
}

}  // namespace nlmech::chapters::algebraic_series
