#include "chapters/homotopy/curves.hpp"

#include <fmt/format.h>

#include <utility>

#include "chapters/drawing.hpp"

namespace nlmech::chapters {

Curves::Curves(std::string heading, const std::string& xlabel, const std::string& ylabel)
    : data_({{"curve", 3, true}, {"x"}, {"y"}}) {
  variables_ = {{"heading", with_kept_blanks(std::move(heading))},
                {"xlabel", with_kept_blanks(xlabel)},
                {"ylabel", with_kept_blanks(ylabel)},
                {"height", "480"}};
}

void Curves::begin(const std::string& legend, const std::string& look) {
  const char* between = count_++ == 0 ? "" : "|";
  legend_ += between + with_kept_blanks(legend);
  looks_ += between + look;
}

void Curves::label(const std::string& text, double x, double y, const std::string& side) {
  labels_ += fmt::format("{}{}@{:.9g}@{:.9g}@{}", labels_.empty() ? "" : "|", text, x, y, side);
}

Curves& Curves::with(const std::string& name, const std::string& value) {
  variables_[name] = value;
  return *this;
}

scene::Figure Curves::take() {
  variables_["legend"] = legend_;
  variables_["looks"] = looks_;
  if (!labels_.empty()) variables_["labels"] = labels_;
  return {std::move(data_), "homotopy-curves", std::move(variables_)};
}

}  // namespace nlmech::chapters
