#include "nlmech/comparison/commands/catalogue_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "nlmech/scene/catalogue/shard.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::comparison {
namespace {

/// Lines and rows that are worked on at a time, if they make work for all lanes and threads.
constexpr double lines_at_a_time = 1e5, most_rows = 1024;
/// The column of ends.
constexpr const char* end_column = "until";

std::chrono::steady_clock::time_point deadline_after(double seconds) {
  using std::chrono::steady_clock;
  if (!(seconds < 1e9)) return steady_clock::time_point::max();
  return steady_clock::now() +
         std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
}

class Runner {
 public:
  explicit Runner(const CatalogueRuns& runs)
      : runs_(runs),
        base_(runs.problem({})),
        states_(base_->state_names()),
        request_(runs.request(*base_, initial_state(*base_))),
        parameters_(names_of(base_->parameters())),
        columns_(joined(states_, parameters_)),
        farthest_(request_.t1),
        catalogue_(
            runs.file, {}, joined(columns_, {end_column}), [this](const auto& row) { return complaint(row); },
            scene::NameCase::exact),
        method_(method_of_all()) {
    if (std::none_of(columns_.begin(), columns_.end(),
                     [this](const auto& name) { return catalogue_.has(name); }))
      throw input_error("{}: none of its columns is an unknown or a parameter; there are {}",
                        catalogue_.name(), fmt::join(columns_, ", "));
    if (!missing_.empty() && !std::all_of(states_.begin(), states_.end(),
                                          [this](const auto& name) { return catalogue_.has(name); }))
      throw InputError(missing_);
    const bool is_end = joined(columns_, {end_column}).size() > columns_.size();
    const bool has_ends = is_end && catalogue_.has(end_column);
    if (runs.until && has_ends)
      throw input_error("--until {}: {} has a column until", *runs.until, catalogue_.name());
    if (!runs.until && !has_ends && !base_->final_time())
      throw input_error("{}: has no column until; give it, or --until T for all rows", catalogue_.name());
  }

  [[nodiscard]] int print() {
    // Rows have as many lines as --every makes of them, and count for so many that most_rows make a portion.
    catalogue_.weigh_by(
        [this](const auto& row) { return std::max(lines_at_a_time / most_rows, lines(row)); });
    scene::print_catalogue(
        catalogue_, {.shard = runs_.shard,
                     .options = fmt::format("{} {} {}", runs_.typed, method_.name,
                                            Choice{method_, request_.settings}.setting()),
                     .header = fmt::format("row,t,{}{}{},status", fmt::join(states_, ","),
                                           request_.events.empty() ? "" : ",event",
                                           catalogue_.columns().rest_names({"row", "t", "event", "status"})),
                     .portion = scene::portion_for(lines_at_a_time, runs_.threads),
                     .work = [this](const scene::CatalogueRows& rows) { return lines_of(rows); },
                     .failed = [this] { return failed_; }});
    if (open_ > 1)
      scene::tell(
          fmt::format("{}: {} of the runs are not verified; the first is {}", runs_.program, open_, remark_));
    else if (!remark_.empty())
      scene::tell(fmt::format("{}: {}", runs_.program, remark_));
    if (failed_ == 0) return 0;
    scene::tell(fmt::format("{}: {} of the runs failed; the first is row {}: {}", runs_.program, failed_,
                            first_, sentence_));
    return 1;
  }

 private:
  /// That of a row without columns; if one is missing and nothing was said of it, zeros and why.
  [[nodiscard]] std::vector<double> initial_state(const OwnProblem& problem) {
    try {
      return runs_.initial_state(problem);
    } catch (const InputError& error) {
      if (runs_.is_initial_given) throw;
      missing_ = error.what();
      return std::vector<double>(states_.size());
    }
  }
  static std::vector<std::string> names_of(const CatalogueRuns::Values& values) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.push_back(name);
    return names;
  }
  /// Names without those that are there already.
  static std::vector<std::string> joined(std::vector<std::string> names,
                                         const std::vector<std::string>& more) {
    for (const std::string& name : more) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }
  /// Where a row ends.
  [[nodiscard]] double end(const std::vector<double>& row) const {
    return has_end(row) ? row.back() : request_.t1;
  }
  [[nodiscard]] bool has_end(const std::vector<double>& row) const {
    return row.size() > columns_.size() && !std::isnan(row.back());
  }
  [[nodiscard]] double lines(const std::vector<double>& row) const {
    return request_.every ? std::abs(end(row) - request_.t0) / *request_.every + 2 : 2;
  }
  /// With the parameters of a row, NaN standing where there is no column.
  [[nodiscard]] std::shared_ptr<const OwnProblem> problem_of(const std::vector<double>& row) const {
    CatalogueRuns::Values values;
    for (std::size_t i = states_.size(); i < columns_.size(); ++i) {
      if (!std::isnan(row[i])) values.emplace_back(columns_[i], row[i]);
    }
    return values.empty() ? base_ : runs_.problem(values);
  }
  /// What is asked of a row.
  [[nodiscard]] Request request_of(const std::vector<double>& row,
                                   const std::shared_ptr<const OwnProblem>& problem) const {
    Request request = request_;
    if (problem != base_)
      request = runs_.request(
          *problem, missing_.empty() ? runs_.initial_state(*problem) : std::vector<double>(states_.size()));
    if (has_end(row)) request.t1 = row.back();
    check_rows(request);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      if (!std::isnan(row[k])) request.x0[k] = row[k];
    }
    return request;
  }
  /// Called while the catalogue is made, too: only what is before it in this class is there.
  [[nodiscard]] std::string complaint(const std::vector<double>& row) {
    try {
      static_cast<void>(request_of(row, problem_of(row)));
    } catch (const std::exception& error) {
      return error.what();
    }
    if (first_row_.empty()) first_row_ = row;
    if (std::abs(end(row) - request_.t0) > std::abs(farthest_ - request_.t0)) farthest_ = end(row);
    return {};
  }
  [[nodiscard]] ivp::MethodInfo method_of_all() const {
    const auto problem = first_row_.empty() ? base_ : problem_of(first_row_);
    Request request = first_row_.empty() ? request_ : request_of(first_row_, problem);
    request.t1 = farthest_;
    return runs_.method(*problem, request);
  }

  [[nodiscard]] std::string lines_of(const scene::CatalogueRows& rows) {
    const std::size_t count = rows.numbers.size();
    std::vector<std::shared_ptr<const OwnProblem>> problems(count);
    std::vector<Posed> posed(count);
    share_out(count, 1, runs_.threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        problems[i] = problem_of(rows.numbers[i]);
        posed[i] = {problems[i].get(), request_of(rows.numbers[i], problems[i])};
        posed[i].request.deadline = deadline_;
      }
    });
    const std::vector<Ended> ends = base_->trajectories(posed, method_, runs_.threads);
    const auto row = [&rows](std::size_t i) { return rows.first + static_cast<std::int64_t>(i); };
    for (std::size_t i = 0; i < count; ++i) note(row(i), ends[i]);
    return scene::lines_in_threads(count, runs_.threads, [&](std::size_t i, std::string& lines) {
      add_lines(row(i), rows.rest[i], ends[i], lines);
    });
  }

  /// Remembers the first remark, which is that of a run that is not verified if there is one, and the first
  /// failure.
  void note(std::int64_t row, const Ended& end) {
    const Trajectory& run = end.trajectory;
    if ((run.is_open && open_++ == 0) || (remark_.empty() && !run.remark.empty()))
      remark_ = fmt::format("row {}: {}", row, run.remark);
    if (end.status.ok() || failed_++ > 0) return;
    first_ = row;
    sentence_ = end.status.text();
  }

  void add_lines(std::int64_t row, const std::string& rest, const Ended& end, std::string& lines) const {
    if (!end.status.ok()) {
      const std::size_t empty = states_.size() + 1 + (request_.events.empty() ? 0 : 1);
      lines +=
          fmt::format("{}{}{},{}\n", row, std::string(empty, ','), rest, to_string(end.status.outcome()));
      return;
    }
    std::string_view text = end.trajectory.rows;
    text.remove_prefix(text.find('\n') + 1);  // its header
    const std::string head = fmt::format("{},", row), tail = fmt::format("{},success\n", rest);
    while (!text.empty()) {
      const std::size_t length = text.find('\n');
      lines.append(head).append(text.substr(0, length)).append(tail);
      text.remove_prefix(length + 1);
    }
  }

  const CatalogueRuns& runs_;
  std::chrono::steady_clock::time_point deadline_ = deadline_after(runs_.seconds);
  std::shared_ptr<const OwnProblem> base_;
  std::string missing_;  // why there is no initial state
  std::vector<std::string> states_;
  Request request_;
  std::vector<std::string> parameters_, columns_;
  std::vector<double> first_row_;
  double farthest_;
  scene::Catalogue catalogue_;
  ivp::MethodInfo method_;
  std::int64_t failed_ = 0, first_ = 0, open_ = 0;
  std::string sentence_, remark_;
};

}  // namespace

int print_runs(const CatalogueRuns& runs) { return Runner(runs).print(); }

}  // namespace nlmech::comparison
