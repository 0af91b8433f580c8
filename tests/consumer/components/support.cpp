#include "nlmech/support/stopwatch.hpp"

int main() { return nlmech::median({3, 1, 2}) == 2 ? 0 : 1; }
