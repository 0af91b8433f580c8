#include "nlmech/scene/program/command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <vector>

namespace nlmech::scene {
namespace {

constexpr const char* limit_option = "--limit";

/// Escapes a text for roff: no escapes, no requests, and hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string safe;
  bool begins = true;  // start of a line, where a dot or an apostrophe would be a request
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
    begins = c == '\n';
  }
  return safe;
}

bool is_word(const Option& option) { return !option.name().starts_with('-'); }

/// "run [scenes...]"
std::string usage(const Commands::Command& command) {
  std::string text = command.name;
  for (const Option& option : command.options.all()) {
    if (!is_word(option)) continue;
    const std::string word = option.name() + (option.takes_several() ? "..." : "");
    text += option.is_required() ? " " + word : " [" + word + "]";
  }
  return text;
}

std::string described(const Option& option) {
  std::string head = fmt::format("\\fB{}\\fR", roff(option.name()));
  if (!option.is_flag() && !is_word(option)) head += fmt::format(" \\fI{}\\fR", option.kind());
  std::string text = fmt::format(".TP\n{}\n{}", head, roff(option.help()));
  if (option.is_required()) text += "; required";
  const std::string value = option.default_text();
  if (!value.empty()) text += " (default " + roff(value) + ")";
  return text + "\n";
}

std::string described(const Commands::Command& command) {
  std::string text = fmt::format(".SS {}\n{}\n", roff(usage(command)), roff(command.help));
  for (const Option& option : command.options.all()) text += described(option);
  if (!command.options.supports_limit()) {
    text += fmt::format(".TP\n\\fB{}\\fR \\fINUMBER\\fR\nstop after this much wall time, s (default {})\n",
                        roff(limit_option), command.options.is_unlimited() ? "none" : "60");
  }
  if (!command.options.footer().empty())
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.options.footer()));
  return text;
}

/// A text in single quotes of the shell.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

/// The bash branch of a command: its options, and the values of options with a list.
std::string branch(const Commands::Command& command) {
  std::vector<std::string> names = {"--help"};
  std::string values;
  bool scenes = false;
  for (const Option& option : command.options.all()) {
    if (is_word(option)) {
      scenes = scenes || option.name() == "scenes";
      continue;
    }
    names.push_back(option.name());
    if (!option.texts().empty())
      values += fmt::format("        {}) words={} ;;\n", option.name(),
                            quoted(fmt::format("{}", fmt::join(option.texts(), " "))));
  }
  if (!command.options.supports_limit()) names.emplace_back(limit_option);
  std::string words = quoted(fmt::format("{}", fmt::join(names, " ")));
  // In a pipe `list` prints a Markdown table.
  if (scenes)
    words += R"sh(" $("$1" list 2>/dev/null | sed -n '/^| :/,$ s/^| \([a-z0-9][^ ]*\) .*/\1/p')")sh";
  return fmt::format("    {})\n      case $3 in\n{}        *) words={} ;;\n      esac\n      ;;\n",
                     command.name, values, words);
}

}  // namespace

std::string manual_page(const Commands& commands, const std::string& title, const std::string& version) {
  std::string upper = commands.program();
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  std::string page = fmt::format(
      ".TH {} 1 \"\" \"nlmech {}\" \"nlmech\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n\\fB{}\\fR \\fIcommand\\fR "
      "[\\fIoptions\\fR]\n.SH COMMANDS\n",
      roff(upper), roff(version), roff(commands.program()), roff(title), roff(commands.program()));
  for (const Commands::Command& command : commands.all()) page += described(command);
  return page +
         ".SH EXIT STATUS\n.TP\n0\nsuccess\n.TP\n1\na check or a computation failed\n.TP\n2\nwrong usage or "
         "input\n.SH SEE ALSO\nThe book of the suite, html/index.html in the folder of its documentation.\n";
}

std::string bash_completion(const Commands& commands) {
  std::vector<std::string> names;
  std::string branches;
  for (const Commands::Command& command : commands.all()) {
    names.push_back(command.name);
    branches += branch(command);
  }
  return fmt::format(
      "# Completions of {0} for bash, written by `{0} --completion`.\n"
      "_nlmech_{0}() {{\n"
      "  local words=\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    words='{1} --help --version'\n"
      "  else\n"
      "    case ${{COMP_WORDS[1]}} in\n"
      "{2}"
      "    esac\n"
      "  fi\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$2\")\n"
      "}}\n"
      "complete -o default -F _nlmech_{0} {0}\n",
      commands.program(), fmt::join(names, " "), branches);
}

}  // namespace nlmech::scene
