#include "nlmech/program/machine_code/code_on_demand.hpp"

#include <algorithm>

namespace nlmech::machine_code {

std::shared_ptr<const SeriesCode> SeriesCodes::of(const Tape& tape, int order, int lanes, int repays_after) {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find_if(
      known_, [&](const Known& k) { return k.order == order && k.lanes == lanes && k.tape == tape; });
  if (found != known_.end()) return found->code;
  if (known_.size() == most_known) known_.erase(known_.begin());
  known_.push_back({tape, order, lanes, std::make_shared<const SeriesCode>(repays_after)});
  return known_.back().code;
}

}  // namespace nlmech::machine_code
