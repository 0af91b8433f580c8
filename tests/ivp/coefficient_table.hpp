// A table of coefficients with all its digits, tables/reference/<name>.csv, for tests of the headers that are
// generated from it.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "tests/ivp/oracle.hpp"
#include "tests/places.hpp"

namespace nlmech::ivp::testing {

class CoefficientTable {
 public:
  // Expects `count` rows.
  CoefficientTable(const std::string& name, std::size_t count) {
    std::ifstream file(NLMECH_SOURCE_DIR "/tables/reference/" + name + ".csv");
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#' || line.starts_with("symbol")) continue;
      const auto last = line.rfind(',');
      values_[line.substr(0, last)] = line.substr(last + 1);
    }
    EXPECT_EQ(values_.size(), count);
  }
  // All digits of the row `key`, which is "symbol,i,j"; 0 if there is no such row.
  [[nodiscard]] oracle::Real get(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? oracle::Real(0) : oracle::Real(found->second);
  }
  // Expects that `mine` is the row rounded to double, or 0 if there is no such row.
  void expect_rounded(double mine, const std::string& key) {
    const auto found = values_.find(key);
    EXPECT_EQ(mine, found == values_.end() ? 0 : std::strtod(found->second.c_str(), nullptr)) << key;
    compared_ += found != values_.end();
  }
  // Expects that every row was compared.
  void expect_all_compared() const { EXPECT_EQ(compared_, values_.size()); }

 private:
  std::map<std::string, std::string> values_;
  std::size_t compared_ = 0;
};

}  // namespace nlmech::ivp::testing
