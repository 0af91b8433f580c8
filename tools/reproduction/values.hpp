/// @file
/// The page of all printed numbers beside ours.
#pragma once

#include <string>
#include <vector>

#include "nlmech/scene/evidence/check.hpp"
#include "tools/reproduction/guide.hpp"

namespace nlmech::reproduction {

/// The page `REPRODUCTION.md`: counts by chapter and verdict, which are its contents, then a section a
/// chapter with one row a number. Numbers that are quoted for context are folded away below it. Holds no time
/// of ours.
[[nodiscard]] std::string reproduction_page(const std::vector<scene::Checked>& values, const Guide& guide);

}  // namespace nlmech::reproduction
