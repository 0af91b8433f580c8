#include "nlmech/comparison/any_method.hpp"

#include <fmt/format.h>

#include <span>

#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {

std::vector<std::string> any_method_names() {
  std::vector<std::string> names;
  for (const auto& methods : {ivp::named_methods(), peers::peer_methods()}) {
    for (const ivp::MethodInfo& method : methods) names.emplace_back(method.name);
  }
  return names;
}

std::vector<std::string> built_method_names() {
  std::vector<std::string> names = any_method_names();
  std::erase_if(names, [](const std::string& name) { return !any_method(name).is_available(); });
  return names;
}

const ivp::MethodInfo& any_method(std::string_view name) {
  for (const auto& methods : {ivp::named_methods(), peers::peer_methods()}) {
    for (const ivp::MethodInfo& method : methods) {
      if (method.name == name) return method;
    }
  }
  throw invalid_argument("there is no method '{}'; choose one of {}", name,
                         fmt::join(any_method_names(), ", "));
}

}  // namespace nlmech::comparison
