#include "nlmech/program/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {
namespace {

// Is it a continuation byte of UTF-8?
bool goes_on(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

std::size_t characters(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), goes_on));
}
std::string shown(std::string_view text) { return quoted_input(text, std::string::npos); }

}  // namespace

SourceText::SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  std::size_t written = 0;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_.compare(i, 2, "\r\n") != 0) text_[written++] = text_[i];
  }
  text_.resize(written);
}

InputError SourceText::mistake(const Place& place, std::string_view sentence) const {
  const std::string_view all = text_;
  const std::size_t at = std::min(place.begin, all.size());
  const auto line = std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t before = at == 0 ? std::string_view::npos : all.rfind('\n', at - 1);
  const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t last = std::min(all.find('\n', at), all.size());

  // A long line is cut to 50 bytes before the place and 25 after it.
  constexpr std::size_t ahead = 50, behind = 25;
  std::size_t from = at - first > ahead ? at - ahead : first;
  std::size_t to = last - at > behind && last - from > ahead + behind ? at + behind : last;
  while (from > first && goes_on(all[from])) --from;
  while (to < last && goes_on(all[to])) ++to;
  const std::string left = shown(all.substr(from, at - from)), right = shown(all.substr(at, to - at));
  const std::string marked = shown(all.substr(at, std::clamp(place.end, at, to) - at));
  return InputError(fmt::format("{}:{}:{}: {}\n  {}{}\n  {:>{}}{}", name_, line + 1,
                                characters(all.substr(first, at - first)) + 1, sentence, left, right, "",
                                characters(left),
                                std::string(std::max<std::size_t>(characters(marked), 1), '^')));
}

}  // namespace nlmech::program
