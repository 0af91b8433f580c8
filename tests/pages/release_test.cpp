/// The version stands in CMakeLists.txt; whatever else names it says the same.
#include <gtest/gtest.h>

#include <algorithm>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::release_test {
namespace {

const std::string version = NLMECH_VERSION;
const std::filesystem::path source = NLMECH_SOURCE_DIR;

/// The first line of a file that begins with @p words; empty if there is none.
std::string line_of(const std::filesystem::path& file, const std::string& words) {
  for (const std::string& line : lines_in(text_of(file))) {
    if (line.starts_with(words)) return line;
  }
  return "";
}

TEST(Release, IsNamedByTheCitation) {
  EXPECT_EQ(line_of(source / "CITATION.cff", "version:"), "version: " + version);
}

TEST(Release, IsTheNewestOfTheChangelog) {
  EXPECT_EQ(line_of(source / "CHANGELOG.md", "## ").substr(0, 3 + version.size()), "## " + version);
}

TEST(Release, IsWhatReadmeTellsToLookFor) {
  const std::string asked = "find_package(nlmech " + version.substr(0, version.rfind('.')) + " ";
  EXPECT_NE(line_of(source / "README.md", asked), "") << asked;
}

TEST(Release, HasALicenceThatTheCitationNames) {
  EXPECT_EQ(line_of(source / "LICENSE", "MIT License"), "MIT License");
  EXPECT_EQ(line_of(source / "CITATION.cff", "license:"), "license: MIT");
}

}  // namespace
}  // namespace nlmech::tests::release_test
