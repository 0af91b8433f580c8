#include "nlmech/expression/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nlmech/support/echo.hpp"

namespace nlmech::expression {

InputError SourceText::mistake(const Place& place, std::string_view sentence) const {
  const std::string_view all = text_;
  const std::size_t at = std::min(place.begin, all.size());
  const auto line = std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t before = at == 0 ? std::string_view::npos : all.rfind('\n', at - 1);
  const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t last = std::min(all.find('\n', at), all.size());

  // A long line is shown from some way before the place to some way behind it.
  constexpr std::size_t ahead = 50, behind = 25;
  const std::size_t from = at - first > ahead ? at - ahead : first;
  const std::size_t to = last - at > behind && last - from > ahead + behind ? at + behind : last;
  const std::string left = echoed(all.substr(from, at - from), std::string::npos);
  const std::string right = echoed(all.substr(at, to - at), std::string::npos);
  const std::size_t width = std::clamp<std::size_t>(place.end - at, 1, std::max<std::size_t>(to - at, 1));
  return InputError(fmt::format("{}:{}:{}: {}\n  {}{}\n  {:>{}}{}", name_, line + 1, at - first + 1, sentence,
                                left, right, "", left.size(), std::string(width, '^')));
}

}  // namespace nlmech::expression
