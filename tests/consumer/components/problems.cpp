// A parameter by its name.
#include <stdexcept>

#include "nlmech/problems/texts.hpp"

int main() {
  using nlmech::problems::TextProblem;
  try {
    (void)TextProblem("duffing", {{"softening", 3}});
  } catch (const std::runtime_error&) {
    return TextProblem("duffing", {{"hardening", 3}}).parameter("hardening") == 3 ? 0 : 1;
  }
  return 1;
}
