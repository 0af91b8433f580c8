/// @file
/// Texts that readers must survive: examples, damaged.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised {

/// An example after one to six damages: bits turned over, parts lost, doubled, moved in from other examples;
/// numbers in place of others (infinities, beyond the range, no numbers at all); long tokens, deep brackets,
/// NUL, byte order marks, line ends of other systems, bytes that are no UTF-8. One in fifty is left whole.
[[nodiscard]] std::string damaged(Draw& draw, const std::vector<std::string>& examples);

/// What a reader may do with any text: return (right, if it says so by true), or throw an InputError whose
/// message is one line, printable and shorter than 1 kB (refused). All else is wrong.
[[nodiscard]] Case read_or_refused(const std::string& text,
                                   const std::function<bool(const std::string&)>& read);

/// Is it one line of at most 1 kB, without a control character, that says something?
[[nodiscard]] bool is_sentence(const std::string& message);

/// A text for a report, whatever is in it.
[[nodiscard]] std::string shown(const std::string& text);

/// The first lines of a file of the source tree. @throws std::runtime_error if it is not there
[[nodiscard]] std::string source_lines(const std::string& path, int count);

}  // namespace nlmech::randomised
