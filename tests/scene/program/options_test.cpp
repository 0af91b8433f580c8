/// The command line: an option sets its member, or is refused with a message that names the option, the text
/// and the accepted values.
#include "nlmech/scene/program/options.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/process.hpp"
#include "nlmech/scene/program/terminal.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::options_test {
namespace {

std::string refusal(const Option& option, const std::string& text) {
  return tests::thrown<InputError>([&] { option.understand({text}); });
}

TEST(Options, ValuesReachTheirMembers) {
  Options options;
  std::string text;
  double number = 0;
  std::optional<double> perhaps;
  int whole = 0;
  std::optional<int> count;
  std::vector<double> list;
  std::array<double, 3> place = {};
  std::vector<std::string> words;
  bool flag = false;
  options.add("--text", text, "").understand({"a b"});
  options.add("--number", number, "").understand({"-2.5e3"});
  options.add("--perhaps", perhaps, "").understand({"0"});
  options.add("--whole", whole, "").understand({"-7"});
  options.add("--count", count, "").range(1, 9).understand({"9"});
  options.add("--list", list, "").understand({"1,2.5"});
  options.add("--place", std::span<double>(place), "").understand({"1,-2,3"});
  options.add("words", words, "").understand({"a", "b"});
  options.add("--flag", flag, "").understand({"true"});
  EXPECT_EQ(text, "a b");
  EXPECT_EQ(number, -2500);
  EXPECT_EQ(perhaps, 0.0);
  EXPECT_EQ(whole, -7);
  EXPECT_EQ(count, 9);
  EXPECT_EQ(list, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(place, (std::array<double, 3>{1, -2, 3}));
  EXPECT_EQ(words, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(flag);
  options.add("--flag", flag, "").understand({"false"});
  EXPECT_FALSE(flag);
}

TEST(Options, RefusalsNameOptionTextAndRange) {
  Options options;
  double number = 1, share = 0;
  int whole = 1;
  std::string word = "left";
  std::array<double, 3> place = {};
  std::vector<double> list;
  EXPECT_EQ(refusal(options.add("--step", number, "").positive(), "0"), "--step 0: must be positive");
  EXPECT_EQ(refusal(options.add("--step", number, ""), "nan"), "--step nan: not a finite number");
  EXPECT_EQ(refusal(options.add("--share", share, "").range(0, 0.5), "0.6"),
            "--share 0.6: must be from 0 to 0.5");
  EXPECT_EQ(refusal(options.add("--count", whole, "").range(1, 9), "2.5"),
            "--count 2.5: must be a whole number from 1 to 9");
  EXPECT_EQ(refusal(options.add("--side", word, "").one_of({"left", "right"}), "up"),
            "--side up: must be one of left, right");
  EXPECT_EQ(refusal(options.add("--place", std::span<double>(place), ""), "1,2"),
            "--place 1,2: 2 numbers; 3 are needed");
  EXPECT_EQ(refusal(options.add("--list", list, "").range(0, 1), "0.5,2"),
            "--list 0.5,2: must be from 0 to 1");
  EXPECT_EQ(number, 1);  // a refused option does not change its member
  EXPECT_EQ(word, "left");
}

TEST(Options, HelpSaysRangeAndDefault) {
  Options options;
  double number = 0.25;
  std::optional<int> count;
  std::string word = "left";
  const Option& a = options.add("--number", number, "a number").range(0, 1);
  EXPECT_EQ(a.help(), "a number; from 0 to 1");
  EXPECT_EQ(a.default_text(), "0.25");
  const Option& b = options.add("--count", count, "how many").range(1, 9).required();
  EXPECT_EQ(b.default_text(), "");
  EXPECT_TRUE(b.is_required());
  EXPECT_EQ(options.add("--side", word, "side").one_of({"left", "right"}).help(), "side: left, right");
}

void declare_nothing(Options& /*options*/, int& /*typed*/) {}

// The message of the library, std::bad_alloc, does not help a user.
TEST(Options, ACommandWithoutMemorySaysWhatToChange) {
  Commands commands("program");
  commands.add("work", "takes much", declare_nothing,
               [](int /*typed*/) -> std::string { throw std::bad_alloc(); });
  const char* const argv[] = {"program", "work"};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_command(commands, "a program", 2, argv), 1);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(said.starts_with("program: not enough memory")) << said;
  EXPECT_TRUE(tests::holds(said, "--every"));
}

TEST(Typed, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(typed_number("--x", "-1.5e3"), -1500);
  EXPECT_EQ(typed_positive("--x", "0.25"), 0.25);
  EXPECT_EQ(typed_whole("--n", "7", 1, 7), 7);
  EXPECT_EQ(typed_numbers("--x", "1,-2,3e-1"), (std::vector<double>{1, -2, 0.3}));
  EXPECT_EQ(typed_words("--x", "1,-2,3e-1"), (std::vector<std::string>{"1", "-2", "3e-1"}));
}

TEST(Typed, RefusalsNameTheOptionAndTheText) {
  for (const std::string text : {"", "nan", "inf", "1e999", "1x", "0x10", "1 2"})
    EXPECT_EQ(tests::thrown<InputError>([&] { return typed_number("--x", text); }),
              "--x " + text + ": not a finite number");
  for (const std::string text : {"0", "-1", "-0"})
    EXPECT_EQ(tests::thrown<InputError>([&] { return typed_positive("--x", text); }),
              "--x " + text + ": must be positive");
  for (const std::string text : {"0", "8", "1.5", "1e300"})
    EXPECT_EQ(tests::thrown<InputError>([&] { return typed_whole("--n", text, 1, 7); }),
              "--n " + text + ": must be a whole number from 1 to 7");
  EXPECT_EQ(tests::thrown<InputError>([] { return typed_numbers("--x", "1,,2"); }),
            "--x 1,,2: '' is not a finite number");
  EXPECT_EQ(tests::thrown<InputError>([] { return typed_words("--x", "1,two"); }),
            "--x 1,two: 'two' is not a finite number");
}

TEST(Typed, SplittingAndJoiningGivesTheTextBack) {
  for (const std::string text : {"", ",", "a", "a,b", ",a,,b,"}) {
    std::string joined;
    for (const std::string& piece : split(text, ',')) joined += piece + ',';
    EXPECT_EQ(joined, text + ',');
  }
}

// ---- Manual page and completions: generated from the declared options and accepted by their readers.

struct Typed {
  std::string frame = "fixed";
  double step = 0.5;
  std::vector<std::string> scenes;
  bool quick = false;
};

void declare_flight(Options& options, Typed& t) {
  options.add("scenes", t.scenes, "what is flown");
  options.add("--frame", t.frame, "of reference").one_of({"fixed", "turning"});
  options.add("--step", t.step, "length of a step").positive();
  options.add("--quick", t.quick, "not all of it");
  options.footer("Notes:\n.a begins with a dot, C:\\path");
}

void declare_landing(Options& options, Typed& /*t*/) { options.unlimited(); }

Commands declared() {
  Commands commands("orbiter");
  const auto nothing = [](const Typed&) { return 0; };
  commands.add("fly", "Leaves, and says when it's there", declare_flight, nothing);
  commands.add("land", "Comes down", declare_landing, nothing);
  return commands;
}

TEST(ManualPage, ListsCommandsWithTheirOptions) {
  const std::string page = manual_page(declared(), "Flies", "2.0.0");
  EXPECT_TRUE(
      page.starts_with(".TH ORBITER 1 \"\" \"nlmech 2.0.0\" \"nlmech\"\n.SH NAME\norbiter \\- Flies\n"));
  EXPECT_TRUE(tests::holds(page, ".SS fly [scenes...]\nLeaves, and says when it's there\n"));
  EXPECT_TRUE(tests::holds(
      page, ".TP\n\\fB\\-\\-frame\\fR \\fITEXT\\fR\nof reference: fixed, turning (default fixed)\n"));
  EXPECT_TRUE(tests::holds(page, "\nlength of a step; positive (default 0.5)\n"));
  EXPECT_TRUE(tests::holds(page, ".TP\n\\fB\\-\\-quick\\fR\nnot all of it\n"));
  EXPECT_TRUE(tests::holds(page, "\n\\&.a begins with a dot, C:\\epath\n")) << "nothing typed is a request";
  EXPECT_TRUE(tests::holds(page, "s (default 60)")) << "the limit of every command";
  EXPECT_TRUE(tests::holds(page, "s (default none)"));
  EXPECT_EQ(page, manual_page(declared(), "Flies", "2.0.0"));
}

/// Bash's completions for the command line @p words, whose last word is incomplete.
std::string offered(const std::string& words, const std::string& last, const std::string& before) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("nlmech-completion" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "completions") << bash_completion(declared());
  // A replacement for the program that prints its list of scenes.
  std::ofstream(folder / "orbiter") << "#!/bin/sh\nprintf 'Title\\n\\n| scene | place |\\n| :--- | :--- |\\n"
                                       "| moon | a |\\n| fig-2 | b |\\n'\n";
  fs::permissions(folder / "orbiter", fs::perms::owner_all);
  const std::string script = "set -u; . ./completions; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nlmech_orbiter ./orbiter '" + last +
                             "' '" + before +
                             "'; echo ${COMPREPLY[@]+\"${COMPREPLY[*]}\"}; complete -p orbiter";
  const Finished run = run_program({"bash", "-c", script}, folder);
  fs::remove_all(folder);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_TRUE(tests::holds(run.output, "complete -o default -F _nlmech_orbiter orbiter"));
  return run.output.substr(0, run.output.find('\n'));
}

TEST(BashCompletion, OffersCommandsOptionsValuesAndScenes) {
  EXPECT_EQ(offered("orbiter ''", "", "orbiter"), "fly land --help --version");
  EXPECT_EQ(offered("orbiter l", "l", "orbiter"), "land");
  EXPECT_EQ(offered("orbiter fly --", "--", "fly"), "--help --frame --step --quick --limit");
  EXPECT_EQ(offered("orbiter fly --frame ''", "", "--frame"), "fixed turning");
  EXPECT_EQ(offered("orbiter fly ''", "", "fly"), "--help --frame --step --quick --limit moon fig-2");
  EXPECT_EQ(offered("orbiter land ''", "", "land"), "--help --limit");
  EXPECT_EQ(offered("orbiter nowhere ''", "", "nowhere"), "");
}

Table example() {
  Table table({{"scene"}, {"title"}, {"runs"}, {"seconds"}});
  table.add({std::string("fig-1"), std::string("A title that says at some length what there is to see"),
             std::string("one two three four five"), 0.5});
  table.add({std::string("table-2.10"), std::string("\xce\x94\xce\xb8"), std::string("one"), 12.});
  return table;
}

TEST(Aligned, LeavesAsItIsWhatFits) {
  EXPECT_EQ(
      aligned(example(), 200),
      "scene       title                                                  runs                     seconds\n"
      "fig-1       A title that says at some length what there is to see  one two three four five      0.5\n"
      "table-2.10  \xce\x94\xce\xb8                                                     one                  "
      "         12\n");
}

TEST(Aligned, CutsTheWidestColumnsFirst) {
  EXPECT_EQ(aligned(example(), 60),  // 10 + 18 + 19 + 7 characters, and 6 spaces between
            "scene       title               runs                 seconds\n"
            "fig-1       A title that sa...  one two three fo...      0.5\n"
            "table-2.10  \xce\x94\xce\xb8                  one                       12\n");
}

TEST(Aligned, FitsEveryWidthThatLeavesFourCharactersAColumn) {
  for (std::size_t width = 22; width < 100; ++width) {
    std::istringstream lines(aligned(example(), width));
    for (std::string line; std::getline(lines, line);) {
      std::size_t characters = 0;
      for (const char c : line) characters += (static_cast<unsigned char>(c) & 0xc0U) == 0x80 ? 0 : 1;
      EXPECT_LE(characters, width) << line;
    }
  }
}

}  // namespace
}  // namespace nlmech::scene::options_test
