/// Every command that README, CONTRIBUTING and the chapters' pages print is run as a reader would type it, in
/// a folder with the build and the chapters, or is one of a stated few that something else runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <regex>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::printed_commands_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = NLMECH_SOURCE_DIR;

/// A line of a page's ```sh block.
struct Command {
  std::string line;
  int number = 0;  ///< of the line on the page
};

std::vector<Command> commands_of(const fs::path& page) {
  std::vector<Command> commands;
  for (const Block& block : blocks_of(page)) {
    if (block.language != "sh") continue;
    int number = block.line;
    bool goes_on = false;  // the line before ended with a backslash
    for (const std::string& line : block.lines) {
      ++number;
      if (goes_on)
        commands.back().line += "\n" + line;
      else if (!line.empty() && !line.starts_with("#"))
        commands.push_back({line, number});
      goes_on = line.ends_with("\\");
    }
  }
  return commands;
}

/// The program of the build that a line calls; empty if it calls none.
std::string program_of(const std::string& line) {
  static const std::regex call(R"(\bbuild/bin/([a-z0-9_]+))");
  std::smatch match;
  return std::regex_search(line, match, call) ? match[1].str() : "";
}

std::vector<std::string> chapters() {
  std::vector<std::string> names = lines_in(text_of(NLMECH_BINARY_DIR "/chapters.txt"));
  std::erase(names, "");
  return names;
}

/// README, CONTRIBUTING, and the pages of the chapters of this build.
std::vector<std::string> pages() {
  std::vector<std::string> found = {"README.md", "CONTRIBUTING.md"};
  for (const std::string& chapter : chapters())
    found.push_back("chapters/" + chapter + "/" + chapter + ".md");
  return found;
}

class PrintedCommands : public ::testing::TestWithParam<std::string> {};

TEST_P(PrintedCommands, EndWithZero) {
  const fs::path page = source / GetParam();
  std::string name = page.stem().string();
  const fs::path folder = fs::temp_directory_path() / ("nlmech-" + name + std::to_string(::getpid()));
  fs::create_directories(folder);
  fs::create_directory_symlink(NLMECH_BINARY_DIR, folder / "build");
  fs::create_directory_symlink(source / "chapters", folder / "chapters");
  int run = 0;
  for (const Command& command : commands_of(page)) {
    const std::string program = program_of(command.line);
    if (program.empty()) continue;
    ++run;
    // README speaks of all chapters, a build may have fewer.
    if (GetParam() == "README.md" && !fs::exists(fs::path(NLMECH_BINARY_DIR "/bin") / program)) continue;
    const scene::Finished f = scene::run_program({"sh", "-c", command.line}, folder);
    EXPECT_EQ(f.exit_code, 0) << GetParam() << ":" << command.number << ": " << command.line << "\n"
                              << f.errors;
  }
  EXPECT_TRUE(run > 0 || GetParam() == "CONTRIBUTING.md") << GetParam() << " calls no program";
  fs::remove_all(folder);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& page) {
  return fs::path(page.param).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Pages, PrintedCommands, ::testing::ValuesIn(pages()), test_name);

/// Commands that call no program of the build, and who runs them: a file in which words of theirs stand.
struct Elsewhere {
  const char* pattern;  ///< the whole line matches
  const char* file;     ///< from the top of the project
  const char* words;    ///< $1 is the pattern's first group
};

constexpr std::array elsewhere = {
    // Targets of the Makefile, and its words.
    Elsewhere{R"(make ([a-z]+)( [A-Z_]+=\S+)*( +#.*)?)", "Makefile", "\n$1: "},
    Elsewhere{R"(make (chapter-)[a-z_]+( [A-Z_]+=\S+)*( +#.*)?)", "Makefile", "\n$1%: "},
    // What `make oracles` runs, and its sister that keeps the rows.
    Elsewhere{R"((scripts/oracles) (record|uses).*)", "Makefile", "$1"},
    // Installing and building on it: README alone, whose lines that test runs.
    Elsewhere{R"((cmake --install|cmake -S|cmake --build build-mine|build-mine/).*)",
              "tests/consumer/consumer_test.cmake", "cmake |build-mine/"},
    // Installing the package, in a bare root: what Dockerfile does with it.
    Elsewhere{R"(sudo (apt-get install) \./build/nlmech_\*\.deb)", "scripts/package", "$1"},
    Elsewhere{R"(docker build -t nlmech \.)", "Dockerfile", "RUN /tmp/package install"},
    // Parts of what runs before a change lands.
    Elsewhere{R"((cmake --preset (dev|asan)))", ".ci/run", "$1"},
    Elsewhere{R"(cmake --build build(-asan)? --target (unit_tests_)[a-z]+)", "tests/CMakeLists.txt", "$2"},
    Elsewhere{R"((ctest --test-dir) build.*)", ".ci/run", "$1"},
    Elsewhere{R"((\.ci/run))", ".ci/run", "#!"},
    Elsewhere{R"((git ls-files '\*\.hpp' '\*\.cpp' \| xargs clang-format) -i)", ".ci/run", "$1"},
    Elsewhere{R"((clang-tidy -p build-dev --quiet --checks=-clang-analyzer-\*) \S+)", ".ci/run", "$1"},
};

bool runs_elsewhere(const std::string& line) {
  for (const Elsewhere& known : elsewhere) {
    std::smatch match;
    if (!std::regex_match(line, match, std::regex(known.pattern))) continue;
    const std::string words = match.format(known.words);
    if (text_of(source / known.file).find(words) != std::string::npos) return true;
  }
  return false;
}

TEST(PrintedCommandsElsewhere, AreOfTheStatedKinds) {
  for (const char* page : {"README.md", "CONTRIBUTING.md"}) {
    for (const Command& command : commands_of(source / page)) {
      if (!program_of(command.line).empty()) continue;
      EXPECT_TRUE(runs_elsewhere(command.line))
          << page << ":" << command.number << ": nothing runs " << command.line;
    }
  }
}

/// The two commands of README are steps of what runs before a change lands.
TEST(PrintedCommandsElsewhere, ThatReadmeBeginsWithAreRunAtEveryChange) {
  const std::string steps = text_of(source / ".ci/run");
  const std::vector<Command> commands = commands_of(source / "README.md");
  ASSERT_GE(commands.size(), 2U);
  for (const char* target : {"figures", "test"}) {
    EXPECT_TRUE(commands[0].line.starts_with(std::string("make ") + target) ||
                commands[1].line.starts_with(std::string("make ") + target));
    EXPECT_TRUE(std::regex_search(steps, std::regex(std::string("step \\w+ make (-j2 )?") + target)))
        << target;
  }
}

TEST(PrintedCommandsElsewhere, KnowTheirTargets) {
  EXPECT_TRUE(runs_elsewhere("make figures   # a remark"));
  EXPECT_FALSE(runs_elsewhere("make breakfast"));
  EXPECT_FALSE(runs_elsewhere("rm -rf build"));
}

TEST(PrintedExamples, OfTheGeodesyPageRuns) {
  const fs::path program = NLMECH_BINARY_DIR "/bin/geodesy_example";
  if (!fs::exists(program)) GTEST_SKIP() << "geodesy is not built";
  const scene::Finished f = scene::run_program({program.string()}, {});
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_TRUE(f.output.starts_with("success: latitude 21.52"))
      << f.output;  // atan(2.5/6.379) = 21.40 deg plus the flattening
}

}  // namespace
}  // namespace nlmech::tests::printed_commands_test
