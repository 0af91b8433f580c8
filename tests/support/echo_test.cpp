#include "nlmech/support/quoted_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace nlmech::echo_test {
namespace {

using nlmech::printable_message;
using nlmech::quoted_input;

bool printable(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
}

TEST(Echo, LeavesPlainTextAlone) {
  for (const std::string text :
       {"", "1.5e-3", "a b", "M\xc3\xbcller \xe2\x82\xac \xf0\x9f\x98\x80", "back\\slash"})
    EXPECT_EQ(quoted_input(text), text);
}

TEST(Echo, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(quoted_input("\x1b[2J\x07"), "\\x1b[2J\\x07");
  EXPECT_EQ(quoted_input("a\nb\tc\r"), "a\\nb\\tc\\x0d");
  EXPECT_EQ(quoted_input(std::string("a\0b\x7f", 4)), "a\\x00b\\x7f");
  EXPECT_EQ(quoted_input("\xc2\x9b"
                         "31m"),
            "\\xc2\\x9b"
            "31m");  // a control of 8 bits
  EXPECT_EQ(quoted_input("\xe2\x80\xae"
                         "txt"),
            "\\xe2\\x80\\xae"
            "txt");  // from right to left
  EXPECT_EQ(quoted_input("\xef\xbb\xbf"
                         "1"),
            "\\xef\\xbb\\xbf"
            "1");  // byte order mark
}

TEST(Echo, EscapesBytesThatAreNoUtf8) {
  for (const std::string bytes :
       {"\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82"}) {
    const std::string text = quoted_input(bytes);
    EXPECT_EQ(text.size(), 4 * bytes.size()) << text;
    EXPECT_TRUE(printable(text));
    EXPECT_TRUE(
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
  }
}

TEST(Echo, CutsLongTextsBetweenCharactersAndSaysHowLongTheyAre) {
  EXPECT_EQ(quoted_input(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(quoted_input(std::string(8'000'000, '1')), std::string(60, '1').append("... (8000000 bytes)"));
  EXPECT_EQ(quoted_input("\xc3\xbc\xc3\xbc", 3), "\xc3\xbc... (4 bytes)");
}

TEST(Echo, IsPrintableAndShortForAnyBytes) {
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    std::string bytes(random() % 200, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 7 == 0 ? random() % 128 : random() % 256);
    EXPECT_TRUE(printable(quoted_input(bytes)));
    EXPECT_LE(quoted_input(bytes).size(), 4 * 60 + 20U);
    const std::string message = printable_message(bytes);
    EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) {
      return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t';
    }));
    EXPECT_EQ(printable_message(message), message) << "what is printable stays as it is";
  }
}

TEST(Echo, KeepsTheEndOfAMessageWithALongWord) {
  EXPECT_EQ(printable_message("--x " + std::string(5000, '1') + ": not a number\n"),
            "--x " + std::string(60, '1') + "... (5001 bytes) not a number\n");
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += "1 ";
  EXPECT_LE(printable_message(many).size(), 4003U);
}

}  // namespace
}  // namespace nlmech::echo_test
