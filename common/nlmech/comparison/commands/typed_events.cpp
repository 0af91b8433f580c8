#include "nlmech/comparison/commands/typed_events.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

/// Removes a word from the end of a text; false if the text does not end with it.
bool take_last(std::string& text, std::string_view word) {
  if (text.size() <= word.size() || !text.ends_with(word) || text[text.size() - word.size() - 1] != ' ')
    return false;
  text = scene::trimmed(text.substr(0, text.size() - word.size()));
  return true;
}

/// Removes "name:" from the start of a text and returns the name; empty if there is none.
std::string take_name(std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find('=') < colon) return "";
  std::string name = scene::trimmed(text.substr(0, colon));
  text = scene::trimmed(text.substr(colon + 1));
  return name;
}

/// Removes "end" or "end after 3" from the end of a text and returns the count of events after which the run
/// ends; 0 if events do not end it.
int take_end(const std::string& option, std::string& text) {
  if (take_last(text, "end")) return 1;
  const std::size_t after = text.rfind(" end after ");
  if (after == std::string::npos) return 0;
  const std::string typed = scene::trimmed(text.substr(after + 11));
  double count = 0;
  if (!scene::parse_number(typed, count) || count != std::floor(count) || count < 1 || count > 1e9)
    throw input_error("{} {}: end after {}: must be a whole number of events, from 1 to 1e9", option,
                      quoted_input(text), quoted_input(typed));
  text = scene::trimmed(text.substr(0, after));
  return static_cast<int>(count);
}

/// Times of "t = 0:24:240" (first, distance, last); empty for any other text.
std::vector<double> times_of(const std::string& option, const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || text.find(':') == std::string::npos ||
      scene::trimmed(text.substr(0, sign)) != "t")
    return {};
  const auto refuse = [&](std::string_view why) {
    return input_error("{} {}: {}", option, quoted_input(text), why);
  };
  std::array<double, 3> range{};  // first, distance, last
  std::string rest = text.substr(sign + 1) + ":";
  for (double& number : range) {
    const std::size_t colon = rest.find(':');
    if (colon == std::string::npos || !scene::parse_number(scene::trimmed(rest.substr(0, colon)), number))
      throw refuse("give the first time, the interval and the last time, as t = 0:24:240");
    rest.erase(0, colon + 1);
  }
  constexpr double most = 10'000;
  const auto [first, distance, last] = range;
  if (!rest.empty() || !(distance > 0) || !(last >= first) || !std::isfinite(last - first))
    throw refuse(
        "give the first time, a positive interval and a last time that is not earlier, as t = 0:24:240");
  if ((last - first) / distance > most) throw refuse("more than 10000 times; give a longer interval");
  std::vector<double> times;
  // The margin keeps the last time despite rounding.
  for (int k = 0; first + k * distance <= last + 1e-9 * distance; ++k) times.push_back(first + k * distance);
  return times;
}

/// Rewrites "x -> 1, y -> atan2(x, y)" as "x = 1; y = atan2(x, y)".
std::string assignments_of(std::string text) {
  int depth = 0;
  for (char& c : text) {
    depth += (c == '(') - (c == ')');
    if (c == ',' && depth == 0) c = ';';
  }
  for (std::size_t arrow = text.find("->"); arrow != std::string::npos; arrow = text.find("->"))
    text.replace(arrow, 2, "=");
  return text;
}

}  // namespace

std::vector<WantedEvent> events_of(const std::string& option, const std::string& typed,
                                   const UserProblem& problem) {
  std::string text = scene::trimmed(typed);
  const std::string name = take_name(text);
  ivp::Event event;
  event.ends = take_end(option, text);
  const std::string all = text;
  if (take_last(text, "rising"))
    event.crossing = ivp::Crossing::rising;
  else if (take_last(text, "falling"))
    event.crossing = ivp::Crossing::falling;
  std::vector<WantedEvent> events;
  const auto add = [&](const std::string& equation) {
    ivp::Event one = problem.event(option, equation);
    one.crossing = event.crossing;
    one.ends = event.ends;
    one.must_leave = true;
    events.push_back({name.empty() ? all : name, std::move(one), equation});
  };
  const std::vector<double> times = times_of(option, text);
  if (times.empty()) add(text);
  if (!times.empty() && event.ends > 1)
    throw input_error(
        "{} {}: each time occurs once, so that the count must be 1; give --until for a later end", option,
        quoted_input(typed));
  for (const double t : times) {
    add(fmt::format("t = {:.17g}", t));
    events.back().at = t;
  }
  return events;
}

void add_change(const std::string& option, const std::string& typed, const UserProblem& problem,
                std::vector<WantedEvent>& events) {
  const auto refuse = [&](std::string_view why) {
    return input_error("{} {}: {}", option, quoted_input(typed), why);
  };
  std::string text = scene::trimmed(typed);
  const std::string name = take_name(text);
  if (name.empty()) throw refuse("give the name of an event and what it changes: \"bounce: y' = -0.8 y'\"");
  std::vector<std::pair<Eigen::Index, StateFunction>> values;
  std::vector<std::pair<int, std::string>> texts;
  while (!text.empty()) {
    const std::string one = scene::trimmed(text.substr(0, text.find(';')));
    text.erase(0, text.find(';') == std::string::npos ? text.size() : text.find(';') + 1);
    if (one.empty()) continue;
    const std::size_t sign = one.find('=');
    const std::string component = scene::trimmed(one.substr(0, sign));
    const std::vector<std::string> names = problem.text.component_names();
    const auto known = std::ranges::find(names, component);
    if (sign == std::string::npos || known == names.end())
      throw refuse(
          fmt::format("{}: must be one of {} = its new value", quoted_input(one), fmt::join(names, ", ")));
    const Eigen::Index i = problem.text.layout().place(static_cast<int>(known - names.begin()));
    if (std::ranges::find(values, i, &std::pair<Eigen::Index, StateFunction>::first) != values.end())
      throw refuse(fmt::format("{} has two values; give one", component));
    values.emplace_back(i, problem.expression(option, one.substr(sign + 1)));
    texts.emplace_back(static_cast<int>(i), one.substr(sign + 1));
  }
  if (values.empty()) throw refuse("give what the event changes: \"bounce: y' = -0.8 y'\"");
  bool found = false;
  for (WantedEvent& event : events) {
    if (event.name != name) continue;
    found = true;
    for (const auto& [i, value] : values) {
      const bool is_new = event.changed.insert(i).second;
      if (!is_new)
        throw refuse(fmt::format("another change of {} gives {} a value; leave one of them out",
                                 quoted_input(name), problem.state_names[static_cast<std::size_t>(i)]));
    }
    if (problem.text.layout().columns > 0) {
      if (event.event.change)
        throw refuse("with --sensitivities an event has one list of changes; join them by ;");
      event.event.change = [change = problem.text.change_at(option, event.equation, texts)](double t,
                                                                                            ivp::State& x) {
        const ivp::State old = x;
        change.run(t, old, 0, change.outputs(), [&x](int i, double value) { x[i] = value; });
      };
      continue;
    }
    event.event.change = [values, before = std::move(event.event.change)](double t, ivp::State& x) {
      if (before) before(t, x);
      const ivp::State old = x;
      for (const auto& [i, value] : values) x[i] = value(t, old);
    };
  }
  if (!found) throw refuse(fmt::format("no --event has the name {}; name one of them", quoted_input(name)));
}

void add_line(const EventLine& line, const UserProblem& problem, std::vector<WantedEvent>& events) {
  std::vector<WantedEvent> own = events_of("when", line.event, problem);
  if (!line.changes.empty()) {
    for (WantedEvent& e : own) e.name = "its event";
    add_change("when", "its event: " + line.changes, problem, own);
    for (WantedEvent& e : own) e.name = line.event;
  }
  std::ranges::move(own, std::back_inserter(events));
}

std::vector<EventLine> take_event_lines(std::string& text) {
  std::vector<EventLine> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(";\n", begin), text.size());
    std::string line = scene::trimmed(text.substr(begin, end - begin));
    const bool is_at = line.starts_with("at "), is_when = line.starts_with("when ");
    if (is_at || is_when) {
      line = scene::trimmed(line.substr(0, line.find('#')));
      const std::size_t arrow = line.find("->"),
                        colon = arrow == std::string::npos ? arrow : line.rfind(':', arrow);
      const std::size_t word = is_at ? 3 : 5;
      lines.push_back({scene::trimmed(line.substr(word, colon == std::string::npos ? colon : colon - word)),
                       colon == std::string::npos ? "" : assignments_of(line.substr(colon + 1))});
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin),
                text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    }
    begin = end + 1;
  }
  return lines;
}

}  // namespace nlmech::comparison
