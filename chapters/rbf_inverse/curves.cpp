#include "chapters/rbf_inverse/curves.hpp"

#include <fmt/format.h>

#include <utility>

#include "chapters/drawing.hpp"

namespace nlmech::chapters {

ControlCurves::ControlCurves(const std::string& heading, const std::string& xcolumn)
    : data_({{"panel"}, {"curve", 3, true}, {xcolumn}, {"y"}}) {
  variables_ = {{"heading", with_kept_blanks(heading)}, {"height", "480"}};
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
  with("xlabel", with_kept_blanks(xlabel)).with("ylabel", with_kept_blanks(ylabel));
  if (!caption.empty()) with("caption", with_kept_blanks(caption));
}

void ControlCurves::begin(const std::string& legend, const std::string& look) {
  ++count_;
  const char* between = looks_.empty() ? "" : "|";
  legend_ += between + with_kept_blanks(legend);
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
