/// @file
/// Which methods the chapter's overviews set side by side.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Names of all methods and peers but those of other papers, which have such overviews in chapters of their
/// own.
[[nodiscard]] inline std::vector<std::string> contestants() {
  constexpr std::array<std::string_view, 5> elsewhere = {"laier", "argyris", "hoff", "bazzi", "mtl"};
  std::vector<std::string> names = comparison::any_method_names();
  std::erase_if(names, [&elsewhere](const std::string& name) {
    return std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end();
  });
  return names;
}

}  // namespace nlmech::chapters::rbf_ivp
