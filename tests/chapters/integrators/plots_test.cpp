/// `--plot` of `integrate` and `compare`: a picture beside the numbers, never instead of them.
#include <fmt/format.h>

#include <filesystem>

#include "tests/chapters/integrators/run.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::integrators_commands_test {
namespace {

using tests::bytes_of;
using tests::put;
using tests::TemporaryFolder;

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Words swing = {"integrate", "--equation", "x'' = -x", "--initial", "x=0, x'=1", "--until", "20"};

/// Points of the curves of a picture: places of its paths and of the symbols that it uses.
std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += piece.size()) ++found;
  return found;
}

TEST(Plot, OfARunStandsBesideItsNumbers) {
  const TemporaryFolder folder;
  const Finished plain = integrators(swing),
                 drawn = integrators(with(swing, {"--plot", "a.svg"}), folder.string());
  EXPECT_EQ(drawn.exit_code, 0) << drawn.errors;
  EXPECT_EQ(drawn.output, plain.output);
  const std::string picture = bytes_of(folder / "a.svg");
  EXPECT_NE(picture.find("</svg>"), std::string::npos);
  EXPECT_NE(picture.find("-x"), std::string::npos);
  // A comment of XML has no two hyphens, or no browser shows the picture.
  for (auto at = picture.find("<!--"); at != std::string::npos; at = picture.find("<!--", at + 1))
    EXPECT_EQ(picture.find("--", at + 4), picture.find("-->", at + 4));
  // Nothing is left beside it.
  EXPECT_EQ(tests::files_in(folder.path()).size(), 1U);
}

// One panel an unknown, however many: the chain of eight masses has eight, thirteen unknowns are cut at
// twelve.
TEST(Plot, HasAPanelForEachUnknown) {
  const TemporaryFolder folder;
  for (const int unknowns : {1, 2, 5, 8, 13}) {
    std::string equation;
    for (int i = 1; i <= unknowns; ++i)
      equation += fmt::format("y{0}'' = -{0} y{0}; y{0}(0) = 1; y{0}'(0) = 0;", i);
    const std::string file = fmt::format("{}.svg", unknowns);
    const Finished f =
        integrators({"integrate", "--equation", equation, "--until", "5", "--plot", file}, folder.string());
    EXPECT_EQ(f.exit_code, 0) << f.errors;
    const std::string picture = bytes_of(folder / file);
    for (int i = 1; i <= unknowns; ++i)
      EXPECT_EQ(count(picture, fmt::format(">y{}<", i)) > 0, i <= 12) << file << " y" << i;
    EXPECT_EQ(count(picture, ">y1'<"), 0U) << file;
  }
}

// Names, comments and markup of gnuplot in an equation stay what they are.
TEST(Plot, ShowsWordsAsTheyStand) {
  const TemporaryFolder folder;
  const Finished f = integrators({"integrate", "--equation", "x_1'' + x_1^3 = 0 # {/Bold @~&}'", "--initial",
                                  "x_1=1, x_1'=0", "--until", "3", "--plot", "a.svg"},
                                 folder.string());
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(bytes_of(folder / "a.svg").find("x_1"), std::string::npos);
}

TEST(Plot, OfWhatNeverMoves) {
  const TemporaryFolder folder;
  for (const std::string value : {"0", "1", "-3e-200", "7e200"}) {
    const Finished f = integrators(
        {"integrate", "--equation", "x' = 0", "--initial", "x=" + value, "--until", "3", "--plot", "a.svg"},
        folder.string());
    EXPECT_EQ(f.exit_code, 0) << value << f.errors;
  }
}

TEST(Plot, BackwardsAndOverDecades) {
  const TemporaryFolder folder;
  const Words robertson = {"integrate", "--file",
                           NLMECH_SOURCE_DIR "/chapters/integrators/examples/robertson.ode"};
  for (const Words& more : {Words{"--until", "1e6"}, Words{"--until", "1e-2"}}) {
    const Finished f = integrators(with(with(robertson, more), {"--plot", "a.svg"}), folder.string());
    EXPECT_EQ(f.exit_code, 0) << f.errors;
  }
  const Finished f = integrators(
      {"integrate", "--equation", "x'' = -x", "--initial", "x=0, x'=1", "--until", "-5", "--plot", "a.svg"},
      folder.string());
  EXPECT_EQ(f.exit_code, 0) << f.errors;
}

TEST(Plot, OfASectionShowsItsPoints) {
  const TemporaryFolder folder;
  const Words lorenz = {"integrate", "--problem", "lorenz",      "--until", "15",
                        "--section", "w=27",      "--no-verify", "--plot",  "a.svg"};
  const Finished f = integrators(lorenz, folder.string());
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const std::size_t points = count(f.output, "\n") - 1;
  EXPECT_GT(points, 10U);
  // As many symbols, and the one that defines them.
  EXPECT_EQ(count(bytes_of(folder / "a.svg"), "xlink:href='#gpPt6'"), points);
}

TEST(Plot, ASectionThatIsNeverMetLeavesTheNumbers) {
  const TemporaryFolder folder;
  const Finished f = integrators(with(swing, {"--section", "x=7", "--plot", "a.svg"}), folder.string());
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.output, "t,x,x',event\n");
  EXPECT_NE(f.errors.find("does not meet the section"), std::string::npos) << f.errors;
  EXPECT_TRUE(tests::files_in(folder.path()).empty());
}

TEST(Plot, NeverOverwritesAnothersFileNorMakesFolders) {
  const TemporaryFolder folder;
  put(folder / "mine.svg", "<svg>of somebody else</svg>\n");
  std::filesystem::create_directory(folder / "folder.svg");
  std::filesystem::create_symlink("mine.svg", folder / "link.svg");
  for (const auto& [file, says] :
       std::vector<std::pair<std::string, std::string>>{{"mine.svg", "overwrites nothing else"},
                                                        {"folder.svg", "overwrites nothing else"},
                                                        {"link.svg", "overwrites nothing else"},
                                                        {"nowhere/a.svg", "no such folder"},
                                                        {"mine.svg/a.svg", "no such folder"},
                                                        {"a.png", "needs a name.svg"},
                                                        {".svg", "needs a name.svg"},
                                                        {"-", "needs a name.svg"},
                                                        {std::string(5000, 'a') + ".svg", "--plot"}}) {
    expect_refused({with(swing, {"--plot", file}), {"--plot", says}}, folder.string());
    expect_refused({{"compare", "--problem", "duffing", "--until", "1", "--plot", file}, {"--plot", says}},
                   folder.string());
  }
  EXPECT_EQ(bytes_of(folder / "mine.svg"), "<svg>of somebody else</svg>\n");
  // Its own it does.
  for (int k = 0; k < 2; ++k)
    EXPECT_EQ(integrators(with(swing, {"--plot", "own.svg"}), folder.string()).exit_code, 0);
}

TEST(Plot, WithoutGnuplotThereAreNumbers) {
  const TemporaryFolder folder;
  Words words = {"/usr/bin/env", "PATH=/nowhere", NLMECH_BINARY_DIR "/bin/integrators"};
  const Finished f = scene::run_program(with(with(words, swing), {"--plot", "a.svg"}), folder.path());
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.output, integrators(swing).output);
  EXPECT_NE(f.errors.find("all numbers are written, but a.svg is not drawn"), std::string::npos) << f.errors;
}

TEST(Plot, OfAComparisonNamesItsMethods) {
  const TemporaryFolder folder;
  const Finished f =
      integrators({"compare", "--problem", "duffing", "--until", "10", "--methods",
                   "series,ode45,adaptive-collocation", "--tolerances", "1e-4:1e-8", "--plot", "a.svg"},
                  folder.string());
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(count(f.output, "\n"), 1U + 3 * 5);
  const std::string picture = bytes_of(folder / "a.svg");
  for (const char* method : {"series", "ode45", "adaptive-collocation"})
    EXPECT_NE(picture.find(method), std::string::npos) << method;
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
