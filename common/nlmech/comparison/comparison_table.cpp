#include "nlmech/comparison/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "nlmech/comparison/judgement.hpp"
#include "nlmech/comparison/reference/reference_end.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {
ComparisonTable::ComparisonTable(std::string_view program, const Reference& truth, const Eigen::VectorXd& x0)
    : program_(program), truth_(truth), size_(x0.cwiseAbs()) {
  if (truth.status.ok()) {
    size_ = size_.cwiseMax(truth.size);
    scene::tell(fmt::format("{}: reference: {}", program_, truth.text()));
  } else {
    scene::tell(fmt::format("{}: no digits, because there is no reference: {}", program_, truth.text()));
  }
}

void ComparisonTable::say(const Choice& choice, std::string_view sentence) const {
  // Most sentences begin with the method.
  const bool named = sentence.find(fmt::format("{}:", choice.method.name)) != std::string_view::npos;
  scene::tell(
      fmt::format("{}: {}{}", program_, named ? "" : fmt::format("{}: ", choice.method.name), sentence));
}

double ComparisonTable::error_of(const Eigen::VectorXd& x) const {
  const Eigen::VectorX<long double> end = truth_.states.col(truth_.states.cols() - 1);
  return relative_error(x, end, size_);
}

// What a tolerance did not hold; empty where it did, and where nothing was held to one.
std::string ComparisonTable::note(const Choice& choice, const Eigen::VectorXd& x) const {
  if (choice.settings.step) return "";
  const Tolerance tolerance = tolerance_of(choice.settings);
  double most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index last = truth_.states.cols() - 1;
    const double exact = static_cast<double>(truth_.states(i, last));
    const double surely = std::abs(x[i] - exact) - truth_.doubt(i, last);
    most = std::max(most, surely / (tolerance.absolute + tolerance.relative * std::abs(exact)));
  }
  if (most <= most_tolerances) return "";
  return quoted_cell(fmt::format("off by {:.3g} tolerances, since one {}", most, what_a_tolerance_holds));
}

void ComparisonTable::add(const Choice& choice, const Status& status, const Statistics& statistics,
                          const Eigen::VectorXd& x, const Timing& time) {
  some_ = true;
  std::string digits, note;
  std::optional<double> error;
  if (!status.ok()) {
    say(choice, status.text());
    note = quoted_cell(status.sentence());
  } else if (truth_.status.ok()) {
    error = std::max(error_of(x), truth_.uncertainty());
    digits = fmt::format("{:.3f}", digits_of(*error));
    note = this->note(choice, x);
  }
  text_ += fmt::format("{},{},{},{},{:.4g},{},{}\n", choice.method.name, choice.setting(),
                       to_string(status.outcome()), digits, time.median, statistics.right_hand_sides, note);
  if (curves_.empty() || curves_.back().name != choice.method.name)
    curves_.push_back({std::string(choice.method.name), kind_of(choice.method), {}});
  curves_.back().costs.push_back(
      {choice.setting(), std::string(to_string(status.outcome())), error, statistics, time});
}

void ComparisonTable::add_unsuitable(const Choice& choice, const std::string& why) {
  unsuitable_ += (unsuitable_.empty() ? "" : "; ") + why;
  say(choice, why);
  text_ += fmt::format("{},{},unsuitable,,,,{}\n", choice.method.name, choice.setting(), quoted_cell(why));
}

Comparison ComparisonTable::take() {
  if (!some_) throw InputError("--methods: none of them is for this: " + unsuitable_);
  return {std::move(text_), std::move(curves_)};
}

}  // namespace nlmech::comparison
