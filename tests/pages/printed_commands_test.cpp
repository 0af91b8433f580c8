/// Every command that README and the chapters' pages print is run as a reader would type it, in an empty
/// folder.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "nlmech/scene/files.hpp"
#include "nlmech/scene/process.hpp"

namespace nlmech {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Lines of the page's ```sh blocks that call a program of the build. The make targets are run by CI itself.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  bool in_shell = false;
  for (const std::string& line : lines_of(scene::read_whole(page))) {
    if (line.starts_with("```"))
      in_shell = line == "```sh";
    else if (in_shell && line.find("build/bin/") != std::string::npos)
      commands.push_back(line);
  }
  return commands;
}

std::vector<fs::path> pages() {
  const fs::path source = NLMECH_SOURCE_DIR;
  std::vector<fs::path> found = {source / "README.md"};
  for (const std::string& chapter : lines_of(scene::read_whole(NLMECH_BINARY_DIR "/chapters.txt"))) {
    if (!chapter.empty()) found.push_back(source / "chapters" / chapter / (chapter + ".md"));
  }
  return found;
}

TEST(PrintedCommands, EndWithZeroAndSaySomething) {
  const fs::path folder = fs::temp_directory_path() / ("nlmech-pages-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  fs::create_directory_symlink(NLMECH_BINARY_DIR, folder / "build");
  for (const fs::path& page : pages()) {
    const std::vector<std::string> commands = commands_of(page);
    EXPECT_FALSE(commands.empty()) << page << " prints no command";
    for (const std::string& command : commands) {
      const scene::Finished f = scene::run_program({"sh", "-c", command}, folder);
      EXPECT_EQ(f.exit_code, 0) << page << ": " << command << "\n" << f.errors;
    }
  }
  EXPECT_TRUE(fs::exists(folder / "figures" / "geodesy" / "fig-2.27.svg"));
  fs::remove_all(folder);
}

TEST(PrintedCommands, ExampleOfTheGeodesyPageRuns) {
  const scene::Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/geodesy_example"}, {});
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_TRUE(f.output.starts_with("success: latitude 21.52"))
      << f.output;  // atan(2.5/6.379) = 21.40 deg plus the flattening
}

}  // namespace
}  // namespace nlmech
