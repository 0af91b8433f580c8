#include "nlmech/scene/evidence/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

/// Does a value need a measurement? Not times on unknown machines and values that the source leaves
/// undetermined.
bool needs_measurement(const PublishedValue& value) {
  return value.expected != Verdict::context && value.expected != Verdict::not_stated;
}

/// Results of a chapter's scenes: reproduced values of printed numbers, and the first failure.
struct Measurements {
  std::map<std::string, Measured> by_name;
  std::string failure;  ///< message of the first failed scene; empty if none failed
};

Checked check_value(const PublishedValue& value, const Chapter& chapter, const Measurements& measured) {
  Checked checked{value, chapter.name(), {}, {}, {}};
  if (const auto found = measured.by_name.find(value.name()); found != measured.by_name.end()) {
    checked.measured = found->second;
  } else if (!measured.failure.empty()) {
    checked.failure = measured.failure;
  } else if (needs_measurement(value)) {
    throw std::logic_error(fmt::format("chapter {} has no measurement for {}", chapter.name(), value.name()));
  }
  checked.judgement = verdict_on(value, checked.measured);
  return checked;
}

void refuse_orphans(const Chapter& chapter, const Measurements& measured,
                    const std::vector<Checked>& values) {
  std::set<std::string> names;
  for (const Checked& c : values) names.insert(c.value.name());
  for (const auto& [name, value] : measured.by_name) {
    if (!names.contains(name))
      throw std::logic_error(
          fmt::format("chapter {} measures {}, which no source prints", chapter.name(), name));
  }
}

std::string shown(const std::optional<double>& value) { return value ? format_number(*value, 4) : ""; }

}  // namespace

bool ChapterCheck::passes() const {
  return std::all_of(values.begin(), values.end(), [](const Checked& c) { return c.judgement.passes; }) &&
         std::all_of(quantities.begin(), quantities.end(),
                     [](const CheckedQuantity& q) { return q.quantity.passes(); });
}

namespace {

/// Quantities of a scene; a scene that fails or cannot be drawn yields one quantity that never passes.
std::vector<CheckedQuantity> check_scene(const Chapter& chapter, const Scene& scene, Results& results,
                                         const std::optional<Publishing>& how, Measurements& measured) {
  std::vector<CheckedQuantity> quantities;
  const ProgressScope doing("computing " + scene.name);
  try {
    const Performance performance = perform(scene, results);
    for (const Quantity& q : performance.showing.quantities) quantities.push_back({scene.name, q});
    for (const auto& [name, value] : performance.showing.measured) {
      if (!measured.by_name.emplace(name, value).second)
        throw std::logic_error(fmt::format("two scenes measure {}", name));
    }
    if (how) publish(chapter, scene, performance, results.quick(), *how);
  } catch (const Failure& failure) {
    if (measured.failure.empty()) measured.failure = fmt::format("scene {}: {}", scene.name, failure.what());
    const double none = std::numeric_limits<double>::quiet_NaN();
    quantities.push_back({scene.name, {"the scene itself", "1", none, none, none, failure.what()}});
  }
  return quantities;
}

}  // namespace

ChapterCheck check(const Chapter& chapter, const fs::path& data_folder, bool quick,
                   const std::optional<Publishing>& how) {
  const std::vector<Place> places = read_places(data_folder);
  std::vector<PublishedValue> values = read_published(data_folder);
  std::erase_if(values, [&](const PublishedValue& v) { return owner(v, places) != chapter.name(); });

  Results results(quick);
  ChapterCheck result;
  Measurements measured;
  std::size_t left = chapter.scenes().size();
  for (const Scene& scene : chapter.scenes()) {
    results.wait_for_processor(left--);
    for (CheckedQuantity& q : check_scene(chapter, scene, results, how, measured))
      result.quantities.push_back(std::move(q));
  }
  for (const PublishedValue& value : values) result.values.push_back(check_value(value, chapter, measured));
  refuse_orphans(chapter, measured, result.values);
  return result;
}

void write_check(const ChapterCheck& check, const std::string& chapter, const fs::path& out) {
  Table table({{"name"}, {"nominal"}, {"inferred"}, {"verdict"}, {"passes"}, {"setting"}});
  for (const Checked& c : check.values) {
    table.add({c.value.name(), c.measured.nominal, c.measured.inferred,
               std::string(to_string(c.judgement.verdict)), std::int64_t{c.judgement.passes},
               c.measured.setting});
  }
  write_whole(out / "results" / chapter / "check.csv", table.csv());
}

std::string verdict_text(const Checked& checked) {
  std::string text(to_string(checked.judgement.verdict));
  if (!checked.judgement.passes) {
    text += fmt::format(" (FAILS: expected {})", to_string(checked.value.expected));
  }
  return text;
}

std::string reading_text(const Checked& checked) {
  const PublishedValue& value = checked.value;
  std::string text = checked.measured.setting;
  if (!text.empty() && !value.reading.empty()) text += "; ";
  text += value.reading;
  if (value.tried > 0) text += fmt::format(" ({} tried; explains {} rows)", value.tried, value.explains);
  return text;
}

std::string reproduction_text(const std::vector<Checked>& values) {
  std::string text;
  for (const Checked& c : values) {
    text += fmt::format("{} {}: published {}", c.judgement.passes ? "      " : "FAILS", c.value.name(),
                        c.value.printed);
    if (c.measured.nominal) text += ", nominal " + shown(c.measured.nominal);
    if (c.measured.inferred) text += ", inferred " + shown(c.measured.inferred);
    text += ": " + verdict_text(c);
    if (!c.failure.empty()) text += " because " + c.failure;
    if (const std::string reading = reading_text(c); !reading.empty()) text += " [" + reading + "]";
    text += '\n';
  }
  return text;
}

}  // namespace nlmech::scene
