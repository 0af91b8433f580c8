/// Plots: the gnuplot script, and its result.
#include "nlmech/scene/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::plot_test {
namespace {

/// Expects that the script contains the line.
void expect_line(const std::string& script, const std::string& line) {
  EXPECT_TRUE(tests::holds("\n" + script, "\n" + line + "\n"));
}

TEST(Plot, KeepsCurvesInBlocksWithTheirNumbers) {
  Plot plot("Two curves");
  Panel& panel = plot.columns({"series", "t", "x"}).panel("time", "position");
  panel.curve("first", {0, 1}, {2, 3}).curve("it's", {0}, {4}, points(5));
  EXPECT_EQ(plot.data().csv(), "series,t,x\n1,0,2\n1,1,3\n\n2,0,4\n");
  EXPECT_EQ(plot.curves(), 2U);
  expect_line(plot.script(), "set title 'Two curves'");
  expect_line(plot.script(), "set xlabel 'time'");
  expect_line(plot.script(),
              "plot data using \"t\":\"x\" every :::0::0 with lines linestyle 1 title 'first', \\\n"
              "     data using \"t\":\"x\" every :::1::1 with points linestyle 5 title 'it''s'");
}

TEST(Plot, CountsCurvesOverPanels) {
  Plot plot("Two panels");
  plot.columns({"panel", "curve", "x", "y"});
  plot.panel("x", "y").curve("", {1}, {2});
  plot.panel("x", "z").curve("", {3}, {4});
  EXPECT_EQ(plot.data().csv(), "panel,curve,x,y\n1,1,1,2\n\n2,2,3,4\n");
  const std::string script = plot.script();
  expect_line(script, "set multiplot");
  expect_line(script, "plot data using \"x\":\"y\" every :::1::1 with lines linestyle 1 notitle");
  expect_line(script, "unset multiplot");
}

struct Sample {
  double t, x;
  [[nodiscard]] double twice() const { return 2 * x; }
};

TEST(Plot, TakesAccessorsOfRows) {
  Plot plot("Rows");
  const std::vector<Sample> samples = {{0, 1}, {1, 5}};
  plot.panel("t", "2 x").curve("twice", samples, &Sample::t, &Sample::twice);
  EXPECT_EQ(plot.data().csv(), "curve,x,y\n1,0,2\n1,1,10\n");
}

TEST(Plot, RefusesRangesThatGnuplotCannotDraw) {
  Plot plot("Ranges");
  Panel& panel = plot.panel("t", "x");
  const double nan = std::nan("");
  EXPECT_THROW(panel.log_x(0, 1), std::invalid_argument);
  EXPECT_THROW(panel.log_y(2, 1), std::invalid_argument);
  EXPECT_THROW(panel.log_y(1, nan), std::invalid_argument);
  EXPECT_THROW(panel.x_range(1, 1), std::invalid_argument);
  EXPECT_THROW(panel.y_range(nan, 1), std::invalid_argument);
  panel.x_range(2460000.5, 2460001.5);
  expect_line(plot.script(), "set xrange [2460000.5:2460001.5]");
}

TEST(Plot, DrawsColumnsOfOtherData) {
  Plot plot("Columns");
  Table table({{"t"}, {"laier"}});
  table.add({0.0, 1.0});
  plot.data(std::move(table)).panel("t", "x").columns("Laier", "t:laier").also("0 with lines");
  expect_line(plot.script(),
              "plot data using \"t\":\"laier\" with lines linestyle 1 title 'Laier', \\\n     0 with lines");
  EXPECT_EQ(plot.data().csv(), "t,laier\n0,1\n");
}

TEST(Plot, NamesTensOfPowersOneByOne) {
  Plot plot("Many decades");
  plot.panel("x", "y").log_y(1e-25, 1e10).curve("", {1}, {2});
  expect_line(plot.script(), "set ytics (1e-20, 1e-10, 1e0, 1e10)");
}

TEST(Plot, TakesExpressionsForColumns) {
  Plot plot("Expressions");
  plot.data(Table({{"t"}})).panel("t", "x").columns("", "t:(f(column('t')) > 0 ? 1 : NaN)");
  expect_line(plot.script(),
              "plot data using \"t\":(f(column('t')) > 0 ? 1 : NaN) with lines linestyle 1 notitle");
}

TEST(Plot, LabelsShortLogarithmicAxesWithNumbersAndLongOnesWithPowers) {
  Plot plot("Axes");
  plot.panel("h", "error").log_x(0.02, 0.5).log_y(1e-12, 1).curve("", {0.1}, {0.1});
  const std::string script = plot.script();
  expect_line(script, "set xrange [0.02:0.5]");
  expect_line(script, "set xtics (1e-2, 2e-2, 5e-2, 1e-1, 2e-1, 5e-1)");
  expect_line(script, "set ytics 1e2");
  expect_line(script, "set format y power_of_ten");
}

TEST(Plot, StacksPanelsByTheirShares) {
  Plot plot("Stack");
  plot.stacked({3, 1}).size(800, 500);
  plot.panel("t", "x").curve("", {1}, {2});
  plot.panel("t", "v").curve("", {1}, {2});
  EXPECT_EQ(plot.prelude(), "width = 800\nheight = 500\n");
  const std::string script = plot.script();
  // From 1 - 50/500 to 72/500 of the height: three quarters for the first panel, and a gap of 0.02.
  expect_line(script, "set margins screen 0.135, screen 0.965, screen 0.353, screen 0.9");
  expect_line(script, "set margins screen 0.135, screen 0.965, screen 0.144, screen 0.313");
  expect_line(script, "set xlabel ''");
}

TEST(Plot, PlacesPanelsWhereTheyAreWanted) {
  Plot plot("Four");
  plot.panel("t", "x").place(0.1, 0.45, 0.6, 0.9).curve("", {1}, {2});
  expect_line(plot.script(), "set margins screen 0.1, screen 0.45, screen 0.6, screen 0.9");
}

TEST(Plot, KeepsBlanksBesideMarkup) {
  EXPECT_EQ(with_kept_blanks("step {/:Italic h} (s)"), "step \u200b{/:Italic h}\u200b (s)");
  EXPECT_EQ(with_kept_blanks("t_0 s"), "t_0\u200b s");
}

TEST(Plot, RefusesWhatCannotBeDrawn) {
  Plot plot("Refused");
  Panel& panel = plot.panel("x", "y");
  EXPECT_THROW(panel.curve("", {1, 2}, {1}), std::invalid_argument);
  EXPECT_THROW(panel.curve("", {}, {}), std::invalid_argument);
  EXPECT_THROW(plot.columns({"x", "y"}), std::invalid_argument);
  EXPECT_THROW(plot.size(0, 100), std::invalid_argument);
  panel.curve("", {1}, {1});
  EXPECT_THROW(plot.columns({"curve", "x", "y"}), std::invalid_argument)
      << "curves were drawn under other names";
  plot.data(Table({{"t"}}));
  EXPECT_THROW(panel.curve("", {1}, {1}), std::logic_error);
}

namespace fs = std::filesystem;
using tests::put;
using tests::TemporaryFolder;

/// A folder with style, template and data, and optional replacements for gnuplot.
class Draw : public ::testing::Test {
 protected:
  Draw() {
    put(folder_ / "tables/published/none.csv", "");
    put(folder_ / "figures/style.gp", "set terminal svg\nset datafile separator ','\n");
    put(folder_ / "figures/templates/line.gp",
        "# Variables: heading\n\nset title heading\nplot data using 1:2 with lines title 'y'\n");
    put(folder_ / "out/results/a.csv", "0,1\n1,3\n2,2\n");
    ::setenv("NLMECH_DATA", folder_.string().c_str(), 1);
  }
  ~Draw() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("NLMECH_DATA");
  }

  std::string draw_line(const std::string& data = "results/a.csv", const std::string& heading = "A line",
                        PictureFormat format = PictureFormat::svg) {
    put_style(folder_ / "out");
    const Figure figure{Table({{"x"}}), "line", {{"heading", heading}}};
    put(folder_ / "out/results/a.gp", gnuplot_script(figure, data));
    return draw(folder_ / "out", "results/a.gp", format);
  }
  /// The message of a drawing that fails; "" if it succeeds.
  std::string complaint() {
    return tests::thrown<Failure>([&] { return draw_line(); });
  }
  /// Replaces gnuplot by this shell script for the following drawings.
  void replace_gnuplot(const std::string& script) {
    const fs::path program = folder_ / "bin/gnuplot";
    put(program, "#!/bin/sh\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("PATH", (program.parent_path().string() + ":" + path_).c_str(), 1);
  }

  TemporaryFolder folder_;
  std::string path_ = std::getenv("PATH");
};

TEST_F(Draw, GivesAnSvgWithTheCurve) {
  const std::string svg = draw_line();
  EXPECT_TRUE(tests::holds(svg, "<svg"));
  EXPECT_TRUE(tests::holds(svg, "<path"));
  EXPECT_TRUE(tests::holds(svg, "A line"));
  EXPECT_EQ(svg.find(folder_.string()), std::string::npos) << "a path of the machine in a picture";
  EXPECT_EQ(draw_line(), svg);
}

TEST_F(Draw, GivesAPngWhereTheStyleKnowsHow) {
  put(folder_ / "figures/style.gp",
      "if (exists('png')) { set terminal pngcairo size 400,300 } else { set terminal svg }\nset datafile "
      "separator ','\n");
  const std::string png = draw_line("results/a.csv", "A line", PictureFormat::png);
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n")) << png.substr(0, 8);
  EXPECT_TRUE(tests::holds(png, "IEND"));
}

TEST_F(Draw, PassesQuotesOnToTheTemplate) {
  EXPECT_TRUE(tests::holds(draw_line("results/a.csv", "Williams' toggle; \"x\""), "Williams' toggle; "));
}

TEST_F(Draw, FindsDataWithAQuoteInTheirName) {
  put(folder_ / "out/results/it's.csv", "0,1\n1,3\n");
  EXPECT_TRUE(tests::holds(draw_line("results/it's.csv"), "<path"));
}

// Continuous integration and cron use the C locale, in which gnuplot warns about the degree sign.
TEST_F(Draw, IsTheSameInEveryLocale) {
  put(folder_ / "figures/style.gp", "set terminal svg\nset encoding utf8\nset datafile separator ','\n");
  std::map<std::string, std::string> pictures;
  for (const char* locale : {"C", "C.UTF-8", "de_DE.UTF-8"}) {
    ::setenv("LC_ALL", locale, 1);
    pictures[locale] = draw_line("results/a.csv", "\xcf\x86 in \xc2\xb0");
  }
  ::unsetenv("LC_ALL");
  EXPECT_EQ(pictures["C"], pictures["C.UTF-8"]);
  EXPECT_EQ(pictures["C"], pictures["de_DE.UTF-8"]);
}

TEST_F(Draw, WritesAScriptThatStandsAlone) {
  static_cast<void>(draw_line());
  EXPECT_EQ(read_whole(folder_ / "out/results/a.gp"),
            "data = 'results/a.csv'\nheading = 'A line'\nload 'figures/style.gp'\n\n"
            "set title heading\nplot data using 1:2 with lines title 'y'\n");
}

TEST_F(Draw, SaysThatGnuplotIsMissingWithAnEmptyPath) {
  ::setenv("PATH", "", 1);
  EXPECT_EQ(complaint(), "gnuplot: cannot be started: No such file or directory");
}

TEST_F(Draw, PassesOnWhyGnuplotFailed) {
  put(folder_ / "figures/templates/line.gp", "plot no_such_function(x)\n");
  const std::string said = complaint();
  EXPECT_TRUE(tests::holds(said, "gnuplot ended with 1: "));
  EXPECT_TRUE(tests::holds(said, "undefined function"));
}

TEST_F(Draw, FailsWithoutData) {
  fs::remove(folder_ / "out/results/a.csv");
  EXPECT_TRUE(tests::holds(complaint(), "gnuplot"));
}

TEST_F(Draw, DoesNotLetAWarningPass) {
  put(folder_ / "out/results/a.csv", "nothing,here\nis,a number\n");
  const std::string said = complaint();
  EXPECT_TRUE(tests::holds(said, "gnuplot")) << "an empty frame was accepted";
  put(folder_ / "out/results/a.csv", "0,1\n1,3\n");
  replace_gnuplot("echo 'warning: something is odd' >&2; echo '<svg></svg>'");
  EXPECT_EQ(complaint().substr(0, 38), "gnuplot warns: warning: something is o");
}

TEST_F(Draw, DoesNotTakeSilenceForAPicture) {
  replace_gnuplot("exit 0");
  EXPECT_EQ(complaint(), "gnuplot drew nothing");
  replace_gnuplot("echo '<svg>'");
  EXPECT_EQ(complaint(), "gnuplot drew nothing") << "half a picture";
}

TEST_F(Draw, SaysWhichSignalEndedGnuplot) {
  replace_gnuplot("kill -KILL $$");
  EXPECT_EQ(complaint(), "gnuplot ended with 137: ");
}

TEST_F(Draw, KeepsAFloodOfComplaintsShort) {
  replace_gnuplot("head -c 1000000 /dev/zero | tr '\\0' 'x' >&2; exit 2");
  EXPECT_LT(complaint().size(), 700U);
}

}  // namespace
}  // namespace nlmech::scene::plot_test
