#include "nlmech/comparison/commands/choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// The number that is written with few digits, as the user would: 1e-5, and not 1e-3/100.
double as_typed(double value) { return std::stod(fmt::format("{:.12g}", value)); }

/// A method with those of the settings that it has. Of a step and tolerances, those that choose their steps
/// take the tolerances.
Choice choice(const std::string& name, ivp::Settings settings) {
  if (settings.step && (settings.tolerance || settings.absolute_tolerance)) {
    if (any_method(name).fixed_step())
      settings.tolerance.reset();
    else
      settings.step.reset();
  }
  Choice one{any_method(name), settings};
  if (one.method.fixed_step()) one.settings.absolute_tolerance.reset();
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    if (!one.method.has(*setting)) setting->reset(one.settings);
  }
  return one;
}

/// Every setting counts for some method.
void check(const std::vector<Choice>& all, const ivp::Settings& settings,
           const std::vector<std::string>& methods) {
  const auto some = [&all](auto has) { return std::any_of(all.begin(), all.end(), has); };
  const std::string names = fmt::format("{}", fmt::join(methods, ","));
  if (settings.step && !some([](const Choice& c) { return c.settings.step; }))
    throw input_error("--step {}: the methods {} choose their steps; give a tolerance alone", *settings.step,
                      names);
  if (settings.tolerance && !some([](const Choice& c) { return c.settings.tolerance; }))
    throw input_error("--tolerance {}: none of the methods {} chooses its steps; give --step alone",
                      *settings.tolerance, names);
  if (settings.absolute_tolerance && !some([](const Choice& c) { return c.settings.absolute_tolerance; }))
    throw input_error("--absolute-tolerance {}: none of the methods {} chooses its steps",
                      *settings.absolute_tolerance, names);
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    const std::optional<double> value = setting->value(settings);
    if (value && !some([setting](const Choice& c) { return c.method.has(*setting); }))
      throw input_error("--{} {}: none of the methods {} has {} to choose", setting->name, *value, names,
                        setting->name);
  }
}

}  // namespace

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}

WantedEvent event_of(const std::string& option, const std::string& typed, const OwnProblem& problem) {
  WantedEvent event;
  std::string text = trimmed(typed);
  const auto ends_with = [&text](std::string_view word) {
    if (text.size() <= word.size() || !text.ends_with(word) || text[text.size() - word.size() - 1] != ' ')
      return false;
    text = trimmed(text.substr(0, text.size() - word.size()));
    return true;
  };
  event.ends = ends_with("end");
  if (ends_with("rising")) event.crossing = ivp::Crossing::rising;
  if (ends_with("falling")) event.crossing = ivp::Crossing::falling;
  event.text = text;
  event.value = problem.expression(option, text);
  return event;
}

std::vector<std::string> method_list(const std::string& list) {
  if (trimmed(list) == "all") return built_method_names();
  std::vector<std::string> names;
  for (const std::string& piece : scene::split(list, ',')) {
    const std::string name = trimmed(piece);
    about("--methods", [&] { return any_method(name); });
    if (std::ranges::find(names, name) != names.end())
      throw input_error("--methods: {} is given twice", name);
    names.push_back(name);
  }
  return names;
}

std::vector<double> tolerance_list(const std::string& list) {
  constexpr const char* option = "--tolerances";
  const auto colon = list.find(':');
  std::vector<double> all;
  if (colon == std::string::npos) {
    for (const std::string& piece : scene::typed_words(option, list))
      all.push_back(scene::typed_positive(option, piece));
    return all;
  }
  if (colon == 0 || colon + 1 == list.size() || list.find(':', colon + 1) != std::string::npos)
    throw input_error("{} {}: a sweep is from a tolerance to a tighter one, as 1e-3:1e-12", option,
                      echoed(list));
  const double from = scene::typed_positive(option, list.substr(0, colon));
  const double to = scene::typed_positive(option, list.substr(colon + 1));
  if (from < to)
    throw input_error("{} {}: goes from the coarse one to the tight one, as 1e-3:1e-12", option,
                      echoed(list));
  if (!(from < to * 1e30)) throw input_error("{} {}: more than thirty decades", option, echoed(list));
  for (double next = from; next > to * 0.99; next = as_typed(next / 10)) all.push_back(next);
  return all;
}

std::vector<Choice> choices(const std::vector<std::string>& methods, const ivp::Settings& settings,
                            const std::vector<double>& tolerances) {
  std::vector<Choice> all;
  for (const std::string& name : methods) {
    if (tolerances.empty() || any_method(name).fixed_step()) {
      all.push_back(choice(name, settings));
      continue;
    }
    for (const double tolerance : tolerances) {
      ivp::Settings these = settings;
      these.tolerance = tolerance;
      all.push_back(choice(name, these));
    }
  }
  if (!tolerances.empty() &&
      std::ranges::none_of(all, [](const Choice& c) { return c.settings.tolerance.has_value(); }))
    throw input_error("--tolerances: none of the methods {} chooses its steps; give --step alone",
                      fmt::join(methods, ","));
  check(all, settings, methods);
  return all;
}

}  // namespace nlmech::comparison
