#include "chapters/rbf_inverse/curves.hpp"

#include <fmt/format.h>

#include <utility>

namespace nlmech::chapters {
namespace {

/// Blanks beside marked-up words stay: some viewers of SVG drop them where markup begins or ends.
std::string kept(std::string text) {
  const std::string mark = "\u200b";  // a space of no width
  for (std::size_t at = 0; (at = text.find(" {", at)) != std::string::npos; at += mark.size() + 1)
    text.insert(at + 1, mark);
  for (std::size_t at = 0; (at = text.find("} ", at)) != std::string::npos; at += mark.size() + 1)
    text.insert(at + 1, mark);
  return text;
}

}  // namespace

ControlCurves::ControlCurves(const std::string& heading, const std::string& xcolumn)
    : data_({{"panel"}, {"curve", 3, true}, {xcolumn}, {"y"}}) {
  variables_ = {{"heading", kept(heading)}, {"height", "480"}};
}

void ControlCurves::close_panel() {
  if (panel_ == 0) return;
  variables_[fmt::format("legend{}", panel_)] = std::exchange(legend_, "");
  variables_[fmt::format("looks{}", panel_)] = std::exchange(looks_, "");
}

void ControlCurves::panel(const std::string& xlabel, const std::string& ylabel, const std::string& caption) {
  close_panel();
  ++panel_;
  variables_[fmt::format("first{}", panel_)] = fmt::format("{}", count_);
  with("xlabel", kept(xlabel)).with("ylabel", kept(ylabel));
  if (!caption.empty()) with("caption", kept(caption));
}

void ControlCurves::begin(const std::string& legend, const std::string& look) {
  ++count_;
  const char* between = looks_.empty() ? "" : "|";
  legend_ += between + kept(legend);
  looks_ += between + look;
}

ControlCurves& ControlCurves::with(const std::string& name, const std::string& value) {
  variables_[fmt::format("{}{}", name, panel_)] = value;
  return *this;
}

ControlCurves& ControlCurves::overall(const std::string& name, const std::string& value) {
  variables_[name] = value;
  return *this;
}

scene::Figure ControlCurves::take() {
  close_panel();
  variables_["panels"] = fmt::format("{}", panel_);
  return {std::move(data_), "rbf_inverse-curves", std::move(variables_)};
}

}  // namespace nlmech::chapters
