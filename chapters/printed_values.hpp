/// @file
/// Values printed in a table of a source, to be compared with computed ones.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::chapters {

/// Printed values of @p table (such as "table-4.2"), indexed by PublishedValue::name().
[[nodiscard]] inline std::map<std::string, scene::PublishedValue> printed_values(const std::string& table) {
  std::map<std::string, scene::PublishedValue> values;
  for (scene::PublishedValue& value : scene::read_published(scene::data_folder())) {
    if (value.place == table) values.emplace(value.name(), std::move(value));
  }
  return values;
}

}  // namespace nlmech::chapters
