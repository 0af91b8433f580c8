/// On a forge every link of a page leads to a file that is there, and to a part of it that is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::forge_pages_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = NLMECH_SOURCE_DIR;

/// What git tracks, folders included; all that is there where git knows nothing of the folder.
std::set<std::string> tracked() {
  std::set<std::string> files;
  const scene::Finished listed =
      scene::run_program({"git", "ls-files", "--cached", "--others", "--exclude-standard"}, source);
  for (const std::string& line : lines_in(listed.output)) {
    for (fs::path file = line; !file.empty(); file = file.parent_path()) files.insert(file.generic_string());
  }
  return files;
}

/// A page without its code.
std::string prose(const fs::path& page) {
  std::string text;
  bool code = false;
  for (const std::string& line : lines_in(text_of(page))) {
    if (line.find("```") != std::string::npos)
      code = !code;
    else if (!code)
      text += line + "\n";
  }
  return std::regex_replace(text, std::regex("`[^`\n]*`"), "");
}

/// Where links to a part of the page can lead: its marks, and its headings as forges name them.
std::set<std::string> parts(const fs::path& page) {
  static const std::regex mark("<a id=\"([^\"]+)\">"), heading("(?:^|\n)#+ ([^\n]+)");
  const std::string text = text_of(page);
  std::set<std::string> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), mark); at != std::sregex_iterator(); ++at)
    EXPECT_TRUE(found.insert((*at)[1]).second) << page << " has two marks " << (*at)[1];
  for (auto at = std::sregex_iterator(text.begin(), text.end(), heading); at != std::sregex_iterator();
       ++at) {
    std::string name;
    for (const char c : (*at)[1].str()) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      else if (c == ' ')
        name += '-';
    }
    found.insert(name);
  }
  return found;
}

std::vector<std::string> pages() {
  std::vector<std::string> found = {"README.md",       "CONTRIBUTING.md",      "CHANGELOG.md",
                                    "KNOWN_ISSUES.md", "docs/architecture.md", "docs/glossary.md"};
  for (const char* folder : {"docs/chapters", "tables"}) {
    for (const auto& file : fs::directory_iterator(source / folder)) {
      if (file.path().extension() == ".md")
        found.push_back(std::string(folder) + "/" + file.path().filename().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

class ForgePages : public ::testing::TestWithParam<std::string> {};

TEST_P(ForgePages, LinkToWhatIsThere) {
  static const std::regex link(R"(\]\(([^)#: ]*)(?:#([^) ]*))?\))");
  const std::set<std::string> there = tracked();
  const std::string text = prose(source / GetParam());
  for (auto at = std::sregex_iterator(text.begin(), text.end(), link); at != std::sregex_iterator(); ++at) {
    const std::string path = (*at)[1], part = (*at)[2];
    const fs::path file =
        path.empty() ? fs::path(GetParam()) : (fs::path(GetParam()).parent_path() / path).lexically_normal();
    const bool is_there = fs::exists(source / file);
    EXPECT_TRUE(is_there && (there.empty() || there.contains(file.generic_string())))
        << GetParam() << " links to " << file;
    if (!is_there || part.empty()) continue;
    EXPECT_TRUE(parts(source / file).contains(part)) << GetParam() << " links to " << file << "#" << part;
  }
}

/// Nothing is left of what only the book understands.
TEST_P(ForgePages, AreMarkdown) {
  const std::string text = prose(source / GetParam());
  for (const char* words : {"{{", "[@", "\\f$", "\\f[", "\\snippet", "{#", "@ref"})
    EXPECT_EQ(text.find(words), std::string::npos) << GetParam() << ": " << text.substr(text.find(words), 80);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]"), "_");
}

INSTANTIATE_TEST_SUITE_P(Forge, ForgePages, ::testing::ValuesIn(pages()), test_name);

}  // namespace
}  // namespace nlmech::tests::forge_pages_test
