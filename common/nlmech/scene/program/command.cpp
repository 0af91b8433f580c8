#include "nlmech/scene/program/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/time_limit.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace {

constexpr int failed = 1, wrong_usage = 2;
constexpr const char* limit_name = "--limit";

/// Seconds beyond the limit for commands that heed it by themselves.
constexpr double usual_grace = 0.5;

using Graces = std::map<const CLI::App*, double>;

/// Gives each subcommand its `--limit`. @returns how long to wait beyond it
Graces add_limits(CLI::App& app, const std::set<const CLI::App*>& unlimited, std::string& typed) {
  Graces graces;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    if (command->get_option_no_throw(limit_name) != nullptr) {
      graces[command] = usual_grace;
      continue;
    }
    CLI::Option* const option = command->add_option(limit_name, typed, "wall time at most, s");
    if (unlimited.contains(command))
      option->description("wall time at most, s; without it as long as it takes");
    else
      option->default_str(usual_limit);
    graces[command] = 0;
  }
  return graces;
}

/// What is given twice is most often given by mistake: nothing is ignored in silence.
void refuse_repetition(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    for (CLI::Option* option : command->get_options()) {
      if (option != command->get_help_ptr() && option->get_expected_max() <= 1)
        option->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    }
  }
}

/// Options without a text would be taken for options that are not there.
void refuse_empty(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const auto& texts = option->results();
    if (std::any_of(texts.begin(), texts.end(), [](const std::string& text) { return text.empty(); }))
      throw InputError(fmt::format("{}: an empty text", option->get_name()));
  }
}

TimeLimit::Command watched(const CLI::App& app, const CLI::App& command, const Graces& graces) {
  const CLI::Option* const limit = command.get_option(limit_name);
  const std::string text = limit->count() > 0 ? limit->results().back() : limit->get_default_str();
  TimeLimit::Command watched{app.get_name(), command.get_name(), {}, graces.at(&command)};
  if (!text.empty()) watched.seconds = typed_positive(limit_name, text);
  return watched;
}

/// As CLI11 says it, but short.
std::string unexpected(const std::vector<std::string>& arguments) {
  constexpr std::size_t most = 6;
  std::string words;
  for (std::size_t i = 0; i < std::min(most, arguments.size()); ++i) words += ' ' + echoed(arguments[i]);
  if (arguments.size() > most) words += fmt::format(" and {} more", arguments.size() - most);
  return fmt::format("The following argument{} not expected:{}\nRun with --help for more information.",
                     arguments.size() == 1 ? " was" : "s were", words);
}

/// Help and version go where results go, complaints to standard error.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream help, complaint;
  if (app.exit(error, help, complaint) == 0) {
    print_result(help.str());
    return 0;
  }
  const std::vector<std::string> extra = app.remaining(true);
  const bool few_words = dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || extra.empty();
  tell(few_words ? complaint.str() : unexpected(extra));
  return wrong_usage;
}

}  // namespace

int run_command(CLI::App& app, int argc, const char* const* argv, const int& code,
                const std::set<const CLI::App*>& unlimited) {
  std::string typed_limit;
  const Graces graces = add_limits(app, unlimited, typed_limit);
  refuse_repetition(app);
  std::optional<TimeLimit> limit;
  app.parse_complete_callback([&] {  // all is parsed, and no command has begun
    for (const CLI::App* command : app.get_subcommands()) {
      refuse_empty(*command);
      limit.emplace(watched(app, *command, graces));
    }
  });
  // Nobody speaks but who has found the error: the watch ends first.
  const auto end = [&](int exit_code, const std::exception& error) {
    limit.reset();
    tell(fmt::format("{}: {}", app.get_name(), error.what()));
    return exit_code;
  };
  try {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      limit.reset();
      return end_of_parsing(app, error);
    }
  } catch (const InputError& error) {
    return end(wrong_usage, error);
  } catch (const std::exception& error) {
    return end(failed, error);
  }
  return code;
}

}  // namespace nlmech::scene
