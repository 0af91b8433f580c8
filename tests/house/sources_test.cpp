/// What may stand in the sources: who includes whom, how long a file is, no macros; and what the programs are
/// linked with.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::sources_test {
namespace {

namespace fs = std::filesystem;

/// A component, what it uses, and what those use in turn. Follows no circle twice.
void reach(const Uses& uses, const std::string& component, std::set<std::string>& reached) {
  if (!reached.insert(component).second) return;
  const auto found = uses.find(component);
  if (found == uses.end()) throw std::runtime_error("components.txt does not list " + component);
  for (const std::string& used : found->second) reach(uses, used, reached);
}

struct Include {
  std::string component;  ///< that includes
  std::string what;       ///< "nlmech/geodesy/ellipsoid.hpp"
  std::string where;      ///< file and line
};

std::vector<Include> includes() {
  const fs::path library = fs::path(NLMECH_SOURCE_DIR) / "common/nlmech";
  const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<Include> found;
  for (const fs::path& file : sources_under("common/nlmech")) {
    if (file.parent_path() == library) continue;  // lists the components
    const auto lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_search(lines[i], match, pattern)) continue;
      const fs::path relative = file.lexically_relative(library);
      found.push_back(
          {relative.begin()->string(), match[1], relative.string() + ":" + std::to_string(i + 1)});
    }
  }
  return found;
}

TEST(Components, AreThereAsFolders) {
  const Uses uses = components();
  EXPECT_TRUE(uses.contains("support"));
  EXPECT_TRUE(uses.contains("scene"));
  for (const auto& [component, used] : uses) {
    EXPECT_TRUE(fs::is_directory(fs::path(NLMECH_SOURCE_DIR) / "common/nlmech" / component)) << component;
    for (const std::string& other : used) EXPECT_TRUE(uses.contains(other)) << component << " uses " << other;
  }
}

TEST(Components, UseEachOtherWithoutCircles) {
  const Uses uses = components();
  for (const auto& [component, used] : uses) {
    for (const std::string& other : used) {
      std::set<std::string> reached;
      reach(uses, other, reached);
      EXPECT_FALSE(reached.contains(component))
          << component << " uses " << other << ", which uses " << component;
    }
  }
}

TEST(Components, IncludeOnlyWhatTheyUse) {
  const Uses uses = components();
  int checked = 0;
  for (const Include& include : includes()) {
    if (!include.what.starts_with("nlmech/") || !uses.contains(include.component)) continue;
    std::set<std::string> allowed;
    reach(uses, include.component, allowed);
    const std::string other = (++fs::path(include.what).begin())->string();
    if (!uses.contains(other)) continue;  // not in this build, and neither is the peer that includes it
    EXPECT_TRUE(allowed.contains(other)) << include.where << " includes " << include.what << "; "
                                         << include.component << " does not use " << other;
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

TEST(Components, IncludeEachOtherByTheirFullNames) {
  for (const Include& include : includes()) {
    const fs::path beside = fs::path(NLMECH_SOURCE_DIR) / "common/nlmech" / include.component / include.what;
    EXPECT_FALSE(fs::exists(beside)) << include.where << ": say nlmech/" << include.component << "/"
                                     << include.what;
    EXPECT_EQ(include.what.find(".."), std::string::npos) << include.where;
  }
}

TEST(Components, KnowNothingOfScenesAndCommandLines) {
  for (const Include& include : includes()) {
    // The two top floors: scenes, and what all chapters on initial value problems show with them.
    if (include.component == "scene" || include.component == "comparison") continue;
    EXPECT_FALSE(include.what.starts_with("nlmech/scene/")) << include.where << " includes " << include.what;
    EXPECT_FALSE(include.what.starts_with("CLI/")) << include.where << " includes " << include.what;
    EXPECT_FALSE(include.what.starts_with("nlohmann/")) << include.where << " includes " << include.what;
  }
}

TEST(Sources, AreShort) {
  for (const char* folder : {"common", "chapters", "tests", "tools"}) {
    for (const fs::path& file : sources_under(folder)) EXPECT_LE(lines_of(file).size(), 800U) << file;
  }
}

TEST(Sources, DefineNoFunctionMacros) {
  const std::regex macro(R"(^\s*#\s*define\s+\w+\()");
  for (const char* folder : {"common", "chapters", "tools"}) {
    for (const fs::path& file : sources_under(folder)) {
      for (const std::string& line : lines_of(file))
        EXPECT_FALSE(std::regex_search(line, macro)) << file << ": " << line;
    }
  }
}

TEST(Headers, BeginWithTheirGuardAndTheirWords) {
  for (const char* folder : {"common", "chapters", "tools"}) {
    for (const fs::path& file : sources_under(folder)) {
      if (file.extension() != ".hpp") continue;
      const auto lines = lines_of(file);
      EXPECT_TRUE(!lines.empty() && lines[0] == "/// @file") << file;
      EXPECT_EQ(std::count(lines.begin(), lines.end(), "#pragma once"), 1) << file;
    }
  }
}

/// A file of tests that no CMakeLists.txt names is not compiled, and nobody misses it.
TEST(Tests, AreAllCompiled) {
  std::set<fs::path> named;
  for (const fs::path& list : sources_under("tests")) {
    if (list.filename() != "CMakeLists.txt") continue;
    std::ifstream in(list);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const std::string& word : words_of(std::regex_replace(text, std::regex("[()]"), " "))) {
      if (word.ends_with("_test.cpp")) named.insert((list.parent_path() / word).lexically_normal());
    }
  }
  for (const fs::path& file : sources_under("tests")) {
    if (file.string().ends_with("_test.cpp")) {
      EXPECT_TRUE(named.contains(file)) << file;
    }
  }
  EXPECT_GT(named.size(), 200U);
}

/// The shared libraries that a program asks for.
std::string libraries_of(const std::string& program) {
  const scene::Finished ldd = scene::run_program({"ldd", program}, {});
  EXPECT_EQ(ldd.exit_code, 0) << ldd.errors;
  std::string names = ldd.output;
  std::transform(names.begin(), names.end(), names.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return names;
}

TEST(Programs, LinkOnlyWhatTheyUse) {
  const auto built = chapters();
  if (std::find(built.begin(), built.end(), "geodesy") == built.end()) GTEST_SKIP() << "geodesy is not built";
  const std::string libraries = libraries_of(NLMECH_BINARY_DIR "/bin/geodesy");
  EXPECT_NE(libraries.find("libc.so"), std::string::npos) << libraries;
  for (const char* foreign : {"sundials", "gsl", "boost", "ipopt"}) {
    EXPECT_EQ(libraries.find(foreign), std::string::npos) << foreign << " in\n" << libraries;
  }
}

}  // namespace
}  // namespace nlmech::tests::sources_test
