#include "nlmech/scene/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nlmech::scene {

void Workshop::take_turn(std::size_t scenes_left) {
  constexpr std::size_t many = 12;
  if (!machine_ || (processor_ && scenes_left > many)) return;
  processor_.reset();
  processor_.emplace(*machine_);
}

void Workshop::open(const std::string& scene, const std::vector<const AnyRun*>& needs) {
  desks_.assign(1, Desk{scene, needs});
  used_.clear();
}

void Workshop::begin(const AnyRun& run) {
  if (desks_.empty()) throw std::logic_error(fmt::format("run {} asked for outside any scene", run.name()));
  const Desk& desk = desks_.back();
  if (std::find(desk.needs.begin(), desk.needs.end(), &run) == desk.needs.end()) {
    throw std::logic_error(fmt::format("{} uses run {} without declaring it", desk.name, run.name()));
  }
  note(run);
  desks_.push_back(Desk{run.name(), run.needs()});
}

// A run that was computed for an earlier scene asks for nothing any more; what it rests on still counts as
// used.
void Workshop::note(const AnyRun& run) {
  used_.insert(run.name());
  for (const AnyRun* needed : run.needs()) note(*needed);
}

std::vector<std::string> Workshop::used() const { return {used_.begin(), used_.end()}; }

}  // namespace nlmech::scene
