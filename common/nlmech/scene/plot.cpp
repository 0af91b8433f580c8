#include "nlmech/scene/plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

std::string range(const char* axis, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high) || low == high)
    throw invalid_argument("Plot: no range from {:g} to {:g}", low, high);
  return fmt::format("set {}range [{:.12g}:{:.12g}]\n", axis, low, high);
}

/// First tag of labels and arrows; gnuplot gives lower numbers to those without a tag.
constexpr int first_tag = 1000;

/// Tics of a logarithmic axis: at 1, 2 and 5 times powers of ten on a short axis, else at every power or
/// every n-th one, as there is room.
std::string decades(const char* axis, double low, double high) {
  const double count = std::log10(high / low);
  if (count > 30) {  // explicit list: gnuplot 5.4 hangs on steps of ten powers
    std::vector<std::string> tics;
    for (int power = 10 * static_cast<int>(std::ceil(std::log10(low) / 10)); power <= std::log10(high);
         power += 10)
      tics.push_back(fmt::format("1e{}", power));
    return fmt::format("set {0}tics ({1})\nset format {0} power_of_ten\n", axis, fmt::join(tics, ", "));
  }
  if (count > 2.5) {
    const int every = count <= 6 ? 1 : count <= 16 ? 2 : 4;
    return fmt::format("set {0}tics 1e{1}\nset m{0}tics 1\nset format {0} power_of_ten\n", axis, every);
  }
  std::vector<std::string> tics;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high; ++power) {
    for (const int digit : {1, 2, 5}) tics.push_back(fmt::format("{}e{}", digit, power));
  }
  return fmt::format("set {}tics ({})\n", axis, fmt::join(tics, ", "));
}

/// A logarithmic range with its tics.
std::string log_range(const char* axis, double low, double high) {
  if (!(low > 0 && high > low))
    throw invalid_argument("Plot: no logarithmic axis from {:g} to {:g}", low, high);
  return fmt::format("set logscale {}\n", axis) + range(axis, low, high) + decades(axis, low, high);
}

/// `using "t":"laier"` for "t:laier"; a part with parentheses is an expression.
std::string by_name(const std::string& columns) {
  std::string out = "using ", part;
  int depth = 0;
  const auto end = [&] { out += part.find('(') != std::string::npos ? part : '"' + part + '"'; };
  for (const char c : columns) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c != ':' || depth > 0) {
      part += c;
      continue;
    }
    end();
    out += c;
    part.clear();
  }
  end();
  return out;
}

std::string margins_at(double left, double right, double bottom, double top) {
  return fmt::format("margins screen {:.4g}, screen {:.4g}, screen {:.4g}, screen {:.4g}", left, right,
                     bottom, top);
}

}  // namespace

std::string with_kept_blanks(std::string text) {
  const std::string mark = "\u200b";  // zero-width space
  for (const char* const edge : {" {", "} "}) {
    for (std::size_t at = 0; (at = text.find(edge, at)) != std::string::npos; at += mark.size() + 1)
      text.insert(at + 1, mark);
  }
  // A sub- or superscript of one letter ends without a brace.
  for (std::size_t at = 0; (at = text.find_first_of("_^", at)) != std::string::npos; ++at) {
    if (at + 2 < text.size() && text[at + 2] == ' ') text.insert(at + 2, mark);
  }
  return text;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

CurveStyle lines(int style) { return {"lines", style}; }
CurveStyle thin_lines(int style) { return {"lines linewidth 1", style}; }
CurveStyle points(int style) { return {"points", style}; }
CurveStyle large_points(int style) { return {"points pointsize 1", style}; }
CurveStyle linespoints(int style) { return {"linespoints linewidth 1.2", style}; }

Panel::Panel(Plot& plot, std::size_t number, std::string x_label, std::string y_label)
    : plot_(plot), number_(number), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

Panel& Panel::log_x() {
  settings_ += "set logscale x\nset format x power_of_ten\n";
  return *this;
}
Panel& Panel::log_x(double low, double high) {
  settings_ += log_range("x", low, high);
  return *this;
}
Panel& Panel::log_y() {
  log_y_ = true;
  settings_ += "set logscale y\nset format y power_of_ten\n";
  return *this;
}
Panel& Panel::log_y(double low, double high) {
  log_y_ = true;
  settings_ += log_range("y", low, high);
  return *this;
}
Panel& Panel::x_range(double low, double high) {
  settings_ += range("x", low, high);
  return *this;
}
Panel& Panel::y_range(double low, double high) {
  settings_ += range("y", low, high);
  return *this;
}
Panel& Panel::caption(const std::string& text) {
  caption_ = with_kept_blanks(text);
  return *this;
}
Panel& Panel::key(const std::string& place) {
  key_below_ = place == "below";
  if (!key_below_) settings_ += place == "off" ? "unset key\n" : "set key " + place + "\n";
  return *this;
}
Panel& Panel::set(const std::string& setting) {
  settings_ += "set " + setting + "\n";
  return *this;
}

Panel& Panel::note(const std::string& text, double x, double y, const std::string& side) {
  settings_ += fmt::format("set label {} {} at {:.12g},{:.12g} {} front textcolor rgb ink\n",
                           first_tag + ++notes_, gnuplot_quoted(with_kept_blanks(text)), x, y, side);
  return *this;
}

Panel& Panel::level(double y, const std::string& text) {
  settings_ +=
      fmt::format("set arrow {} from graph 0, first {:.12g} to graph 1, first {:.12g} nohead linestyle 11\n",
                  first_tag + ++notes_, y, y);
  if (!text.empty()) {
    settings_ +=
        fmt::format("set label {} {} at graph 0.01, first {:.12g} left offset 0,0.6 textcolor rgb soft_ink\n",
                    first_tag + notes_, gnuplot_quoted(with_kept_blanks(text)), y);
  }
  return *this;
}

Panel& Panel::mark(double x, const std::string& text) {
  settings_ +=
      fmt::format("set arrow {} from first {:.12g}, graph 0 to first {:.12g}, graph 1 nohead linestyle 13\n",
                  first_tag + ++notes_, x, x);
  if (!text.empty()) {
    settings_ += fmt::format(
        "set label {} {} at first {:.12g}, graph 0.03 right offset -0.5,0 textcolor rgb soft_ink\n",
        first_tag + notes_, gnuplot_quoted(with_kept_blanks(text)), x);
  }
  return *this;
}

Panel& Panel::add(const std::string& name, const std::string& what, const CurveStyle& curve_style) {
  const int style = curve_style.style > 0 ? curve_style.style : styles_ + 1;
  if (curve_style.style == 0) styles_ = style;
  const auto blank = curve_style.with.find(' ');
  elements_.push_back(
      fmt::format("{} with {} linestyle {}{} {}", what, curve_style.with.substr(0, blank), style,
                  blank == std::string::npos ? "" : curve_style.with.substr(blank),
                  name.empty() ? "notitle" : "title " + gnuplot_quoted(with_kept_blanks(name))));
  return *this;
}

Panel& Panel::curve(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                    const CurveStyle& curve_style) {
  const auto block = plot_.blocks_;
  plot_.add_curve(number_, x, y);
  const auto& names = plot_.names_;
  return add(name,
             fmt::format("data using \"{}\":\"{}\" every :::{}::{}", names[names.size() - 2], names.back(),
                         block, block),
             curve_style);
}

Panel& Panel::columns(const std::string& name, const std::string& columns, const CurveStyle& curve_style,
                      int block) {
  const std::string every = block < 0 ? "" : fmt::format(" every :::{}::{}", block, block);
  return add(name, "data " + by_name(columns) + every, curve_style);
}

Panel& Panel::also(const std::string& element) {
  elements_.push_back(element);
  return *this;
}

Panel& Panel::place(double left, double right, double bottom, double top) {
  return set(margins_at(left, right, bottom, top));
}

Plot::Plot(const std::string& heading)
    : heading_(with_kept_blanks(heading)), data_({{"curve", 3, true}, {"x"}, {"y"}}) {}

Panel& Plot::panel(const std::string& x_label, const std::string& y_label) {
  panels_.push_back(Panel(*this, panels_.size() + 1, with_kept_blanks(x_label), with_kept_blanks(y_label)));
  return panels_.back();
}

Plot& Plot::stacked(std::vector<double> shares) {
  stacked_ = true;
  shares_ = std::move(shares);
  return *this;
}

Plot& Plot::size(int width, int height) {
  if (width <= 0 || height <= 0) throw std::invalid_argument("Plot: a size is positive");
  width_ = width;
  height_ = height;
  return *this;
}

Plot& Plot::columns(const std::vector<std::string>& names) {
  if (names.size() < 3 || names.size() > 4 || blocks_ > 0)
    throw std::invalid_argument("Plot: three or four columns, named before the first curve");
  std::vector<Column> columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    columns.push_back({names[i], 3, i + 2 < names.size() && names[i] != "panel"});
  names_ = names;
  data_ = Table(std::move(columns));
  return *this;
}

Plot& Plot::data(Table table) {
  data_ = std::move(table);
  own_data_ = true;
  return *this;
}

void Plot::add_curve(std::size_t panel, const std::vector<double>& x, const std::vector<double>& y) {
  if (own_data_)
    throw std::logic_error("Plot: curves with data of their own cannot be combined with shared data");
  if (x.size() != y.size()) throw std::invalid_argument("Plot: different numbers of abscissae and ordinates");
  if (x.empty()) throw std::invalid_argument("Plot: a curve without points");
  ++blocks_;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<Cell> row;
    for (std::size_t c = 0; c + 2 < names_.size(); ++c)
      row.emplace_back(names_[c] == "panel" ? static_cast<std::int64_t>(panel) : blocks_);
    row.emplace_back(x[i]);
    row.emplace_back(y[i]);
    data_.add(std::move(row));
  }
}

std::size_t Plot::curves() const {
  std::size_t count = 0;
  for (const Panel& p : panels_) count += p.elements_.size();
  return count;
}

std::string Plot::prelude() const {
  return width_ == 760 && height_ == 520 ? "" : fmt::format("width = {}\nheight = {}\n", width_, height_);
}

/// Margins of a panel as fractions of the picture, with room in pixels for tics, labels and the heading.
std::string Plot::margins(const Panel& panel) const {
  if (panels_.size() == 1) return "";
  const double count = static_cast<double>(panels_.size()), k = static_cast<double>(panel.number_);
  const double w = width_, h = height_;
  double left = 0.135, right = 0.965, top = 1 - 50 / h, bottom = 72 / h;
  if (stacked_) {
    std::vector<double> shares = shares_;
    shares.resize(panels_.size(), 1);
    const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
    const auto here = shares.begin() + static_cast<std::ptrdiff_t>(panel.number_) - 1;
    const double height = top - bottom;
    top -= height * std::accumulate(shares.begin(), here, 0.0) / whole;
    bottom = top - height * *here / whole;
    top -= k > 1 ? 0.02 : 0;
    bottom += k < count ? 0.02 : 0;
  } else {
    left = (k - 1) / count + (panel.log_y_ ? 95 : 75) / w;
    right = k / count - 18 / w;
    top = panel.caption_.empty() ? 0.92 : 0.87;
    bottom = 0.16;
  }
  return "set " + margins_at(left, right, bottom, top) + '\n';
}

std::string Plot::script() const {
  const bool several = panels_.size() > 1;
  std::string out = several ? fmt::format(
                                  "set multiplot\nset label 1 {} at screen 0.5, screen {:.4g} center "
                                  "font sprintf(\"%s:Bold,%d\", font_family, font_size + 1)\n",
                                  gnuplot_quoted(heading_), 1 - 18.0 / height_)
                            : fmt::format("set title {}\n", gnuplot_quoted(heading_));
  for (const Panel& p : panels_) {
    const bool last = p.number_ == panels_.size(), labelled = last || !stacked_;
    if (p.number_ > 1) {
      out +=
          "\nunset label\nunset arrow\nunset logscale\nset format \"%g\"\nset xtics autofreq\nset ytics "
          "autofreq\n"
          "set xrange [*:*]\nset yrange [*:*]\nset key default inside top right Left reverse noautotitle "
          "opaque "
          "fillcolor \"#ffffff\" samplen 4 spacing 1.25 textcolor rgb ink\n";
    }
    out += margins(p);
    if (labelled)
      out += fmt::format("set xlabel {}\n", gnuplot_quoted(p.x_label_));
    else
      out += "set xlabel ''\n";
    out += fmt::format("set ylabel {} offset 0.5,0\n", gnuplot_quoted(p.y_label_));
    if (!p.caption_.empty())
      out +=
          fmt::format("set label 2 {} at graph 0, graph 1 left offset 0,0.45\n", gnuplot_quoted(p.caption_));
    out += p.settings_;
    if (p.key_below_) {
      out += fmt::format(
          "set bmargin 7\nset key at screen 0.53, screen {:.4g} center top maxrows 2 samplen 3 width -2\n",
          60.0 / height_);
    }
    if (!labelled) out += "set format x ''\n";
    out += fmt::format("plot {}\n", fmt::join(p.elements_, ", \\\n     "));
  }
  return out + (several ? "unset multiplot\n" : "");
}

}  // namespace nlmech::scene
