// A parameter by its name.
#include <stdexcept>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/parameters.hpp"

int main() {
  nlmech::problems::Duffing duffing;
  nlmech::problems::parameter(duffing, "hardening") = 3;
  try {
    nlmech::problems::parameter(duffing, "softening") = 3;
  } catch (const std::invalid_argument&) {
    return duffing.hardening == 3 ? 0 : 1;
  }
  return 1;
}
