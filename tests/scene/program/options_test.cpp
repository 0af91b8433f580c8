/// Options: what is typed reaches its member, or is refused with the option, the text and what is allowed.
#include "nlmech/scene/program/options.hpp"

#include <gtest/gtest.h>

#include <array>
#include <new>

#include "nlmech/scene/program/command.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene::options_test {
namespace {

std::string refusal(const Option& option, const std::string& text) {
  try {
    option.understand({text});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
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
            "--side up: there is left, right");
  EXPECT_EQ(refusal(options.add("--place", std::span<double>(place), ""), "1,2"),
            "--place 1,2: 2 numbers where 3 are needed");
  EXPECT_EQ(refusal(options.add("--list", list, "").range(0, 1), "0.5,2"),
            "--list 0.5,2: must be from 0 to 1");
  EXPECT_EQ(number, 1);  // what is refused leaves its member alone
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

// The library's own word, std::bad_alloc, tells a user nothing.
TEST(Options, ACommandWithoutMemorySaysWhatToChange) {
  Commands commands("program");
  commands.add("work", "takes much", declare_nothing,
               [](int /*typed*/) -> std::string { throw std::bad_alloc(); });
  const char* const argv[] = {"program", "work"};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_command(commands, "a program", 2, argv), 1);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(said.starts_with("program: there is not enough memory")) << said;
  EXPECT_NE(said.find("--every"), std::string::npos) << said;
}

}  // namespace
}  // namespace nlmech::scene::options_test
