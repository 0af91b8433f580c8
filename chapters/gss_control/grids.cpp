#include "chapters/gss_control/grids.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nlmech::chapters::gss_control {

std::vector<double> logarithmic(double low, double high, int n) {
  if (!(low > 0 && high > low) || n < 2)
    throw std::invalid_argument(fmt::format("logarithmic: {} points from {:.6g} to {:.6g}", n, low, high));
  std::vector<double> all;
  const double first = std::log10(low), length = std::log10(high) - first;  // powers of ten stay themselves
  for (int i = 0; i < n; ++i) all.push_back(std::pow(10, first + length * i / (n - 1)));
  all.front() = low;  // as typed, not as rounded
  all.back() = high;
  return all;
}

std::vector<double> equidistant(double low, double high, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(low + (high - low) * i / (n - 1));
  return all;
}

}  // namespace nlmech::chapters::gss_control
