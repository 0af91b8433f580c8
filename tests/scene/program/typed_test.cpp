#include "nlmech/scene/program/typed.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nlmech/support/errors.hpp"

namespace nlmech::scene::typed_test {
namespace {

using namespace nlmech;

template <class Read>
std::string refusal(const Read& read) {
  try {
    static_cast<void>(read());
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Typed, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(scene::typed_number("--x", "-1.5e3"), -1500);
  EXPECT_EQ(scene::typed_positive("--x", "0.25"), 0.25);
  EXPECT_EQ(scene::typed_whole("--n", "7", 1, 7), 7);
  EXPECT_EQ(scene::typed_numbers("--x", "1,-2,3e-1"), (std::vector<double>{1, -2, 0.3}));
  EXPECT_EQ(scene::typed_words("--x", "1,-2,3e-1"), (std::vector<std::string>{"1", "-2", "3e-1"}));
}

TEST(Typed, RefusalsNameTheOptionAndTheText) {
  for (const std::string text : {"", "nan", "inf", "1e999", "1x", "0x10", "1 2"})
    EXPECT_EQ(refusal([&] { return scene::typed_number("--x", text); }),
              "--x " + text + ": not a finite number");
  for (const std::string text : {"0", "-1", "-0"})
    EXPECT_EQ(refusal([&] { return scene::typed_positive("--x", text); }),
              "--x " + text + ": must be positive");
  for (const std::string text : {"0", "8", "1.5", "1e300"})
    EXPECT_EQ(refusal([&] { return scene::typed_whole("--n", text, 1, 7); }),
              "--n " + text + ": must be a whole number from 1 to 7");
  EXPECT_EQ(refusal([] { return scene::typed_numbers("--x", "1,,2"); }),
            "--x 1,,2: '' is not a finite number");
  EXPECT_EQ(refusal([] { return scene::typed_words("--x", "1,two"); }),
            "--x 1,two: 'two' is not a finite number");
}

TEST(Typed, SplittingAndJoiningGivesTheTextBack) {
  for (const std::string text : {"", ",", "a", "a,b", ",a,,b,"}) {
    std::string joined;
    for (const std::string& piece : scene::split(text, ',')) joined += piece + ',';
    EXPECT_EQ(joined, text + ',');
  }
}

}  // namespace
}  // namespace nlmech::scene::typed_test
