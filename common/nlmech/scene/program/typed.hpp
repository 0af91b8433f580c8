/// @file
/// Parsers of option values: numbers, counts, lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// A finite number. @throws InputError naming the option and the text
[[nodiscard]] double typed_number(std::string_view option, const std::string& text);

/// A positive finite number. @throws InputError naming the option and the text
[[nodiscard]] double typed_positive(std::string_view option, const std::string& text);

/// An integer from @p least to @p most. @throws InputError naming the option, the text and the range
[[nodiscard]] int typed_whole(std::string_view option, const std::string& text, int least, int most);

/// The text without blanks at its ends.
[[nodiscard]] std::string trimmed(std::string text);

/// Pieces of a text between separators; an empty text has one empty piece.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// Texts of finite numbers separated by commas. @throws InputError naming the option, the text and the piece
[[nodiscard]] std::vector<std::string> typed_words(std::string_view option, const std::string& text);

/// Finite numbers separated by commas. @throws InputError naming the option, the text and the piece
[[nodiscard]] std::vector<double> typed_numbers(std::string_view option, const std::string& text);

}  // namespace nlmech::scene
