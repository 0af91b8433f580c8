/// What README shows and counts is what the programs show and count today.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::readme_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = NLMECH_SOURCE_DIR;

/// The only block of a language in README.
Block block(const std::string& language) {
  std::vector<Block> found = blocks_of(source / "README.md");
  std::erase_if(found, [&](const Block& b) { return b.language != language; });
  EXPECT_EQ(found.size(), 1U) << "blocks of " << language;
  return found.empty() ? Block{} : found.front();
}

/// The lines between the two markers of an example.
std::vector<std::string> example(const fs::path& file) {
  std::vector<std::string> lines = lines_in(text_of(file));
  const auto marker = [](const std::string& line) { return line == "// [example]"; };
  const auto first = std::find_if(lines.begin(), lines.end(), marker);
  if (first == lines.end()) return {};
  return {first + 1, std::find_if(first + 1, lines.end(), marker)};
}

std::string trimmed(const std::string& line) {
  const auto begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

TEST(Readme, ShowsTheExampleAsItIsCompiled) {
  EXPECT_EQ(block("cpp").lines, example(source / "examples/every_integrator.cpp"))
      << "README's block and examples/every_integrator.cpp differ";
}

TEST(Readme, LinksAsTheExamplesDo) {
  const std::vector<std::string> used = lines_in(text_of(source / "examples/CMakeLists.txt"));
  for (const std::string& line : block("cmake").lines) {
    EXPECT_TRUE(std::any_of(used.begin(), used.end(), [&](const auto& u) { return trimmed(u) == line; }))
        << "examples/CMakeLists.txt has no line " << line;
  }
}

/// A few lines of the example's output, within a factor of two in their numbers: compilers round differently.
TEST(Readme, PrintsWhatTheExampleSays) {
  const fs::path program = NLMECH_BINARY_DIR "/bin/every_integrator";
  if (!fs::exists(program)) GTEST_SKIP() << "the floors for integration are not built";
  const scene::Finished run = scene::run_program({program.string()}, {});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const auto close = [](double a, double b) { return a == b || (a > b / 2 && a < 2 * b); };
  for (const std::string& line : block("text").lines) {
    const auto said = lines_in(run.output);
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), [&](const auto& s) { return alike(s, line, close); }))
        << line << "\nis not among\n"
        << run.output;
  }
}

/// The cells of a row of a Markdown table, without blanks at their ends.
std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> found;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const auto begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    found.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return found;
}

/// The sums of the columns of the first table of tables/REPRODUCTION.md, as README prints them.
std::string verdicts() {
  std::vector<std::string> names;
  std::vector<long> sums;
  for (const std::string& line : lines_in(text_of(source / "tables/REPRODUCTION.md"))) {
    if (!line.starts_with("|")) {
      if (!names.empty()) break;
      continue;
    }
    const auto row = cells(line);
    if (names.empty()) {
      names.assign(row.begin() + 1, row.end());
      sums.assign(names.size(), 0);
    } else if (!row[0].starts_with(":")) {
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += std::stol(row.at(i + 1));
    }
  }
  std::string head = "|", rule = "|", body = "|";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (sums[i] == 0) continue;
    head += " " + names[i] + " |";
    rule += " ---: |";
    body += " " + std::to_string(sums[i]) + " |";
  }
  return head + "\n" + rule + "\n" + body + "\n";
}

TEST(Readme, CountsTheVerdictsOfTheReproduction) {
  const std::string page = text_of(source / "README.md"), begin = "<!-- verdicts -->\n", end = "<!-- end -->";
  const auto from = page.find(begin), to = page.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()), verdicts())
      << "put the second text between the markers of README.md";
}

/// Every file that a page of the top folder links to is there; what is generated needs no link.
TEST(Readme, LinksToFilesThatExist) {
  const std::regex link(R"(\]\(([^)#:]+)\))");
  for (const char* page : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "KNOWN_ISSUES.md"}) {
    std::string text;
    bool code = false;
    for (const std::string& line : lines_in(text_of(source / page))) {
      if (trimmed(line).starts_with("```")) code = !code;
      if (!code) text += line + "\n";
    }
    for (auto at = std::sregex_iterator(text.begin(), text.end(), link); at != std::sregex_iterator(); ++at)
      EXPECT_TRUE(fs::exists(source / (*at)[1].str())) << page << " links to " << (*at)[1].str();
  }
}

}  // namespace
}  // namespace nlmech::tests::readme_test
