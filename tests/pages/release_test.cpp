/// The version stands in CMakeLists.txt; whatever else names it says the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

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

/// An image is built of what .dockerignore lets through, and `make clean` leaves what git tracks.
TEST(Release, KeepsTheFoldersThatGitTracks) {
  const scene::Finished listed = scene::run_program({"git", "ls-files", "figures", "tables"}, source);
  std::set<std::string> folders;
  for (const std::string& file : lines_in(listed.output)) {
    if (std::count(file.begin(), file.end(), '/') > 1) folders.insert(file.substr(0, file.rfind('/')));
  }
  const std::string ignored = text_of(source / ".dockerignore"), makefile = text_of(source / "Makefile"),
                    clean = makefile.substr(makefile.find("\nclean:"));
  for (const std::string& folder : folders) {
    const std::string top = folder.substr(0, folder.find('/', folder.find('/') + 1));
    EXPECT_NE(("\n" + ignored).find("\n!" + top + "\n"), std::string::npos) << ".dockerignore: " << top;
    EXPECT_NE(clean.find(" ! -name " + top.substr(top.find('/') + 1) + " "), std::string::npos)
        << "clean: " << top;
  }
}

TEST(Release, HasALicenceThatTheCitationNames) {
  EXPECT_EQ(line_of(source / "LICENSE", "MIT License"), "MIT License");
  EXPECT_EQ(line_of(source / "CITATION.cff", "license:"), "license: MIT");
}

}  // namespace
}  // namespace nlmech::tests::release_test
