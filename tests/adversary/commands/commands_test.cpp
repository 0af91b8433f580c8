/// Whatever is typed after a program's name: it ends, within its limit, with 0 and finite numbers, or with 1
/// or 2, nothing on standard output and a few printable words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "nlmech/scene/program/process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "tests/adversary/mutation.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::adversary::commands_test {
namespace {

namespace fs = std::filesystem;

/// Does the command compute on the user's own numbers, with nothing for a shell to do?
bool is_own_work(const std::string& line) {
  const std::vector<std::string> words = scene::split(line, ' ');
  return words.size() > 1 && words[1] != "list" && words[1] != "run" && words[1] != "check" &&
         line.find_first_of("><|*\\$#") == std::string::npos;
}

/// What the pages of the chapters print, without "build/bin/"; those of programs that are built.
std::vector<std::string> printed_commands() {
  std::vector<std::string> found;
  const std::string begin = "build/bin/";
  for (const auto& chapter : fs::directory_iterator(NLMECH_SOURCE_DIR "/chapters")) {
    std::ifstream page(chapter.path() / (chapter.path().filename().string() + ".md"));
    for (std::string line; std::getline(page, line);) {
      if (!line.starts_with(begin)) continue;
      const std::string command = line.substr(begin.size());
      const std::string program = command.substr(0, command.find(' '));
      if (is_own_work(command) && fs::exists(fs::path(NLMECH_BINARY_DIR "/bin") / program))
        found.push_back(command);
    }
  }
  std::sort(found.begin(), found.end());  // the same cases on every machine
  return found;
}

/// An option's number by another one, far or near; or any damage.
std::string changed(Draw& draw, const std::vector<std::string>& commands) {
  const std::string command = draw.one_of(commands);
  std::vector<std::string> words = scene::split(command, ' ');
  if (words.size() == 2 || draw.chance(0.3)) {
    const auto blank = command.find(' ');
    return command.substr(0, blank + 1) + damaged(draw, {command.substr(blank + 1)});
  }
  for (int n = draw.whole(1, 3); n > 0; --n) {
    std::string& word = words[static_cast<std::size_t>(draw.whole(2, static_cast<int>(words.size()) - 1))];
    std::vector<std::string> parts = scene::split(word, ',');
    std::string& part = parts[static_cast<std::size_t>(draw.whole(0, static_cast<int>(parts.size()) - 1))];
    if (part.find_first_of("0123456789") == std::string::npos) continue;
    const double x = draw.chance(0.3)   ? draw.any_finite()
                     : draw.chance(0.5) ? draw.log_uniform(1e-12, 1e12)
                                        : draw.whole(-3, 40);
    const auto sign = part.find('=');
    part = (sign == std::string::npos ? "" : part.substr(0, sign + 1)) + fmt::format("{:.17g}", x);
    word = fmt::format("{}", fmt::join(parts, ","));
  }
  return fmt::format("{}", fmt::join(words, " "));
}

/// Is there a cell that is no finite number and no word? The period of a hyperbola and the axis of a parabola
/// are infinite.
bool has_nan(const std::string& csv, bool of_a_conic) {
  std::string cell;
  for (const char c : csv + "\n") {
    if (c != ',' && c != '\n') {
      cell += c;
      continue;
    }
    if (cell == "nan" || cell == "-nan") return true;
    if (!of_a_conic && (cell == "inf" || cell == "-inf")) return true;
    cell.clear();
  }
  return false;
}

bool printable(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 4100 || (!line.empty() && !is_sentence(line.substr(0, 1000)))) return false;
  }
  return text.size() < 20'000;
}

Case run(const std::string& command, const fs::path& folder) {
  std::vector<std::string> arguments = {"timeout", "-s", "KILL", "20", NLMECH_BINARY_DIR "/bin/"};
  const std::vector<std::string> words = scene::split(command, ' ');
  arguments.back() += words[0];
  for (std::size_t i = 1; i < words.size(); ++i) {
    arguments.push_back(words[i].substr(0, words[i].find('\0')));
  }
  arguments.insert(arguments.begin() + 6, {"--limit", "1"});
  const scene::Finished f = scene::run_program(arguments, folder);
  const std::string what = fmt::format("{}: exit code {}, printed {}, said {}", shown(command), f.exit_code,
                                       shown(f.output), shown(f.errors));
  if (!printable(f.errors)) return Case::wrong("no message for a terminal: " + what);
  if (f.exit_code == 0) {
    if (f.output.empty()) return Case::wrong("nothing: " + what);
    const bool of_a_conic = command.starts_with("two_body_series elements");
    return has_nan(f.output, of_a_conic) ? Case::wrong("no finite numbers: " + what)
                                         : Case::judged(0, 1, what);
  }
  if (f.exit_code != 1 && f.exit_code != 2)
    return Case::wrong("crashed, or went on beyond its limit: " + what);
  if (!f.output.empty()) return Case::wrong("a result with a failure: " + what);
  return f.errors.empty() ? Case::wrong("silent: " + what) : Case::refused(what);
}

TEST(AdversaryCommands, EndInTimeWithNumbersOrASentence) {
  const std::vector<std::string> commands = printed_commands();
  if (commands.empty()) GTEST_SKIP() << "no program is built";
  const tests::TemporaryFolder folder;
  hunt({.quick = 20, .full = 10'000, .least_right = 0.02},
       [&](Draw& draw) { return run(changed(draw, commands), folder.path()); });
}

}  // namespace
}  // namespace nlmech::adversary::commands_test
