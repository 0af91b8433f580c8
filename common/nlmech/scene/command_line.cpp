#include "nlmech/scene/command_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>
#include <system_error>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/check.hpp"
#include "nlmech/scene/files.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {
namespace {

constexpr int failed = 1, wrong_usage = 2;

struct Options {
  std::vector<std::string> scenes;
  bool all = false, quick = false, no_plots = false, png = false, csv = false, draw = false;
  std::string out = ".";
};

void list(const Chapter& chapter, bool csv) {
  Table table({{"scene"}, {"place"}, {"title"}, {"runs"}, {"seconds"}});
  for (const Scene& s : chapter.scenes()) {
    std::vector<std::string_view> runs;
    for (const AnyRun* run : s.needs) runs.push_back(run->name());
    table.add({s.name, s.place, s.title, fmt::format("{}", fmt::join(runs, " ")), s.seconds});
  }
  print_result(csv ? table.csv() : fmt::format("{}\n\n{}", chapter.title(), table.markdown()));
}

std::vector<const Scene*> chosen(const Chapter& chapter, const Options& options) {
  std::vector<const Scene*> scenes;
  for (const Scene& s : chapter.scenes()) {
    if (options.all) scenes.push_back(&s);
  }
  if (!options.all && options.scenes.empty())
    throw InputError("run: name scenes, or say --all; 'list' shows what there is");
  for (const std::string& name : options.scenes) {
    const Scene& scene = chapter.scene(name);
    if (std::find(scenes.begin(), scenes.end(), &scene) == scenes.end()) scenes.push_back(&scene);
  }
  return scenes;
}

/// From one of them on.
double seconds_of(const std::vector<const Scene*>& scenes, std::size_t first) {
  double sum = 0;
  for (std::size_t i = first; i < scenes.size(); ++i) sum += scenes[i]->seconds;
  return sum;
}

/// On a terminal one line a scene; silence in a pipe.
void tell_progress(std::size_t done, std::size_t all, const std::string& scene, double seconds) {
  if (::isatty(STDERR_FILENO) == 1) fmt::print(stderr, "[{}/{}] {} {:.1f} s\n", done, all, scene, seconds);
}

void report_missed(const std::string& scene, const Quantity& q) {
  fmt::print(stderr, "MISSED {}: {} = {} {}, promised {} to {} ({})\n", scene, q.name,
             format_number(q.value, 6), q.unit, format_number(q.low, 6), format_number(q.high, 6), q.reason);
}

/// Goes on after a scene that failed or could not be drawn: the others are not to suffer from it.
int run(const Chapter& chapter, const Options& options) {
  const std::vector<const Scene*> scenes = chosen(chapter, options);
  const Publishing how{options.out, !options.no_plots, options.png};
  Workshop workshop(options.quick);
  int code = 0;
  std::size_t done = 0;
  for (const Scene* scene : scenes) {
    workshop.take_turn(seconds_of(scenes, done));
    const Stopwatch watch;
    try {
      publish(chapter, *scene, perform(*scene, workshop), options.quick, how);
    } catch (const Failure& failure) {
      fmt::print(stderr, "{}: {}: {}\n", chapter.name(), scene->name, failure.what());
      code = failed;
    }
    tell_progress(++done, scenes.size(), scene->name, watch.seconds());
  }
  return code;
}

int check(const Chapter& chapter, const Options& options) {
  std::optional<Publishing> how;
  if (options.draw) how = Publishing{options.out, true, false};
  const ChapterCheck result = check(chapter, data_folder(), options.quick, how);
  write_check(result, chapter.name(), options.out);
  std::string text = reproduction_text(result.values);
  std::size_t kept = 0;
  for (const CheckedQuantity& q : result.quantities) {
    kept += q.quantity.kept() ? 1 : 0;
    if (!q.quantity.kept()) report_missed(q.scene, q.quantity);
  }
  text += fmt::format("{} quantities of {} scenes: {} kept, {} missed\n", result.quantities.size(),
                      chapter.scenes().size(), kept, result.quantities.size() - kept);
  print_result(text);
  return result.kept() ? 0 : failed;
}

/// Help and version go where results go, complaints to standard error.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream help;
  if (app.exit(error, help, std::cerr) != 0) return wrong_usage;
  print_result(help.str());
  return 0;
}

}  // namespace

void print_result(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Failure("standard output: cannot be written: " + std::generic_category().message(errno));
  }
}

int chapter_main(const Chapter& chapter, const OwnWork& own_work, int argc, const char* const* argv) {
  CLI::App app(chapter.title(), chapter.name());
  app.set_version_flag("--version", "nlmech " + build_info().version);
  app.require_subcommand(1);
  Options options;
  int code = 0;

  CLI::App* lister = app.add_subcommand("list", "Scenes, what they show and need, and their time in seconds");
  lister->add_flag("--csv", options.csv, "as CSV");
  lister->callback([&] { list(chapter, options.csv); });

  CLI::App* runner = app.add_subcommand("run", "Compute scenes: numbers, tables and figures");
  runner->add_option("scenes", options.scenes, "names of scenes");
  runner->add_flag("--all", options.all, "every scene");
  runner->add_flag("--no-plots", options.no_plots, "numbers and tables only");
  runner->add_flag("--png", options.png, "a PNG image beside each SVG");
  runner->callback([&] { code = run(chapter, options); });

  CLI::App* checker =
      app.add_subcommand("check", "Published beside reproduced; exit code 1 if a promise is missed");
  checker->add_flag("--draw", options.draw, "also put every scene on disk, as run --all does");
  checker->callback([&] { code = check(chapter, options); });

  for (CLI::App* sub : {runner, checker}) {
    sub->add_option("--out", options.out, "folder that gets figures/, tables/, results/")
        ->capture_default_str();
    sub->add_flag("--quick", options.quick, "fewer samples and shorter timings, never other methods");
  }
  own_work(app);

  try {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return end_of_parsing(app, error);
    }
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", chapter.name(), error.what());
    return wrong_usage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", chapter.name(), error.what());
    return failed;
  }
  return code;
}

}  // namespace nlmech::scene
