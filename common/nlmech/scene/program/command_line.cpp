#include "nlmech/scene/program/command_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "nlmech/scene/evidence/check.hpp"
#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/terminal.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {
namespace {

/// Options of `list`.
struct Listing {
  bool csv = false;
};

/// Options of `run` and `check`.
struct Work {
  std::vector<std::string> scenes;
  bool all = false, quick = false, no_plots = false, png = false, draw = false, quiet = false;
  std::string out = ".";
};

void list(const Chapter& chapter, bool csv) {
  Table table({{"scene"}, {"place"}, {"title"}, {"runs"}});
  for (const Scene& s : chapter.scenes()) {
    std::vector<std::string_view> runs;
    for (const auto& run : s.content.needs) runs.push_back(run->name());
    table.add({s.name, s.place, s.title, fmt::format("{}", fmt::join(runs, " "))});
  }
  const std::optional<std::size_t> width = csv ? std::nullopt : terminal_width(STDOUT_FILENO);
  print_result(csv     ? table.csv()
               : width ? fmt::format("{}\n\n{}", chapter.title(), aligned(table, *width))
                       : fmt::format("{}\n\n{}", chapter.title(), table.markdown()));
}

std::vector<const Scene*> chosen(const Chapter& chapter, const Work& options) {
  std::vector<const Scene*> scenes;
  for (const Scene& s : chapter.scenes()) {
    if (options.all) scenes.push_back(&s);
  }
  if (!options.all && options.scenes.empty())
    throw InputError("run: no scene is named; give names, or --all; 'list' prints the names");
  for (const std::string& name : options.scenes) {
    const Scene& scene = chapter.scene(name);
    if (std::find(scenes.begin(), scenes.end(), &scene) == scenes.end()) scenes.push_back(&scene);
  }
  return scenes;
}

/// Prints one line per scene if standard error is a terminal.
void print_progress(std::size_t done, std::size_t all, const std::string& scene, double seconds) {
  if (::isatty(STDERR_FILENO) == 1)
    print_message(fmt::format("[{}/{}] {} {:.1f} s", done, all, scene, seconds));
}

void report_failing(const std::string& scene, const Quantity& q) {
  print_message(fmt::format("FAILS {}: {} = {} {}, allowed {} to {} ({})", scene, q.name,
                            format_number(q.value, 6), q.unit, format_number(q.low, 6),
                            format_number(q.high, 6), q.reason));
}

/// One line per file, relative to the output folder.
std::string lines_of(const std::vector<std::filesystem::path>& files) {
  std::string lines;
  for (const std::filesystem::path& file : files) lines += file.string() + '\n';
  return lines;
}

/// Runs scenes, and continues after a scene that failed or could not be drawn.
int run(const Chapter& chapter, const Work& options) {
  if (options.no_plots && options.png)
    throw InputError("run: --png and --no-plots exclude each other; give one of them");
  const std::vector<const Scene*> scenes = chosen(chapter, options);
  const Publishing how{options.out, !options.no_plots, options.png};
  Results results(options.quick);
  int code = 0;
  std::size_t done = 0;
  for (const Scene* scene : scenes) {
    results.wait_for_processor(scenes.size() - done);
    const Stopwatch watch;
    const ProgressScope doing("computing " + scene->name);
    try {
      const auto files = publish(chapter, *scene, perform(*scene, results), options.quick, how);
      if (!options.quiet) print_result(lines_of(files));
    } catch (const Failure& failure) {
      print_message(fmt::format("{}: {}: {}", chapter.name(), scene->name, failure.what()));
      code = ExitCode::failed;
    }
    print_progress(++done, scenes.size(), scene->name, watch.seconds());
  }
  return code;
}

int check(const Chapter& chapter, const Work& options) {
  std::optional<Publishing> how;
  if (options.draw) how = Publishing{options.out, true, false};
  const ChapterCheck result = check(chapter, data_folder(), options.quick, how);
  write_check(result, chapter.name(), options.out);
  std::string text = reproduction_text(result.values);
  std::size_t passed = 0;
  for (const CheckedQuantity& q : result.quantities) {
    passed += q.quantity.passes() ? 1 : 0;
    if (!q.quantity.passes()) report_failing(q.scene, q.quantity);
  }
  text += fmt::format("{} quantities of {} scenes: {} pass, {} fail\n", result.quantities.size(),
                      chapter.scenes().size(), passed, result.quantities.size() - passed);
  print_last_result(text);
  return result.passes() ? 0 : ExitCode::failed;
}

void declare_list(Options& options, Listing& listing) {
  options.add("--csv", listing.csv, "as CSV");
  options.unlimited();
}

void declare_both(Options& options, Work& work) {
  options.add("--out", work.out, "folder for figures/, tables/ and results/");
  options.add("--quick", work.quick, "fewer samples and shorter timings with the same methods");
  options.unlimited();
}

void declare_run(Options& options, Work& work) {
  options.add("scenes", work.scenes, "names of scenes");
  options.add("--all", work.all, "every scene");
  options.add("--no-plots", work.no_plots, "write numbers and tables, no figures");
  options.add("--png", work.png, "also write a PNG image of each figure");
  options.add("--quiet", work.quiet, "do not print the names of files");
  declare_both(options, work);
}

void declare_check(Options& options, Work& work) {
  options.add("--draw", work.draw, "also write every scene, as run --all does");
  declare_both(options, work);
}

}  // namespace

int chapter_main(const Chapter& chapter, void (*add_commands)(Commands&), int argc, const char* const* argv) {
  Commands commands(chapter.name());
  commands.add("list", "List the scenes, what they show and need: columns on a terminal, Markdown in a pipe",
               declare_list, [&](const Listing& listing) { list(chapter, listing.csv); });
  commands.add("run",
               "Compute scenes: numbers, tables and figures. Prints the names of the files written, one per "
               "line, relative to --out",
               declare_run, [&](const Work& work) { return run(chapter, work); });
  commands.add("check", "Compare published with reproduced values; exit code 1 if a check fails",
               declare_check, [&](const Work& work) { return check(chapter, work); });
  add_commands(commands);
  return run_command(commands, chapter.title(), argc, argv);
}

}  // namespace nlmech::scene
