#include "nlmech/scene/show.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace nlmech::scene {

void Show::refuse_second(bool there, const char* what) const {
  if (there) throw std::logic_error(std::string("a scene shows one ") + what);
}

Plot& Show::plots(const std::string& heading) {
  refuse_second(plot_ || showing_.figure, "figure");
  return plot_.emplace(heading);
}

Panel& Show::plot(const std::string& heading, const std::string& x_label, const std::string& y_label) {
  return plots(heading).panel(x_label, y_label);
}

Plot& Show::figure() {
  if (!plot_) throw std::logic_error("no figure of curves was started");
  return *plot_;
}

void Show::draw(Table data, std::string template_name, std::map<std::string, std::string> variables) {
  draw(Figure{std::move(data), std::move(template_name), std::move(variables)});
}

void Show::draw(Figure figure) {
  refuse_second(plot_ || showing_.figure, "figure");
  showing_.figure = std::move(figure);
}

double Show::printed(const std::string& name) {
  if (!printed_) printed_.emplace();
  return (*printed_)[name];
}

void Show::table(Table table) {
  refuse_second(showing_.table.has_value(), "table");
  showing_.table = std::move(table);
}

void Show::near(const std::string& name, const Amount& value, double known, double relative,
                const std::string& reason) {
  const double margin = relative * std::abs(known);
  between(name, value, known - margin, known + margin, reason);
}

void Show::at_most(const std::string& name, const Amount& value, double bound, const std::string& reason) {
  between(name, value, 0, bound, reason);
}

void Show::between(const std::string& name, const Amount& value, double low, double high,
                   const std::string& reason) {
  showing_.quantities.push_back({name, value.unit, value.value, low, high, reason});
}

void Show::equals(const std::string& name, const Amount& value, double known, const std::string& reason) {
  between(name, value, known, known, reason);
}

void Show::measured(const std::string& name, std::optional<double> nominal, std::optional<double> inferred,
                    const std::string& setting) {
  if (!showing_.measured.emplace(name, Measured{nominal, inferred, setting}).second)
    throw std::logic_error("measured twice: " + name);
}

Showing Show::take() {
  if (plot_) {
    if (plot_->curves() == 0) throw std::logic_error("a figure without curves");
    showing_.figure = Figure{plot_->data(), "", {}, plot_->prelude(), plot_->script()};
  }
  return std::move(showing_);
}

}  // namespace nlmech::scene
