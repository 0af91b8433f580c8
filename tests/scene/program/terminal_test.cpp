#include "nlmech/scene/program/terminal.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace nlmech::scene::terminal_test {
namespace {

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
  EXPECT_EQ(aligned(example(), 60),  // 10 + 18 + 19 + 7 characters, and 6 between
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
}  // namespace nlmech::scene::terminal_test
