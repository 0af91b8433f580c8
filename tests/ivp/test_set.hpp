/// @file
/// Published end states of the test set for initial value problems.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/places.hpp"

namespace nlmech::oracle {

/// End state of a problem: "HIRES", "Robertson", "van der Pol". @throws std::runtime_error if there is none
[[nodiscard]] inline std::vector<double> published_end_state(const std::string& problem) {
  std::ifstream in(NLMECH_SOURCE_DIR "/tables/reference/ivp_test_set.csv");
  std::vector<double> values;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(problem + ",")) values.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  }
  if (values.empty()) throw std::runtime_error("ivp_test_set.csv has no end state of " + problem);
  return values;
}

}  // namespace nlmech::oracle
