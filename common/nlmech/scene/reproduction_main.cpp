/// @file
/// `reproduction`: published beside reproduced over all chapters of the build.
///
/// `report --chapters FILE [--out DIR] [--page FILE]`: all values; exit code 1 if one is missed.
///
/// `verdict NAME --chapters FILE [--out DIR]`: one value; exit code 77 if its chapter is not built.
///
/// `tests`: names of all values, one a line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "nlmech/scene/check.hpp"
#include "nlmech/scene/command_line.hpp"
#include "nlmech/scene/files.hpp"
#include "nlmech/support/errors.hpp"

namespace {

using namespace nlmech::scene;

constexpr int kept = 0, missed = 1, wrong_usage = 2, skipped = 77;

struct Options {
  std::string chapters, out = ".", page, name;
};

std::vector<std::string> read_built(const Options& options) {
  std::vector<std::string> built;
  std::istringstream lines(read_whole(options.chapters));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) built.push_back(line);
  }
  return built;
}

/// The chapter that owns a value, if it is built.
std::vector<std::string> built_owner(const Options& options) {
  const std::vector<Place> places = read_places(data_folder());
  std::vector<std::string> built = read_built(options);
  for (const PublishedValue& value : read_published(data_folder())) {
    if (value.name() != options.name) continue;
    std::erase_if(built, [&](const std::string& chapter) { return chapter != owner(value, places); });
    return built;
  }
  throw nlmech::InputError(fmt::format("no source prints '{}'", options.name));
}

bool is_miss(const Checked& c) { return c.judgement.verdict != Verdict::not_built && !c.judgement.kept; }

int report(const Options& options) {
  const std::vector<Checked> values = collect_checks(read_built(options), data_folder(), options.out);
  if (!options.page.empty()) write_whole(options.page, reproduction_page(values));
  const auto misses = std::count_if(values.begin(), values.end(), is_miss);
  print_result(reproduction_text(values) +
               fmt::format("{} published values, {} missed\n", values.size(), misses));
  return misses == 0 ? kept : missed;
}

/// Looks at the chapter that owns the value and at no other: they may not have been checked.
int verdict(const Options& options) {
  const std::vector<Checked> values = collect_checks(built_owner(options), data_folder(), options.out);
  const auto c = std::find_if(values.begin(), values.end(),
                              [&](const Checked& other) { return other.value.name() == options.name; });
  print_result(reproduction_text({*c}));
  if (c->judgement.verdict == Verdict::not_built) return skipped;
  return is_miss(*c) ? missed : kept;
}

void list_names() {
  std::string names;
  for (const PublishedValue& value : read_published(data_folder())) names += value.name() + '\n';
  print_result(names);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Published beside reproduced, over all chapters", "reproduction");
  app.require_subcommand(1);
  Options options;
  int code = kept;
  CLI::App* reporter = app.add_subcommand("report", "all values; exit code 1 if one missed its verdict");
  reporter->add_option("--page", options.page, "write the Markdown page to this file too");
  reporter->callback([&] { code = report(options); });
  CLI::App* judge = app.add_subcommand("verdict", "one value; exit code 77 if its chapter is not built");
  judge->add_option("name", options.name, "source/place/row/quantity")->required();
  judge->callback([&] { code = verdict(options); });
  for (CLI::App* sub : {reporter, judge}) {
    sub->add_option("--chapters", options.chapters, "file with the names of the chapters built")->required();
    sub->add_option("--out", options.out, "folder in which the chapters' checks left results/");
  }
  app.add_subcommand("tests", "names of all values, one a line")->callback(list_names);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kept : wrong_usage;
  } catch (const nlmech::InputError& error) {
    fmt::print(stderr, "reproduction: {}\n", error.what());
    return wrong_usage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "reproduction: {}\n", error.what());
    return missed;
  }
  return code;
}
