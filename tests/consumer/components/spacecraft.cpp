// A free body with appendages: its poles are positive and rise.
#include "nlmech/spacecraft/plant/poles.hpp"

int main() {
  using namespace nlmech::spacecraft;
  const Frequencies found = poles(Plant(table_3_1()), 3);
  return found.status.ok() && found.omega[0] > 0 && found.omega[1] > found.omega[0] &&
                 found.omega[2] > found.omega[1]
             ? 0
             : 1;
}
