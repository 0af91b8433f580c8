#include "nlmech/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace {

void collect(const std::vector<const AnyRun*>& needs, std::map<std::string, const AnyRun*>& all) {
  for (const AnyRun* run : needs) {
    all.emplace(run->name(), run);
    collect(run->needs(), all);
  }
}

}  // namespace

Quantity near(std::string name, std::string unit, double value, double reference, double relative,
              std::string reason) {
  const double margin = relative * std::abs(reference);
  return {std::move(name), std::move(unit), value, reference - margin, reference + margin, std::move(reason)};
}

Quantity at_most(std::string name, std::string unit, double value, double bound, std::string reason) {
  return {std::move(name), std::move(unit), value, 0, bound, std::move(reason)};
}

Chapter::Chapter(std::string name, std::string title) : name_(std::move(name)), title_(std::move(title)) {}

Chapter::Chapter(std::string name, std::string title, std::vector<std::vector<Scene>> scenes)
    : Chapter(std::move(name), std::move(title)) {
  for (auto& group : scenes) {
    for (Scene& scene : group) add(std::move(scene));
  }
}

void Chapter::refuse_known_run(const std::string& name) const {
  for (const auto& other : runs_) {
    if (other->name() == name) throw std::invalid_argument(fmt::format("two runs are named {}", name));
  }
}

void Chapter::add(Scene scene) {
  for (const Scene& other : scenes_) {
    if (other.name == scene.name)
      throw std::invalid_argument(fmt::format("two scenes are named {}", scene.name));
  }
  if (scene.content.show) {
    scene.show = scene.content.show;
    for (const auto& need : scene.content.needs) scene.needs.push_back(need.get());
  }
  scenes_.push_back(std::move(scene));
}

void Chapter::add(Measurement measurement) {
  for (const Measurement& other : measurements_) {
    if (other.name == measurement.name) {
      throw std::invalid_argument(fmt::format("two measurements are named {}", measurement.name));
    }
  }
  measurements_.push_back(std::move(measurement));
}

const Scene& Chapter::scene(const std::string& name) const {
  std::vector<std::string_view> names;
  for (const Scene& scene : scenes_) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  throw InputError(
      fmt::format("{} has no scene '{}'; it has {}", name_, echoed(name), fmt::join(names, ", ")));
}

Performance perform(const Scene& scene, Workshop& workshop) {
  workshop.open(scene.name, scene.needs);
  Performance performance{scene.show(workshop), {}};
  const Showing& showing = performance.showing;
  const bool figure = showing.figure && !showing.figure->data.rows().empty();
  const bool table = showing.table && !showing.table->rows().empty();
  if (!figure && !table) throw std::logic_error(fmt::format("scene {} shows nothing", scene.name));
  if (showing.figure.has_value() != figure || showing.table.has_value() != table)
    throw std::logic_error(fmt::format("scene {} has an empty {}", scene.name, figure ? "table" : "figure"));
  if (showing.quantities.empty())
    throw std::logic_error(fmt::format("scene {} checks no quantity", scene.name));

  std::map<std::string, const AnyRun*> declared;
  collect(scene.needs, declared);
  for (const auto& [name, run] : declared) performance.runs.push_back(run);
  const std::vector<std::string> used = workshop.used();
  for (const auto& [name, run] : declared) {
    if (!std::binary_search(used.begin(), used.end(), name)) {
      throw std::logic_error(fmt::format("scene {} declares run {} and does not use it", scene.name, name));
    }
  }
  return performance;
}

}  // namespace nlmech::scene
