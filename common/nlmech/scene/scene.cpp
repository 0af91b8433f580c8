#include "nlmech/scene/scene.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {

AnyRun::AnyRun(std::string name, std::string reading, List needs)
    : name_(std::move(name)), reading_(std::move(reading)), needs_(std::move(needs)) {}

AnyRun::~AnyRun() = default;

void Results::wait_for_processor(std::size_t scenes_left) {
  constexpr std::size_t many = 12;
  if (!machine_ || (processor_ && scenes_left > many)) return;
  processor_.reset();
  processor_.emplace(*machine_);
}

namespace {

void collect(const AnyRun::List& needs, std::map<std::string, const AnyRun*>& all) {
  for (const auto& run : needs) {
    all.emplace(run->name(), run.get());
    collect(run->needs(), all);
  }
}

}  // namespace

std::function<Showing(Results&)> Content::shown(std::function<void(Results&, Show&)> put) {
  return [put = std::move(put)](Results& all) {
    Show to_show(all.quick());
    put(all, to_show);
    return to_show.take();
  };
}

Chapter::Chapter(std::string name, std::string title, const std::vector<std::vector<Scene>>& scenes)
    : name_(std::move(name)), title_(std::move(title)) {
  std::set<std::string> names;
  for (const auto& group : scenes) {
    for (const Scene& scene : group) {
      if (!names.insert(scene.name).second) throw invalid_argument("two scenes are named {}", scene.name);
      scenes_.push_back(scene);
    }
  }
}

const Scene& Chapter::scene(const std::string& name) const {
  std::vector<std::string_view> names;
  for (const Scene& scene : scenes_) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  throw input_error("{} has no scene '{}'; it has {}", name_, quoted_input(name), fmt::join(names, ", "));
}

Performance perform(const Scene& scene, Results& results) {
  Performance performance{scene.content.show(results), {}};
  const Showing& showing = performance.showing;
  const bool figure = showing.figure && !showing.figure->data.rows().empty();
  const bool table = showing.table && !showing.table->rows().empty();
  if (!figure && !table) throw std::logic_error(fmt::format("scene {} shows nothing", scene.name));
  if (showing.figure.has_value() != figure || showing.table.has_value() != table)
    throw std::logic_error(fmt::format("scene {} has an empty {}", scene.name, figure ? "table" : "figure"));
  if (showing.quantities.empty())
    throw std::logic_error(fmt::format("scene {} checks no quantity", scene.name));
  std::map<std::string, const AnyRun*> runs;
  collect(scene.content.needs, runs);
  for (const auto& [name, run] : runs) performance.runs.push_back(run);
  return performance;
}

}  // namespace nlmech::scene
