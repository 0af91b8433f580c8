#include "nlmech/scene/work_precision.hpp"

#include <utility>

#include "nlmech/scene/cost/drawing.hpp"

namespace nlmech::scene {
namespace {

/// Adds a block of rows for each line that has a point, then for each problem a block of its fastest methods.
void add_rows(Diagram& d) {
  int block = 0;
  const auto colour = [&](std::size_t line) {
    const InColour* c = d.colour_of(line);
    return c != nullptr ? Cell(c->colour + 1) : Cell();
  };
  for (std::size_t p = 0; p < d.problems.size(); ++p) {
    auto& blocks = d.blocks.emplace_back();
    for (std::size_t i = 0; i < d.problems[p].lines.size(); ++i) {
      const MethodLine& line = d.problems[p].lines[i];
      blocks.push_back(line.best() != nullptr ? block++ : -1);
      if (line.best() == nullptr) continue;
      for (const Attempt& a : line.attempts) {
        std::vector<Cell> row = {block,           p + 1,          d.what.groups.at(line.group).name,
                                 colour(i),       a.digits(),     a.time.median,
                                 a.time.smallest, a.time.largest, a.status,
                                 line.method,     a.setting,      Cell(),
                                 Cell()};
        row.insert(row.end(), a.work.begin(), a.work.end());
        d.data.add(std::move(row));
      }
    }
  }
  for (std::size_t p = 0; p < d.problems.size(); ++p) {
    const auto& lines = d.problems[p].lines;
    ++block;
    for (const Ranking& ranking : rankings_of(d.problems[p])) {
      if (!ranking.first) continue;
      const MethodLine& line = lines[*ranking.first];
      std::vector<Cell> row = {block,
                               p + 1,
                               d.what.groups.at(line.group).name,
                               colour(*ranking.first),
                               ranking.digits,
                               ranking.time,
                               Cell(),
                               Cell(),
                               "fastest",
                               line.method,
                               Cell()};
      if (ranking.next) row.insert(row.end(), {lines[*ranking.next].method, ranking.factor});
      row.resize(d.data.columns().size());
      d.data.add(std::move(row));
    }
  }
}

Diagram diagram_of(const WorkPrecision& what, const std::vector<ProblemLines>& problems) {
  std::vector<Column> columns = {{"line", 3, true}, {"problem"},    {"kind"},        {"colour"}, {"digits"},
                                 {"time_s"},        {"time_low_s"}, {"time_high_s"}, {"status"}, {"method"},
                                 {"setting"},       {"next"},       {"factor"}};
  for (const std::string& w : what.work) columns.push_back({w});
  Diagram d{
      what, problems, foreground(what.groups, problems, what.least_digits), Table(std::move(columns)), {}};
  add_rows(d);
  return d;
}

Table tabulate(const WorkPrecision& what, const std::vector<ProblemLines>& problems) {
  const double scale = what.unit == "ms" ? 1e3 : what.unit == "ns" ? 1e9 : 1e6;
  std::vector<Column> columns;
  if (problems.size() > 1) columns.push_back({"problem"});
  const Column error = what.error.empty() ? Column{"digits"} : Column{what.error, 2};
  for (const Column& c : {Column{"method"}, Column{"setting"}, Column{"status"}, error,
                          Column{"time (" + what.unit + ")"}, Column{"from"}, Column{"to"}})
    columns.push_back(c);
  for (const std::string& w : what.work) columns.push_back({w});
  Table table(columns);
  for (const ProblemLines& p : problems) {
    for (const MethodLine& line : p.lines) {
      std::vector<Cell> begin;
      if (problems.size() > 1) begin.emplace_back(p.problem);
      begin.emplace_back(line.method);
      if (line.attempts.empty()) {
        std::vector<Cell> row = begin;
        row.insert(row.end(), {Cell(), "not in this build"});
        row.resize(columns.size());
        table.add(std::move(row));
      }
      for (const Attempt& a : line.attempts) {
        std::vector<Cell> row = begin;
        row.insert(row.end(), {a.setting, a.status, what.error.empty() ? a.digits() : a.error,
                               scale * a.time.median, scale * a.time.smallest, scale * a.time.largest});
        row.insert(row.end(), a.work.begin(), a.work.end());
        table.add(std::move(row));
      }
    }
  }
  return table;
}

}  // namespace

void show_work_precision(const WorkPrecision& what, const std::vector<ProblemLines>& problems, Show& show) {
  show.draw(drawn(diagram_of(what, problems)));
  show.table(tabulate(what, problems));
}

}  // namespace nlmech::scene
