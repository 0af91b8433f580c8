/// Every command that README, CONTRIBUTING and the chapters' pages print is run as a reader would type it, in
/// a folder with the build and the chapters, or is one of a stated few that something else runs. On the
/// chapters' pages each stands with its output, as scripts/book/outputs.py writes it there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/pages/printed_output.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::printed_commands_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = NLMECH_SOURCE_DIR;

/// A command of a page's ```sh block.
struct Command {
  std::string line;
  int number = 0;  ///< of the line on the page
};

std::vector<Command> commands_of(const Block& block) {
  std::vector<Command> commands;
  if (block.language != "sh") return commands;
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
  return commands;
}

std::vector<Command> commands_of(const fs::path& page) {
  std::vector<Command> commands;
  for (const Block& block : blocks_of(page)) {
    for (Command& command : commands_of(block)) commands.push_back(std::move(command));
  }
  return commands;
}

/// The block of output that stands next below a line; nullptr if there is none.
const Block* output_below(const std::vector<Block>& blocks, int line) {
  const auto next = std::ranges::find_if(blocks, [&](const Block& b) { return b.line == line + 2; });
  return next != blocks.end() && next->language == "text" ? &*next : nullptr;
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

class PrintedCommands : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nlmech-" + page_.stem().string() + std::to_string(::getpid()));
    fs::create_directories(folder_);
    fs::create_directory_symlink(NLMECH_BINARY_DIR, folder_ / "build");
    fs::create_directory_symlink(source / "chapters", folder_ / "chapters");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// What a command prints, which must succeed. README speaks of all chapters, a build may have fewer.
  [[nodiscard]] std::optional<std::string> run(const Command& command, const std::string& program) const {
    if (GetParam() == "README.md" && !fs::exists(fs::path(NLMECH_BINARY_DIR "/bin") / program)) return {};
    const scene::Finished f = scene::run_program({"sh", "-c", command.line}, folder_);
    EXPECT_EQ(f.exit_code, 0) << place(command.number) << command.line << "\n" << f.errors;
    return f.output;
  }
  [[nodiscard]] std::string place(int line) const { return GetParam() + ":" + std::to_string(line) + ": "; }

  const fs::path page_ = source / GetParam();
  fs::path folder_;
};

TEST_P(PrintedCommands, EndWithZeroAndStandWithTheirOutput) {
  const bool with_output = GetParam().starts_with("chapters/");
  const std::vector<Block> blocks = blocks_of(page_);
  int calls = 0;
  for (const Block& block : blocks) {
    std::string output;
    int of_block = 0;
    for (const Command& command : commands_of(block)) {
      const std::string program = program_of(command.line);
      if (program.empty()) continue;
      ++of_block;
      output += run(command, program).value_or("");
    }
    calls += of_block;
    if (!with_output || output.empty()) continue;
    EXPECT_EQ(of_block, 1) << place(block.line) << "a command a block, for its output stands below";
    const Block* printed = output_below(blocks, block.line + static_cast<int>(block.lines.size()) + 1);
    ASSERT_NE(printed, nullptr) << place(block.line) << "no ```text block with the output stands below";
    EXPECT_EQ(differs_from(output, printed->lines), "") << place(printed->line) << "scripts/book/outputs.py";
  }
  EXPECT_TRUE(calls > 0 || GetParam() == "CONTRIBUTING.md") << GetParam() << " calls no program";
}

/// The program of a chapter, and those of examples/, where a page shows their code.
TEST_P(PrintedCommands, ShowTheOutputOfExamples) {
  static const std::regex snippet(R"(\\snippet (?:chapters/(\w+)/example|examples/(\w+))\.cpp example)");
  const std::vector<Block> blocks = blocks_of(page_);
  int number = 0;
  for (const std::string& line : lines_in(text_of(page_))) {
    ++number;
    std::smatch match;
    if (!std::regex_match(line, match, snippet)) continue;
    const fs::path program = fs::path(NLMECH_BINARY_DIR "/bin") /
                             (match[1].matched ? match[1].str() + "_example" : match[2].str());
    const Block* printed = output_below(blocks, number);
    ASSERT_NE(printed, nullptr) << place(number) << "no ```text block with the output stands below";
    if (!fs::exists(program)) continue;  // of another chapter's components
    const scene::Finished f = scene::run_program({program.string()}, {});
    EXPECT_EQ(f.exit_code, 0) << f.errors;
    EXPECT_EQ(differs_from(f.output, printed->lines), "")
        << place(printed->line) << "scripts/book/outputs.py";
  }
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
    Elsewhere{R"((cmake --preset asan))", ".ci/run", "$1"},
    Elsewhere{R"((scripts/lint) HEAD~1)", ".ci/run", "$1 "},
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

TEST(PrintedOutput, MayDifferByRoundingAndInRunTimes) {
  const std::string output = "method,error,seconds,steps\nrk4,1.0e-5,0.5,1234567890.5\neuler,2e-17,3,-4\n";
  using Lines = std::vector<std::string>;
  EXPECT_EQ(differs_from(output, lines_in(output)), "");
  EXPECT_EQ(differs_from(output, {"method,error,seconds,steps", "..."}), "");
  EXPECT_EQ(differs_from(output, {"...", "euler,-9e-17,7,-4"}), "");
  EXPECT_EQ(differs_from(output, {"...", "rk4,1.8e-5,70,1234567890.6 ...", "..."}), "");
  EXPECT_EQ(differs_from("a,1\nb,2\nb,2\n", {"a,1", "...", "b,2"}), "");
  EXPECT_EQ(differs_from("a: -infinite 12345678901\n", {"a: -infinite 12345678902"}), "");
  for (const Lines& wrong :
       {Lines{"method,error,seconds,steps"}, Lines{"...", "rk4,2.2e-5,0.5,1234567890.5", "..."},
        Lines{"...", "rk4,1.0e-5,0.5,1234667890.5", "..."}, Lines{"...", "euler,2e-17,3,4"},
        Lines{"...", "euler,2e-17,3,-4", "more"}, Lines{"...", "Euler ...", "..."}})
    EXPECT_NE(differs_from(output, wrong), "") << wrong.back();
}

}  // namespace
}  // namespace nlmech::tests::printed_commands_test
