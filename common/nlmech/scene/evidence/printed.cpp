#include "nlmech/scene/evidence/printed.hpp"

#include <stdexcept>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::scene {

Printed::Printed() {
  for (const PublishedValue& value : read_published(data_folder())) values_[value.name()] = value.value;
}

double Printed::operator[](const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw std::logic_error("no source prints " + name);
  return found->second;
}

}  // namespace nlmech::scene
