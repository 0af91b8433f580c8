#include "nlmech/comparison/commands/runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>

#include "nlmech/comparison/commands/compare.hpp"
#include "nlmech/scene/catalogue/catalogue.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::comparison {
namespace {

/// Greatest numbers of output lines and of rows in a portion, which must occupy all SIMD lanes and threads.
constexpr double lines_at_a_time = 1e5, most_rows = 1024;
/// Column of the end times.
constexpr const char* end_column = "until";

std::chrono::steady_clock::time_point deadline_after(const std::optional<double>& seconds) {
  using std::chrono::steady_clock;
  if (!(seconds.value_or(1e9) < 1e9)) return steady_clock::time_point::max();
  return steady_clock::now() +
         std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(*seconds));
}

/// Union of names in their order.
std::vector<std::string> joined(std::vector<std::string> names, const std::vector<std::string>& more) {
  for (const std::string& name : more) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<std::string> states_and_parameters(const UserProblem& problem) {
  std::vector<std::string> parameters;
  for (const auto& [name, value] : problem.parameters) parameters.push_back(name);
  return joined(problem.state_names, parameters);
}

/// Runs of all rows of a file.
class CatalogueRun {
 public:
  CatalogueRun(const TypedOptions& typed, std::string program)
      : typed_(typed),
        program_(std::move(program)),
        threads_(typed.threads.value_or(0)),
        make_(problem_of(typed)),
        base_(std::make_shared<const UserProblem>(make_({}))),
        states_(base_->state_names),
        options_(run_options(typed, *base_, initial_state(*base_))),
        columns_(states_and_parameters(*base_)),
        farthest_(options_.t1),
        catalogue_(
            typed.states, {}, joined(columns_, {end_column}),
            [this](const auto& row) { return row_error(row); }, scene::NameCase::exact),
        method_(method_of_all()) {
    const auto has = [this](const auto& name) { return catalogue_.has(name); };
    if (std::ranges::none_of(columns_, has))
      throw input_error("{}: none of its columns is an unknown or a parameter; choose from {}",
                        catalogue_.name(), fmt::join(columns_, ", "));
    if (!missing_.empty() && !std::ranges::all_of(states_, has)) throw InputError(missing_);
    const bool is_end = joined(columns_, {end_column}).size() > columns_.size();
    const bool has_ends = is_end && catalogue_.has(end_column);
    if (!typed.until.empty() && has_ends)
      throw input_error("--until {}: {} has a column until", quoted_input(typed.until), catalogue_.name());
    if (typed.until.empty() && !has_ends && !base_->t1)
      throw input_error("{}: has no column until; add one, or give --until T for all rows",
                        catalogue_.name());
  }

  [[nodiscard]] int print() {
    // A row weighs as many lines as --every prints, but at least so many that most_rows fill a portion.
    catalogue_.set_row_weight(
        [this](const auto& row) { return std::max(lines_at_a_time / most_rows, lines(row)); });
    const std::vector<std::string> printed = printed_names(*base_, options_);
    std::vector<std::string> taken = options_.columns.names;
    taken.insert(taken.end(), {"row", "t", "event", "status"});
    scene::print_catalogue(catalogue_,
                           {.header = fmt::format("row,t,{}{}{},status", fmt::join(printed, ","),
                                                  options_.events.empty() ? "" : ",event",
                                                  catalogue_.columns().rest_names(taken)),
                            .portion = scene::portion_for(lines_at_a_time, threads_),
                            .work = [this](const scene::CatalogueRows& rows) { return lines_of(rows); }});
    if (open_ > 1)
      scene::print_message(
          fmt::format("{}: {} of the runs are not verified; the first is {}", program_, open_, remark_));
    else if (!remark_.empty())
      scene::print_message(fmt::format("{}: {}", program_, remark_));
    if (failed_ == 0) return 0;
    scene::print_message(fmt::format("{}: {} of the runs failed; the first is row {}: {}", program_, failed_,
                                     first_, sentence_));
    return 1;
  }

 private:
  /// Initial state without columns of the file. If it is incomplete and without `--initial`: zeros, and the
  /// reason in missing_.
  [[nodiscard]] ivp::State initial_state(const UserProblem& problem) {
    try {
      return problem.initial_state(typed_.initial);
    } catch (const InputError& error) {
      if (!typed_.initial.empty()) throw;
      missing_ = error.what();
      return ivp::State::Zero(static_cast<Eigen::Index>(states_.size()));
    }
  }
  /// End time of a row.
  [[nodiscard]] double end(const std::vector<double>& row, double without_column) const {
    return row.size() > columns_.size() && !std::isnan(row.back()) ? row.back() : without_column;
  }
  [[nodiscard]] double end(const std::vector<double>& row) const { return end(row, options_.t1); }
  [[nodiscard]] double lines(const std::vector<double>& row) const {
    const auto others = static_cast<double>(options_.at.size() + 2);
    return options_.every ? std::abs(end(row) - options_.t0) / *options_.every + others : others;
  }
  /// Problem and options of a row, whose numbers are NaN for missing columns.
  [[nodiscard]] EnsembleMember member_of(const std::vector<double>& row) const {
    program::Settings values;
    for (std::size_t i = states_.size(); i < columns_.size(); ++i) {
      if (!std::isnan(row[i])) values.emplace(columns_[i], row[i]);
    }
    EnsembleMember member{base_, options_};
    if (!values.empty()) {
      const auto problem = std::make_shared<const UserProblem>(make_(values));
      member = {problem,
                run_options(typed_, *problem,
                            missing_.empty() ? problem->initial_state(typed_.initial) : options_.x0)};
    }
    RunOptions& options = member.options;
    options.t1 = end(row, options.t1);
    options.check_rows();
    for (std::size_t k = 0; k < states_.size(); ++k) {
      if (!std::isnan(row[k])) options.x0[static_cast<Eigen::Index>(k)] = row[k];
    }
    options.start_with_changes();
    options.deadline = deadline_;
    return member;
  }
  /// Error message of a row, empty if it is valid. The constructor of catalogue_ calls it, so that it may use
  /// only members declared before catalogue_.
  [[nodiscard]] std::string row_error(const std::vector<double>& row) {
    try {
      static_cast<void>(member_of(row));
    } catch (const std::exception& error) {
      return error.what();
    }
    if (first_row_.empty()) first_row_ = row;
    if (std::abs(end(row) - options_.t0) > std::abs(farthest_ - options_.t0)) farthest_ = end(row);
    return {};
  }
  [[nodiscard]] const ivp::MethodInfo& method_of_all() const {
    EnsembleMember first = first_row_.empty() ? EnsembleMember{base_, options_} : member_of(first_row_);
    first.options.t1 = farthest_;
    return method_of(typed_, *first.problem, first.options);
  }

  [[nodiscard]] std::string lines_of(const scene::CatalogueRows& rows) {
    const std::size_t count = rows.numbers.size();
    std::vector<EnsembleMember> members(count);
    share_out(count, 1, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) members[i] = member_of(rows.numbers[i]);
    });
    const std::vector<EnsembleResult> ends = trajectories(members, method_, typed_.method.empty(), threads_);
    const auto row = [&rows](std::size_t i) { return rows.first + static_cast<std::int64_t>(i); };
    for (std::size_t i = 0; i < count; ++i) note(row(i), ends[i]);
    return scene::lines_in_threads(count, threads_, [&](std::size_t i, std::string& lines) {
      add_lines(row(i), rows.rest[i], ends[i], lines);
    });
  }

  /// Keeps the first failure and the first remark, with unverified runs before others.
  void note(std::int64_t row, const EnsembleResult& end) {
    const Trajectory& run = end.trajectory;
    if ((run.is_open && open_++ == 0) || (remark_.empty() && !run.remark.empty()))
      remark_ = fmt::format("row {}: {}", row, run.remark);
    if (end.status.ok() || failed_++ > 0) return;
    first_ = row;
    sentence_ = end.status.text();
  }

  void add_lines(std::int64_t row, const std::string& rest, const EnsembleResult& end,
                 std::string& lines) const {
    if (!end.status.ok()) {
      const std::size_t empty =
          states_.size() + options_.columns.names.size() + 1 + (options_.events.empty() ? 0 : 1);
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

  const TypedOptions& typed_;
  std::string program_;
  int threads_;
  std::chrono::steady_clock::time_point deadline_ = deadline_after(typed_.limit);
  MakeProblem make_;
  std::shared_ptr<const UserProblem> base_;
  std::string missing_;  // reason why the initial state is incomplete
  std::vector<std::string> states_;
  RunOptions options_;
  std::vector<std::string> columns_;
  std::vector<double> first_row_;
  double farthest_;
  scene::Catalogue catalogue_;
  const ivp::MethodInfo& method_;
  std::int64_t failed_ = 0, first_ = 0, open_ = 0;
  std::string sentence_, remark_;
};

}  // namespace

int print_runs(const TypedOptions& typed, const std::string& program) {
  if (!typed.plot.empty())
    throw input_error("--plot {}: runs of --states are not drawn; leave one of them out", typed.plot);
  return CatalogueRun(typed, program).print();
}

}  // namespace nlmech::comparison
