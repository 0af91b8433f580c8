/// @file
/// Printed numbers by name, for code that computes with them: they stand in `tables/published` alone.
#pragma once

#include <map>
#include <string>

namespace nlmech::scene {

/// All numbers that the sources print.
class Printed {
 public:
  /// Reads them. @throws InputError naming file, line and cell
  Printed();
  /// @param name as PublishedValue::name() @throws std::logic_error if no source prints it
  [[nodiscard]] double operator[](const std::string& name) const;

 private:
  std::map<std::string, double> values_;
};

}  // namespace nlmech::scene
