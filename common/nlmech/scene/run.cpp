#include "nlmech/scene/run.hpp"

namespace nlmech::scene {

void Results::take_turn(std::size_t scenes_left) {
  constexpr std::size_t many = 12;
  if (!machine_ || (processor_ && scenes_left > many)) return;
  processor_.reset();
  processor_.emplace(*machine_);
}

}  // namespace nlmech::scene
