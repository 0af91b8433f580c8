/// @file
/// `homotopy frame` as tests run it: files, rows, columns.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_frame {

using scene::Finished;

inline Finished frame(const std::string& file, const std::vector<std::string>& words = {}) {
  std::vector<std::string> all = {NLMECH_BINARY_DIR "/bin/homotopy", "frame", file};
  all.insert(all.end(), words.begin(), words.end());
  return scene::run_program(all, {});
}

/// A file of this process with a text.
inline std::string written(const std::string& text) {
  std::string file = testing::TempDir() + "own_frame_" + std::to_string(::getpid()) + ".toml";
  scene::write_whole(file, text);
  return file;
}

inline std::string shipped(const std::string& name) {
  return NLMECH_SOURCE_DIR "/chapters/homotopy/frames/" + name + ".toml";
}

inline double number(const std::string& text) {
  double value = NAN;
  EXPECT_TRUE(scene::parse_number(text, value)) << text;
  return value;
}

using Rows = std::vector<scene::CsvRecord>;

/// The rows of a path, head included; it has to come to its end.
inline Rows path_of(const std::string& file, const std::vector<std::string>& words = {}) {
  const Finished f = frame(file, words);
  EXPECT_EQ(f.exit_code, 0) << file << ": " << f.errors;
  return scene::parse_csv(f.output, "output");
}

inline std::size_t column(const Rows& rows, const std::string& name) {
  const auto& head = rows.at(0).cells;
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (head[i] == name) return i;
  }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

/// Load factors of the rows of a kind.
inline std::vector<double> loads(const Rows& rows, const std::string& kind) {
  std::vector<double> all;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].cells.back() == kind) all.push_back(number(rows[i].cells.at(column(rows, "load_factor"))));
  }
  return all;
}

inline constexpr const char* beam = R"([nodes]
A = [0, 0]
B = [1, 0]
[[members]]
nodes = ["A", "B"]
EA = 1000
EI = 1
[supports]
A = ["x", "y", "rotation"]
[loads]
B = { y = -1 }
)";

inline std::string with(std::string text, const std::string& old, const std::string& other) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), other);
}

}  // namespace nlmech::own_frame
