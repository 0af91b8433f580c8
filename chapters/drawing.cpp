#include "chapters/drawing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace nlmech::chapters {

Spot operator+(Spot a, Spot b) { return {a.x + b.x, a.y + b.y}; }
Spot operator-(Spot a, Spot b) { return {a.x - b.x, a.y - b.y}; }
Spot operator*(double s, Spot a) { return {s * a.x, s * a.y}; }
double length(Spot a) { return std::hypot(a.x, a.y); }
Spot direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

void Drawing::path(const std::string& kind, const std::vector<Spot>& points) {
  ++paths_;
  for (const Spot& p : points) table_.add({kind, paths_, p.x, p.y, 0.0, 0.0});
}

void Drawing::arrow(Spot from, Spot to, const std::string& kind) {
  table_.add({kind, ++paths_, from.x, from.y, to.x - from.x, to.y - from.y});
}

void Drawing::text(const std::string& words, Spot at, const std::string& shade) {
  labels_ += fmt::format("{}{}@{:.9g}@{:.9g}@{}", labels_.empty() ? "" : "|", scene::with_kept_blanks(words),
                         at.x, at.y, shade);
}

void Drawing::joint(Spot at) { table_.add({"joint", ++paths_, at.x, at.y, 0.0, 0.0}); }

void Drawing::arc(const std::string& kind, Spot centre, double radius, double from, double to) {
  constexpr int pieces = 72;
  std::vector<Spot> points;
  for (int i = 0; i <= pieces; ++i)
    points.push_back(centre + radius * direction(from + (to - from) * i / pieces));
  path(kind, points);
}

void Drawing::turn(Spot centre, double radius, double from, double to, const std::string& kind) {
  arc("thin", centre, radius, from, to);
  const double before = to - 0.12 * (to > from ? 1 : -1);
  arrow(centre + radius * direction(before), centre + radius * direction(to), kind);
}

scene::Figure Drawing::take(std::map<std::string, std::string> variables) {
  variables["labels"] = labels_;
  return {std::move(table_), "drawing", std::move(variables)};
}

void FlowChart::box(Spot centre, Spot half, const std::vector<std::string>& lines) {
  const Spot other{half.x, -half.y};
  drawing_.path("body", {centre + half, centre + other, centre - half, centre - other, centre + half});
  write(centre, lines);
}

void FlowChart::decision(Spot centre, Spot half, const std::vector<std::string>& lines) {
  const Spot across{half.x, 0}, up{0, half.y};
  drawing_.path("body", {centre + across, centre + up, centre - across, centre - up, centre + across});
  write(centre, lines);
}

void FlowChart::arrow(const std::vector<Spot>& points) {
  if (points.size() > 2) drawing_.path("outline", {points.begin(), points.end() - 1});
  drawing_.arrow(points[points.size() - 2], points.back(), "axis");
}

void FlowChart::write(Spot centre, const std::vector<std::string>& lines) {
  constexpr double pitch = 4.3;
  double y = centre.y + pitch * (static_cast<double>(lines.size()) - 1) / 2;
  for (const std::string& line : lines) {
    drawing_.text(line, {centre.x, y});
    y -= pitch;
  }
}

scene::Figure FlowChart::take(const std::string& heading) {
  return drawing_.take({{"heading", heading},
                        {"xrange", "[0:100]"},
                        {"yrange", "[0:100]"},
                        {"free", "1"},
                        {"letters", "12"},
                        {"head", "1.5"}});
}

}  // namespace nlmech::chapters
