/// @file
/// Messages of refusals.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace nlmech::tests {

/// The text of the Error that @p call throws; "" if it throws none.
template <class Error, class Call>
[[nodiscard]] std::string thrown(const Call& call) {
  try {
    static_cast<void>(call());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Does the text contain the part? An assertion shows both if not.
[[nodiscard]] inline testing::AssertionResult holds(std::string_view text, std::string_view part) {
  if (text.find(part) != std::string_view::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in\n" << text;
}

}  // namespace nlmech::tests
