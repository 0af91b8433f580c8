#include "nlmech/comparison/commands/catalogue_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "nlmech/scene/catalogue/shard.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

/// Lines that are held in memory at a time.
constexpr double most_lines = 1e5;

class Runner {
 public:
  explicit Runner(const CatalogueRuns& runs)
      : runs_(runs),
        base_(runs.problem({})),
        request_(runs.request(*base_)),
        states_(base_->state_names()),
        parameters_(names_of(base_->parameters())),
        catalogue_(runs.file, {}, known(), [this](const auto& row) { return complaint(row); }) {
    const auto names = known();
    if (std::none_of(names.begin(), names.end(), [this](const auto& name) { return catalogue_.has(name); }))
      throw input_error("{}: none of its columns is an unknown or a parameter; there are {}",
                        catalogue_.name(), fmt::join(names, ", "));
  }

  [[nodiscard]] int print() {
    const double lines = request_.every ? std::abs(request_.t1 - request_.t0) / *request_.every + 2 : 2;
    scene::print_catalogue(
        catalogue_, {.shard = runs_.shard,
                     .options = runs_.typed,
                     .header = fmt::format("row,t,{}{}{},status", fmt::join(states_, ","),
                                           request_.events.empty() ? "" : ",event", catalogue_.rest_names()),
                     .portion = static_cast<std::size_t>(std::clamp(most_lines / lines, 1.0, 1024.0)),
                     .work = [this](const scene::CatalogueRows& rows) { return lines_of(rows); }});
    if (!remark_.empty()) scene::tell(fmt::format("{}: {}", runs_.program, remark_));
    if (failed_ == 0) return 0;
    scene::tell(fmt::format("{}: {} of the runs failed; the first is row {}: {}", runs_.program, failed_,
                            first_, sentence_));
    return 1;
  }

 private:
  /// What became of a row.
  struct Run {
    Status status;
    std::string remark;
  };

  static std::vector<std::string> names_of(const CatalogueRuns::Values& values) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.push_back(name);
    return names;
  }
  [[nodiscard]] std::vector<std::string> known() const {
    std::vector<std::string> all = states_;
    for (const std::string& name : parameters_) {
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
    }
    return all;
  }
  /// NaN stands where there is no column.
  [[nodiscard]] std::unique_ptr<OwnProblem> problem_of(const std::vector<double>& row) const {
    CatalogueRuns::Values values;
    const auto names = known();
    for (std::size_t i = states_.size(); i < names.size(); ++i) {
      if (!std::isnan(row[i])) values.emplace_back(names[i], row[i]);
    }
    return runs_.problem(values);
  }
  /// Called while the catalogue is made, too: only what is before it in this class is there.
  [[nodiscard]] std::string complaint(const std::vector<double>& row) const {
    try {
      (void)runs_.request(*problem_of(row));
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

  [[nodiscard]] std::string lines_of(const scene::CatalogueRows& rows) {
    std::vector<Run> runs(rows.numbers.size());
    std::string text =
        scene::lines_in_threads(rows.numbers.size(), runs_.threads, [&](std::size_t i, std::string& lines) {
          add_run(rows.first + static_cast<std::int64_t>(i), rows.numbers[i], rows.rest[i], runs[i], lines);
        });
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::int64_t row = rows.first + static_cast<std::int64_t>(i);
      if (remark_.empty() && !runs[i].remark.empty())
        remark_ = fmt::format("row {}: {}", row, runs[i].remark);
      if (runs[i].status.ok() || failed_++ > 0) continue;
      first_ = row;
      sentence_ = runs[i].status.text();
    }
    return text;
  }

  void add_run(std::int64_t row, const std::vector<double>& numbers, const std::string& rest, Run& run,
               std::string& lines) const {
    try {
      const auto problem = problem_of(numbers);
      Request request = runs_.request(*problem);
      request.limits.seconds =
          std::min(request.limits.seconds, std::max(0.0, runs_.seconds - watch_.seconds()));
      for (std::size_t k = 0; k < states_.size(); ++k) {
        if (!std::isnan(numbers[k])) request.x0[k] = numbers[k];
      }
      Trajectory found = problem->trajectory(request, runs_.method);
      run.remark = std::move(found.remark);
      std::string_view text = found.rows;
      text.remove_prefix(text.find('\n') + 1);  // its header
      const std::string head = fmt::format("{},", row), tail = fmt::format("{},success\n", rest);
      while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.append(head).append(text.substr(0, end)).append(tail);
        text.remove_prefix(end + 1);
      }
    } catch (const Failure& failure) {
      run.status =
          failure.status().ok() ? Status::failure(Outcome::not_converged, failure.what()) : failure.status();
      const std::size_t empty = states_.size() + 1 + (request_.events.empty() ? 0 : 1);
      lines +=
          fmt::format("{}{}{},{}\n", row, std::string(empty, ','), rest, to_string(run.status.outcome()));
    }
  }

  const CatalogueRuns& runs_;
  Stopwatch watch_;
  std::unique_ptr<OwnProblem> base_;
  Request request_;
  std::vector<std::string> states_, parameters_;
  scene::Catalogue catalogue_;
  std::int64_t failed_ = 0, first_ = 0;
  std::string sentence_, remark_;
};

}  // namespace

int print_runs(const CatalogueRuns& runs) { return Runner(runs).print(); }

}  // namespace nlmech::comparison
