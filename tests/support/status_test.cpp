#include "nlmech/support/status.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "nlmech/support/errors.hpp"
#include "tests/places.hpp"

namespace nlmech::status_test {
namespace {

using nlmech::Failure;
using nlmech::InputError;
using nlmech::Outcome;
using nlmech::Status;

/// The enumerators of Outcome as the header spells them: detects a new one without a spelling.
std::vector<std::string> enumerators() {
  std::ifstream in(NLMECH_SOURCE_DIR "/common/nlmech/support/status.hpp");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::smatch body;
  EXPECT_TRUE(std::regex_search(text, body, std::regex(R"(enum class Outcome[^{]*\{([^}]*)\})")));
  const std::string inside = std::regex_replace(body[1].str(), std::regex("///<[^\n]*"), "");
  std::vector<std::string> names;
  const std::regex word("[a-z_]+");
  for (std::sregex_iterator i(inside.begin(), inside.end(), word), end; i != end; ++i)
    names.push_back(i->str());
  return names;
}

TEST(Outcome, EveryEnumeratorHasItsOwnSpelling) {
  const std::vector<std::string> names = enumerators();
  ASSERT_GE(names.size(), 15U);
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(to_string(static_cast<Outcome>(i)), names[i]);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(to_string(static_cast<Outcome>(names.size())), "unknown");
}

TEST(Outcome, IsOneByte) { static_assert(sizeof(Outcome) == 1 && std::is_trivially_copyable_v<Outcome>); }

TEST(Status, IsSuccessFromTheStart) {
  const Status status;
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(status.outcome(), Outcome::success);
  EXPECT_EQ(status.sentence(), "");
  EXPECT_EQ(status.text(), "success");
}

TEST(Status, FailureKeepsOutcomeAndSentence) {
  const Status status = Status::failure(Outcome::step_limit, "rk4 stopped at t = 3 s; allow more steps");
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.outcome(), Outcome::step_limit);
  EXPECT_EQ(status.sentence(), "rk4 stopped at t = 3 s; allow more steps");
  EXPECT_EQ(status.text(), "step_limit: rk4 stopped at t = 3 s; allow more steps");
}

TEST(Status, FailureNeedsASentence) {
  try {
    static_cast<void>(Status::failure(Outcome::at_pole, ""));
    FAIL() << "a failure without a sentence was made";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("at_pole"), std::string::npos) << error.what();
  }
}

TEST(Status, SuccessIsNoFailure) {
  EXPECT_THROW(static_cast<void>(Status::failure(Outcome::success, "all is well")), std::invalid_argument);
}

TEST(Errors, FailureSaysWhatItsStatusSays) {
  const Failure computed(Status::failure(Outcome::non_finite, "row 3 is NaN"));
  EXPECT_STREQ(computed.what(), "non_finite: row 3 is NaN");
  EXPECT_EQ(computed.status().outcome(), Outcome::non_finite);

  const Failure written("results/a.csv: no space left");
  EXPECT_STREQ(written.what(), "results/a.csv: no space left");
  EXPECT_TRUE(written.status().ok());
}

TEST(Errors, BadInputIsNoFailureOfAComputation) {
  static_assert(!std::is_base_of_v<Failure, InputError> && !std::is_base_of_v<InputError, Failure>);
  EXPECT_STREQ(InputError("file: line 3").what(), "file: line 3");
}

}  // namespace
}  // namespace nlmech::status_test
