#include "nlmech/scene/run.hpp"

namespace nlmech::scene {

AnyRun::AnyRun(std::string name, std::string reading, List needs)
    : name_(std::move(name)), reading_(std::move(reading)), needs_(std::move(needs)) {}

AnyRun::~AnyRun() = default;

void Results::take_turn(std::size_t scenes_left) {
  constexpr std::size_t many = 12;
  if (!machine_ || (processor_ && scenes_left > many)) return;
  processor_.reset();
  processor_.emplace(*machine_);
}

}  // namespace nlmech::scene
