/// @file
/// A trajectory as rows of CSV.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/comparison/reference/verification.hpp"

namespace nlmech::comparison {

/// A text as a cell of CSV, in quotes.
[[nodiscard]] std::string quoted_cell(std::string_view text);

/// Collects the rows of a run: the first, those at equal distances, the last. Numbers with 17 digits. Keeps
/// the states of some of them, at most most_verified at equal distances and the last, for their verification.
class Rows {
 public:
  /// With the header `t,name,...`.
  Rows(const Request& request, const std::vector<std::string>& names);

  /// A row.
  template <class State>
  void add(double t, const State& x) {
    add(t, x.data(), static_cast<std::size_t>(x.size()));
  }
  /// A row of an event. @param what its text
  template <class State>
  void add_event(double t, const State& x, const std::string& what) {
    print(t, x.data(), static_cast<std::size_t>(x.size()), what);
  }

  /// The last state of a run that has its row already.
  template <class State>
  void keep(double t, const State& x) {
    keep(t, x.data(), static_cast<std::size_t>(x.size()));
  }

  /// The asked times within a step and before @p end, by its dense output.
  void add_before(double end, const ivp::Step& step) {
    if (!request_.every) return;
    for (double t = next(); is_inner(t) && !is_after(t, end); t = next()) {
      add(t, step.at(t));
      ++count_;
    }
  }
  /// All of it.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The rows kept, and times between where these are few. The last row must be there.
  [[nodiscard]] Verified verified(const Tolerance& tolerance) const;

 private:
  /// A row that is kept.
  struct Kept {
    double t;
    Eigen::VectorXd x;
  };
  void add(double t, const double* x, std::size_t size);
  void keep(double t, const double* x, std::size_t size);
  void print(double t, const double* x, std::size_t size, const std::string& event);
  [[nodiscard]] double next() const {
    return request_.t0 +
           std::copysign(static_cast<double>(count_) * *request_.every, request_.t1 - request_.t0);
  }
  [[nodiscard]] bool is_after(double a, double b) const { return request_.t1 > request_.t0 ? a > b : a < b; }
  // The end has its own row; rounding of k DT makes no second one.
  [[nodiscard]] bool is_inner(double t) const {
    return is_after(request_.t1, t) && std::abs(request_.t1 - t) > 1e-9 * *request_.every;
  }

  const Request& request_;
  std::string text_;
  std::int64_t count_ = 1, stride_ = 1, added_ = 0;
  std::vector<Kept> kept_;  // and always the latest row, in its last place
};

}  // namespace nlmech::comparison
