#include "chapters/algebraic_series/examples.hpp"

#include "chapters/algebraic_series/example_of.hpp"

namespace nlmech::chapters::algebraic_series {
namespace {

template <class Real>
using FourBodies = problems::BasicBodies<Real, 4>;

}  // namespace

const comparison::Example& lorenz_example() {
  static const auto example = example_of<problems::BasicLorenz>(0, 20, 20);
  return example;
}

const comparison::Example& bodies_example() {
  static const auto example = example_of<FourBodies>(0, 3000, 0);
  return example;
}

}  // namespace nlmech::chapters::algebraic_series
