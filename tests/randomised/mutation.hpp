/// @file
/// Damaged examples as input for readers.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised {

/// An example with one to six mutations: flipped bits; deleted, duplicated or inserted parts; replaced
/// numbers (infinities, beyond the range, not numbers); long tokens, deep nesting, NUL, byte order marks,
/// line ends of other systems, invalid UTF-8. One in fifty is unchanged.
[[nodiscard]] std::string damaged(Draw& draw, const std::vector<std::string>& examples);

/// A reader may return (right, if it returns true) or throw an InputError whose message is one printable line
/// shorter than 1 kB (refused). Anything else is wrong.
[[nodiscard]] Case read_or_refused(const std::string& text,
                                   const std::function<bool(const std::string&)>& read);

/// Is the message one line of at most 1 kB without control characters, and not empty?
[[nodiscard]] bool is_sentence(const std::string& message);

/// A printable form of any text.
[[nodiscard]] std::string shown(const std::string& text);

/// The first lines of a file of the source tree. @throws std::runtime_error if it is not there
[[nodiscard]] std::string source_lines(const std::string& path, int count);

}  // namespace nlmech::randomised
