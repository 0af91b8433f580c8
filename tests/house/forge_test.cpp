/// What forges, archives and Docker read of the project says what the project says, and runs what CI runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "nlmech/scene/build_info.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::forge_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = NLMECH_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::string text;
  for (const std::string& line : lines_of(source / file)) text += line + "\n";
  return text;
}

/// What a line holds behind these words; empty if none begins so.
std::string after(const fs::path& file, const std::string& words) {
  for (const std::string& line : lines_of(source / file)) {
    if (line.starts_with(words)) return line.substr(words.size());
  }
  return "";
}

/// The first groups of all matches.
std::vector<std::string> found(const std::string& text, const std::regex& form) {
  std::vector<std::string> all;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), form); at != std::sregex_iterator(); ++at)
    all.push_back((*at)[1]);
  return all;
}

TEST(Codemeta, SaysWhatCitationAndBuildSay) {
  const nlohmann::json meta = nlohmann::json::parse(text_of("codemeta.json"));
  EXPECT_EQ(meta["version"], scene::build_info().version);
  EXPECT_EQ(meta["version"], after("CITATION.cff", "version: "));
  EXPECT_EQ(meta["license"], "https://spdx.org/licenses/" + after("CITATION.cff", "license: "));
  EXPECT_TRUE(text_of("LICENSE").starts_with(after("CITATION.cff", "license: ") + " License\n"));
  EXPECT_EQ(meta["description"],
            found(text_of("CMakeLists.txt"), std::regex("DESCRIPTION \"([^\"]+)\"")).at(0));
  EXPECT_EQ("nlmech: " + after("CITATION.cff", "title: \"nlmech: "),
            "nlmech: n" + meta["description"].get<std::string>().substr(1) + "\"");
  // Authors before the works that are cited as references.
  const std::string citation = text_of("CITATION.cff");
  std::vector<std::string> authors;
  for (const auto& author : meta["author"]) authors.push_back(author["name"]);
  EXPECT_EQ(authors,
            found(citation.substr(0, citation.find("references:")), std::regex("  - name: \"([^\"]+)\"")));
  EXPECT_NE(text_of("LICENSE").find("the nlmech authors"), std::string::npos);
  const std::vector<std::string> keywords = meta["keywords"];
  const auto begin = citation.find("keywords:"), end = citation.find("references:");
  EXPECT_EQ(keywords, found(citation.substr(begin, end - begin), std::regex("  - ([^\n]+)")));
}

/// Targets of the Makefile that a file calls are there, and CI calls them before a change lands.
void expect_run_by_ci(const fs::path& file, std::size_t least) {
  const auto targets = found(text_of(file), std::regex("(?:RUN|run:) make ([a-z]+)\n"));
  EXPECT_GE(targets.size(), least) << file;
  for (const std::string& target : targets) {
    EXPECT_NE(text_of("Makefile").find("\n" + target + ": "), std::string::npos)
        << file << ": make " << target;
    EXPECT_NE(text_of(".ci/run").find("make " + target), std::string::npos) << file << ": make " << target;
  }
}

TEST(Dockerfile, RunsWhatCiRuns) {
  expect_run_by_ci("Dockerfile", 1);
  // Its second stage is a command that the trial in a bare root runs there.
  EXPECT_NE(text_of("Dockerfile").find("RUN /tmp/package install /tmp/nlmech.deb"), std::string::npos);
  EXPECT_NE(text_of("scripts/package").find("inside \"$root\" /tmp/package install /tmp/nlmech.deb"),
            std::string::npos);
  EXPECT_NE(text_of(".ci/run").find("scripts/package try"), std::string::npos);
  for (const std::string& copied : found(text_of("Dockerfile"), std::regex("COPY (scripts/\\S+)")))
    EXPECT_TRUE(fs::exists(source / copied)) << copied;
}

TEST(Workflow, TestsAndPublishesByCommandsOfTheProject) {
  const fs::path workflow = ".github/workflows/test.yml";
  expect_run_by_ci(workflow, 3);
  EXPECT_NE(text_of(workflow).find("run: make test\n"), std::string::npos);
  EXPECT_NE(text_of(workflow).find("path: build/book/html\n"), std::string::npos);
}

}  // namespace
}  // namespace nlmech::tests::forge_test
