/// @file
/// Refusals and failures with a formatted sentence. For sources that are compiled with {fmt}.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "nlmech/support/errors.hpp"

namespace nlmech {

/// To throw: a caller's mistake. @param sentence says what is wrong, with the value
template <class... Args>
[[nodiscard]] std::invalid_argument invalid_argument(fmt::format_string<Args...> sentence, Args&&... args) {
  return std::invalid_argument(fmt::format(sentence, std::forward<Args>(args)...));
}

/// To throw: a user's mistake. @param sentence says what is wrong, and where
template <class... Args>
[[nodiscard]] InputError input_error(fmt::format_string<Args...> sentence, Args&&... args) {
  return InputError(fmt::format(sentence, std::forward<Args>(args)...));
}

/// See Status::failure().
template <class... Args>
[[nodiscard]] Status failed_with(Outcome outcome, fmt::format_string<Args...> sentence, Args&&... args) {
  return Status::failure(outcome, fmt::format(sentence, std::forward<Args>(args)...));
}

}  // namespace nlmech
