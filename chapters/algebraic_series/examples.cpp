#include "chapters/algebraic_series/examples.hpp"

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::algebraic_series {
namespace {

using comparison::example_of;
using problems::TextProblem;

/// Precision of the references: the Lorenz solution loses sixteen digits in 40 units of time. The strongly
/// nonlinear oscillator loses six in 750, so a 64-bit significand suffices: error 4e-14, a thousandth of that
/// of double, in a twentieth of the time.
using Digits35 = ExtendedReal<35>;

}  // namespace

const comparison::Example& lorenz_example() {
  static const auto example = example_of<Digits35>(TextProblem("lorenz"), 20);
  return example;
}

const comparison::Example& forced_duffing_example() {
  static const auto example = example_of<Digits35>(TextProblem("forced-duffing"), 50);
  return example;
}

const comparison::Example& oscillator_example() {
  static const auto example = example_of(TextProblem("oscillator"), 375);
  return example;
}

const comparison::Example& bodies_example() {
  static const auto example = example_of<Digits35>(TextProblem("bodies"));
  return example;
}

}  // namespace nlmech::chapters::algebraic_series
