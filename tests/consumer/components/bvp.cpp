// Three of Lobatto's nodes on [0, 1] and Simpson's weights.
#include <cmath>

#include "nlmech/bvp/scheme.hpp"

int main() { return std::abs(nlmech::bvp::lobatto_scheme(3).weights[1] - 2 / 3.0) < 1e-15 ? 0 : 1; }
