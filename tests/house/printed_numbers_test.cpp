/// Printed numbers stand in `tables/published` alone: code names them.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "nlmech/scene/evidence/published.hpp"
#include "tests/house/house.hpp"

namespace nlmech::tests::printed_numbers_test {
namespace {

/// Digits of a number, without zeros at its ends: "4.2894" has five, "1000" one.
std::size_t digits_of(const std::string& number) {
  std::string digits;
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if (c >= '0' && c <= '9' && (c != '0' || !digits.empty())) digits += c;
  }
  while (digits.ends_with('0')) digits.pop_back();
  return digits.size();
}

/// A line of C++ without comment and strings.
std::string code_of(const std::string& line) {
  static const std::regex string(R"("(\\.|[^"\\])*")");
  std::string code = std::regex_replace(line, string, "");
  return code.substr(0, code.find("//"));
}

// Parameters are used as printed; what a source computed is not. Four digits and more do not come by chance.
TEST(PrintedNumbers, AreNoLiterals) {
  std::map<std::string, std::string> printed;  // as printed, and where
  for (const scene::PublishedValue& value : scene::read_published(NLMECH_SOURCE_DIR)) {
    if (value.expected != scene::Verdict::input && value.kind != "time" && digits_of(value.printed) >= 4)
      printed.emplace(value.printed, value.name());
  }
  EXPECT_GT(printed.size(), 10U);
  const std::regex number(R"([0-9][0-9.]*([eE][-+]?[0-9]+)?)");
  for (const auto& file : sources_under("chapters")) {
    if (file.extension() != ".cpp" && file.extension() != ".hpp") continue;
    std::size_t at = 0;
    for (const std::string& line : lines_of(file)) {
      ++at;
      const std::string code = code_of(line);
      for (auto m = std::sregex_iterator(code.begin(), code.end(), number); m != std::sregex_iterator();
           ++m) {
        const auto found = printed.find(m->str());
        EXPECT_TRUE(found == printed.end())
            << file.string() << ":" << at << ": " << m->str() << " is " << found->second;
      }
    }
  }
}

}  // namespace
}  // namespace nlmech::tests::printed_numbers_test
