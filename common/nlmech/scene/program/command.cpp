#include "nlmech/scene/program/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <list>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/time_limit.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

constexpr const char* limit_name = "--limit";

/// Seconds beyond the limit for commands that heed it themselves.
constexpr double default_grace = 0.5;

/// A command in the parser and the typed texts of its options.
struct Parsed {
  const Commands::Command* command;
  CLI::App* app;
  struct Typed {
    const Option* option;
    CLI::Option* parsed;
    std::vector<std::string> texts;
    bool is_given = false;  ///< was the flag given?
  };
  std::list<Typed> typed;  // the parser keeps pointers to its elements
  std::string limit_text;

  Parsed(CLI::App& program, const Commands::Command& declared)
      : command(&declared), app(program.add_subcommand(declared.name, declared.help)) {
    app->footer(declared.options.footer());
    for (const Option& option : declared.options.all()) add(option);
    if (!declared.options.supports_limit()) add_limit();
  }
  void add(const Option& option);
  void add_limit();
  /// Stores the values of all options. @throws InputError
  void understand() const;
  [[nodiscard]] TimeLimit::Command watched(const std::string& program) const;
};

void Parsed::add(const Option& option) {
  Typed& t = typed.emplace_back(Typed{&option, nullptr, {}});
  if (option.is_flag()) {
    t.parsed = app->add_flag(option.name(), t.is_given, option.help());
  } else {
    t.parsed = app->add_option(option.name(), t.texts, option.help());
    t.parsed->default_str(option.default_text());
    t.parsed->type_name(std::string(option.kind()));
    if (!option.takes_several()) t.parsed->expected(1)->allow_extra_args(false);
  }
  // An option given twice is usually a mistake, and neither value is ignored silently.
  if (!option.takes_several()) t.parsed->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  t.parsed->required(option.is_required());
}

void Parsed::add_limit() {
  const bool unlimited = command->options.is_unlimited();
  const std::string help =
      unlimited ? "stop after this much wall time, s (default none)" : "stop after this much wall time, s";
  CLI::Option* const limit = app->add_option(limit_name, limit_text, help);
  limit->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  limit->type_name("NUMBER");
  if (!unlimited) limit->default_str(fmt::format("{}", Options::default_limit));
}

void Parsed::understand() const {
  // An empty text would count as an option that is not given.
  for (const CLI::Option* option : app->get_options()) {
    if (std::ranges::any_of(option->results(), &std::string::empty))
      throw input_error("{}: an empty text", option->get_name());
  }
  for (const Typed& t : typed) {
    if (t.parsed->count() == 0) continue;
    t.option->understand(t.option->is_flag() ? std::vector<std::string>{t.is_given ? "true" : "false"}
                                             : t.texts);
  }
}

TimeLimit::Command Parsed::watched(const std::string& program) const {
  const CLI::Option* const limit = app->get_option(limit_name);
  const std::string& lifted_by = command->options.lifted_by();
  std::string text = limit->count() > 0 ? limit->results().back() : limit->get_default_str();
  const bool lifted =
      command->options.is_unlimited() || (!lifted_by.empty() && app->get_option(lifted_by)->count() > 0);
  if (text.empty() && !lifted) text = fmt::format("{}", Options::default_limit);
  TimeLimit::Command watched{
      program, command->name, {}, command->options.supports_limit() ? default_grace : 0};
  if (!text.empty()) watched.seconds = typed_positive(limit_name, text);
  return watched;
}

/// Is the argument an equation without `--equation`, of a command that takes one and has none?
bool is_equation(const CLI::App& app, const std::string& argument) {
  return argument.find('\'') < argument.find('=') &&
         std::ranges::any_of(app.get_subcommands(), [](const CLI::App* command) {
           const CLI::Option* const equation = command->get_option_no_throw("--equation");
           return equation != nullptr && equation->count() == 0;
         });
}

/// Message of unexpected arguments as of CLI11, but short and with a suggestion.
std::string unexpected(const CLI::App& app, const std::vector<std::string>& arguments) {
  constexpr std::size_t most = 6;
  std::string words;
  for (std::size_t i = 0; i < std::min(most, arguments.size()); ++i)
    words += ' ' + quoted_input(arguments[i]);
  if (arguments.size() > most) words += fmt::format(" and {} more", arguments.size() - most);
  const bool equation =
      std::ranges::any_of(arguments, [&app](const std::string& a) { return is_equation(app, a); });
  return fmt::format("The following argument{} not expected:{}\n{}Run with --help for more information.",
                     arguments.size() == 1 ? " was" : "s were", words,
                     equation ? "An equation follows --equation.\n" : "");
}

/// Prints help and version to standard output and errors to standard error; returns the exit code.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream help, complaint;
  if (app.exit(error, help, complaint) == 0) {
    print_result(help.str());
    return 0;
  }
  const std::vector<std::string> extra = app.remaining(true);
  const bool few_words = dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || extra.empty();
  print_message(few_words ? complaint.str() : unexpected(app, extra));
  return ExitCode::wrong_usage;
}

/// Parses the options of the named command, starts its time limit and runs it.
int run(CLI::App& app, const std::list<Parsed>& all, int argc, const char* const* argv,
        std::optional<TimeLimit>& limit) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return end_of_parsing(app, error);
  }
  const auto chosen = std::ranges::find_if(all, [](const Parsed& p) { return p.app->parsed(); });
  const TimeLimit::Command watched = chosen->watched(app.get_name());
  chosen->understand();
  (void)best_instruction_set();  // refuses a wrong NLMECH_INSTRUCTION_SET also for commands without kernels
  limit.emplace(watched);
  const Answer answer = chosen->command->work();
  if (const auto* const result = std::get_if<std::string>(&answer)) print_last_result(*result);
  return std::holds_alternative<int>(answer) ? std::get<int>(answer) : 0;
}

}  // namespace

int run_command(const Commands& commands, const std::string& title, int argc, const char* const* argv) {
  CLI::App app(title, commands.program());
  app.set_version_flag("--version", "nlmech " + build_info().version);
  // Both print to standard output with a final line break and end with exit code 0, as the version does.
  const auto prints = [&app](const char* name, const char* help, const std::function<std::string()>& text) {
    app.add_flag_callback(
        name,
        [text] {
          std::string lines = text();
          lines.pop_back();
          throw CLI::CallForVersion(lines, 0);
        },
        help);
  };
  prints("--completion", "Print the completions for bash and exit",
         [&] { return bash_completion(commands); });
  prints("--manual", "Print the manual page and exit",
         [&] { return manual_page(commands, title, build_info().version); });
  app.require_subcommand(1);
  std::list<Parsed> all;
  for (const Commands::Command& command : commands.all()) all.emplace_back(app, command);
  std::optional<TimeLimit> limit;
  // The time limit ends first, so that it prints no second message.
  const auto end = [&](int exit_code, std::string_view sentence) {
    limit.reset();
    print_message(fmt::format("{}: {}", app.get_name(), sentence));
    return exit_code;
  };
  try {
    return run(app, all, argc, argv, limit);
  } catch (const InputError& error) {
    return end(ExitCode::wrong_usage, error.what());
  } catch (const std::bad_alloc&) {
    return end(ExitCode::failed, "not enough memory; ask for less at a time, as fewer rows (--every)");
  } catch (const std::exception& error) {
    return end(ExitCode::failed, error.what());
  }
}

}  // namespace nlmech::scene
