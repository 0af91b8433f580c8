/// @file
/// Exceptions and failures with a formatted message. For sources compiled with {fmt}.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "nlmech/support/errors.hpp"

namespace nlmech {

/// Exception for a programming error, to be thrown. @param sentence what is wrong, with the value
template <class... Args>
[[nodiscard]] std::invalid_argument invalid_argument(fmt::format_string<Args...> sentence, Args&&... args) {
  return std::invalid_argument(fmt::format(sentence, std::forward<Args>(args)...));
}

/// Exception for wrong user input, to be thrown. @param sentence what is wrong, and where
template <class... Args>
[[nodiscard]] InputError input_error(fmt::format_string<Args...> sentence, Args&&... args) {
  return InputError(fmt::format(sentence, std::forward<Args>(args)...));
}

/// Status::failure() with a formatted message.
template <class... Args>
[[nodiscard]] Status failed_with(Outcome outcome, fmt::format_string<Args...> sentence, Args&&... args) {
  return Status::failure(outcome, fmt::format(sentence, std::forward<Args>(args)...));
}

}  // namespace nlmech
