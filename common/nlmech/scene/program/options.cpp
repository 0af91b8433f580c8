#include "nlmech/scene/program/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

/// Visitor of all kinds of destination.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

constexpr int most_whole = 1'000'000'000;

}  // namespace

Option::Option(std::string name, Destination to, std::string help)
    : name_(std::move(name)), help_(std::move(help)), to_(to) {}

Option& Option::required() {
  required_ = true;
  return *this;
}

Option& Option::positive() {
  positive_ = true;
  return *this;
}

Option& Option::range(double least, double most) {
  range_ = {least, most};
  return *this;
}

Option& Option::one_of(std::vector<std::string> texts) {
  texts_ = std::move(texts);
  return *this;
}

void Option::check(double value, const std::string& text) const {
  if (positive_ && !(value > 0)) throw input_error("{} {}: must be positive", name_, quoted_input(text));
  if (range_ && !(value >= range_->first && value <= range_->second))
    throw input_error("{} {}: must be from {:g} to {:g}", name_, quoted_input(text), range_->first,
                      range_->second);
}

void Option::check_text(const std::string& text) const {
  if (!texts_.empty() && std::ranges::find(texts_, text) == texts_.end())
    throw input_error("{} {}: must be one of {}", name_, quoted_input(text), fmt::join(texts_, ", "));
}

double Option::number(const std::string& text) const {
  const double value = typed_number(name_, text);
  check(value, text);
  return value;
}

int Option::whole(const std::string& text) const {
  const auto [least, most] = range_.value_or(std::pair<double, double>(-most_whole, most_whole));
  return typed_whole(name_, text, static_cast<int>(least), static_cast<int>(most));
}

void Option::understand(const std::vector<std::string>& typed) const {
  const std::string& text = typed.front();
  const auto numbers = [&] {
    std::vector<double> all = typed_numbers(name_, text);
    for (const double value : all) check(value, text);
    return all;
  };
  std::visit(
      Overloaded{[&](bool* to) { *to = text == "true"; },
                 [&](std::string* to) {
                   check_text(text);
                   *to = text;
                 },
                 [&](std::vector<std::string>* to) { *to = typed; }, [&](double* to) { *to = number(text); },
                 [&](std::optional<double>* to) { *to = number(text); }, [&](int* to) { *to = whole(text); },
                 [&](std::optional<int>* to) { *to = whole(text); },
                 [&](std::vector<double>* to) { *to = numbers(); },
                 [&](const std::span<double>& to) {
                   const std::vector<double> all = numbers();
                   if (all.size() != to.size())
                     throw input_error("{} {}: {} numbers; {} are needed", name_, quoted_input(text),
                                       all.size(), to.size());
                   std::ranges::copy(all, to.begin());
                 }},
      to_);
}

bool Option::is_flag() const { return std::holds_alternative<bool*>(to_); }

bool Option::takes_several() const { return std::holds_alternative<std::vector<std::string>*>(to_); }

std::string_view Option::kind() const {
  return std::visit(
      Overloaded{[](bool*) { return ""; }, [](std::string*) { return "TEXT"; },
                 [](std::vector<std::string>*) { return "TEXT"; }, [](int*) { return "INTEGER"; },
                 [](std::optional<int>*) { return "INTEGER"; }, [](double*) { return "NUMBER"; },
                 [](std::optional<double>*) { return "NUMBER"; }, [](const auto&) { return "NUMBERS"; }},
      to_);
}

std::string Option::help() const {
  if (!texts_.empty()) return fmt::format("{}: {}", help_, fmt::join(texts_, ", "));
  if (range_) return fmt::format("{}; from {:g} to {:g}", help_, range_->first, range_->second);
  return positive_ ? help_ + "; positive" : help_;
}

std::string Option::default_text() const {
  if (required_) return {};
  return std::visit(
      Overloaded{[](std::string* to) { return *to; }, [](double* to) { return fmt::format("{}", *to); },
                 [](int* to) { return fmt::format("{}", *to); },
                 [](std::vector<double>* to) { return fmt::format("{}", fmt::join(*to, ",")); },
                 [](const auto&) { return std::string(); }},
      to_);
}

Option& Options::add(const std::string& name, Option::Destination to, const std::string& help) {
  return all_.emplace_back(name, to, help);
}

void Options::limit(double& seconds) {
  supports_limit_ = true;
  add("--limit", seconds, "stop after this much wall time, s").positive();
}

void Options::limit(std::optional<double>& seconds, const std::string& lifted_by) {
  supports_limit_ = true;
  lifted_by_ = lifted_by;
  add("--limit", seconds,
      lifted_by.empty() ? fmt::format("stop after this much wall time, s (default {})", default_limit)
                        : fmt::format("stop after this much wall time, s (default {}; none with {})",
                                      default_limit, lifted_by))
      .positive();
}

Options& Commands::add(const std::string& name, const std::string& help, std::function<Answer()> work) {
  return all_.emplace_back(Command{name, help, std::move(work), {}}).options;
}

}  // namespace nlmech::scene
