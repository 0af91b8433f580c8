#include "nlmech/program/tape_values.hpp"

#include <cmath>

namespace nlmech::tape {

std::pair<double, double> first_coefficient(const Instruction& i, double factor, double x, double other) {
  switch (i.operation) {
    case Operation::product:
    case Operation::product_by_line:
    case Operation::square: return {x * other, 0};
    case Operation::quotient: return {x / other, 0};
    case Operation::reciprocal: return {factor / x, 0};
    case Operation::root: return {std::sqrt(x), 0};
    case Operation::exponential: return {std::exp(x), 0};
    case Operation::circular: return {std::sin(x), std::cos(x)};
    case Operation::hyperbolic: return {std::sinh(x), std::cosh(x)};
    case Operation::tangent: return {std::tan(x), 1 + std::tan(x) * std::tan(x)};
    case Operation::hyperbolic_tangent: return {std::tanh(x), 1 / (std::cosh(x) * std::cosh(x))};
    case Operation::logarithm: return {std::log(x), 0};
    case Operation::power: return {std::pow(x, factor), 0};
    case Operation::arc_sine: return {std::asin(x), 0};
    case Operation::arc_cosine: return {std::acos(x), 0};
    case Operation::arc_tangent: return {std::atan(x), 0};
    case Operation::angle: return {std::atan2(x, other), 0};
    case Operation::area_sine: return {std::asinh(x), 0};
    case Operation::error_function: return {std::erf(x), 0};
    default: return {0, 0};
  }
}

bool has_companion(Operation operation) { return operation >= Operation::circular; }

std::vector<double> reciprocals(int order) {
  std::vector<double> all;
  for (int k = 0; k <= order; ++k) all.push_back(1 / static_cast<double>(k + 1));
  return all;
}

}  // namespace nlmech::tape
