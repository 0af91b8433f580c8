#include "tests/adversary/commands/command_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "tests/places.hpp"

namespace nlmech::adversary {

Ran ran(const std::string& words, int limit) {
  std::vector<std::string> arguments = scene::split(words, ' ');
  arguments.front() = NLMECH_BINARY_DIR "/bin/" + arguments.front();
  arguments.insert(arguments.end(), {"--limit", std::to_string(limit)});
  const scene::Finished f = scene::run_program(arguments, {});
  Ran r{words, f.exit_code, f.errors, {}, {}};
  for (auto& record : scene::parse_csv(f.output, "output")) r.rows.push_back(std::move(record.cells));
  if (r.rows.empty()) return r;
  r.header = std::move(r.rows.front());
  r.rows.erase(r.rows.begin());
  return r;
}

std::optional<Case> failed(const Ran& r) {
  if (r.exit_code == 0) return {};
  if ((r.exit_code != 1 && r.exit_code != 2) || !r.header.empty() || r.errors.empty())
    return Case::wrong(fmt::format("{}: exit code {}, {}", r.words, r.exit_code, r.errors));
  return Case::refused(fmt::format("{}: {}", r.words, r.errors));
}

double number(const std::string& cell) {
  double value = 0;
  return scene::parse_number(cell, value) ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string missing_program(const std::string& program) {
  return std::filesystem::exists(NLMECH_BINARY_DIR "/bin/" + program) ? "" : program + " is not built";
}

}  // namespace nlmech::adversary
