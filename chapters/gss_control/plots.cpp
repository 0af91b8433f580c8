#include "chapters/gss_control/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "chapters/drawing.hpp"

namespace nlmech::chapters {
namespace {

std::string range(double low, double high) { return fmt::format("[{:.9g}:{:.9g}]", low, high); }

/// Powers of ten of a range, at most nine of them with a text: `("10^{-1}" 1e-1, "" 1e0, ...)`.
std::string powers_of_ten(double low, double high, bool texts = true) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9)),
            last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int stride = std::max(1, (last - first + 8) / 8);
  std::string tics;
  for (int k = first; k <= last; ++k) {
    const bool named = texts && k % stride == 0;
    const std::string text = !named ? "" : k == 0 ? "1" : k == 1 ? "10" : fmt::format("10^{{{}}}", k);
    tics += fmt::format("{}\"{}\" 1e{}", tics.empty() ? "(" : ", ", text, k);
  }
  return tics + ")";
}

}  // namespace

Plot::Plot(std::string heading, const std::string& xlabel, const std::string& abscissa)
    : data_({{"curve", 3, true}, {"panel"}, {abscissa}, {"y"}}) {
  variables_ = {{"heading", with_kept_blanks(std::move(heading))},
                {"xlabel", with_kept_blanks(xlabel)},
                {"abscissa", abscissa},
                {"height", "480"}};
}

std::string Plot::of_panel(const char* name) const { return fmt::format("{}{}", name, panels_); }

void Plot::panel(const std::string& ylabel) {
  ++panels_;
  variables_[of_panel("ylabel")] = with_kept_blanks(ylabel);
  if (panels_ == 2) variables_["height"] = "560";
}

void Plot::begin(const std::string& legend, const std::string& look) {
  const char* between = curves_++ == 0 ? "" : "|";
  legend_ += between + with_kept_blanks(legend);
  looks_ += fmt::format("{}{}{}", between, panels_, look);
}

void Plot::add(double x, double y) { data_.add({curves_, std::int64_t{panels_}, x, y}); }

void Plot::curve(const std::string& legend, const std::string& look, const std::vector<double>& x,
                 const std::vector<double>& y) {
  begin(legend, look);
  for (std::size_t i = 0; i < x.size(); ++i) add(x[i], y[i]);
}

void Plot::label(const std::string& text, double x, double y, const std::string& side) {
  labels_ += fmt::format("{}{}@{}@{:.9g}@{:.9g}@{}", labels_.empty() ? "" : "|", panels_, text, x, y, side);
}

void Plot::log_x(double low, double high) {
  variables_["logx"] = "1";
  variables_["xrange"] = range(low, high);
  variables_["xtics"] = powers_of_ten(low, high);
  variables_["xtics_blank"] = powers_of_ten(low, high, false);
}

void Plot::log_y(double low, double high) {
  variables_[of_panel("logy")] = "1";
  variables_[of_panel("yrange")] = range(low, high);
  variables_[of_panel("ytics")] = powers_of_ten(low, high);
}

void Plot::x_range(double low, double high) { variables_["xrange"] = range(low, high); }
void Plot::y_range(double low, double high) { variables_[of_panel("yrange")] = range(low, high); }
void Plot::y_tics(double first, double step) {
  variables_[of_panel("ytics")] = fmt::format("{:.9g},{:.9g}", first, step);
}

Plot& Plot::with(const std::string& name, const std::string& value) {
  variables_[name] = value;
  return *this;
}

scene::Figure Plot::take() {
  variables_["legend"] = legend_;
  variables_["looks"] = looks_;
  variables_["panels"] = std::to_string(panels_);
  if (!labels_.empty()) variables_["labels"] = labels_;
  return {std::move(data_), "gss_control-plots", std::move(variables_)};
}

std::vector<double> logarithmic(double low, double high, int n) {
  if (!(low > 0 && high > low) || n < 2)
    throw std::invalid_argument(fmt::format("logarithmic: {} points from {:.6g} to {:.6g}", n, low, high));
  std::vector<double> all;
  const double first = std::log10(low), length = std::log10(high) - first;  // powers of ten stay themselves
  for (int i = 0; i < n; ++i) all.push_back(std::pow(10, first + length * i / (n - 1)));
  all.front() = low;  // as typed, not as rounded
  all.back() = high;
  return all;
}

std::vector<double> equidistant(double low, double high, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(low + (high - low) * i / (n - 1));
  return all;
}

}  // namespace nlmech::chapters
