#include "nlmech/scene/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::gnuplot_test {
namespace {

namespace fs = std::filesystem;
using tests::put;
using tests::TemporaryFolder;

/// A folder with style, template and data; and programs named gnuplot, where a test wants its own.
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

  std::string draw_line(const std::string& template_name = "line", const std::string& data = "results/a.csv",
                        const std::string& heading = "A line", PictureFormat format = PictureFormat::svg) {
    put_style(folder_ / "out");
    const Figure figure{Table({{"x"}}), template_name, {{"heading", heading}}};
    put(folder_ / "out/results/a.gp", gnuplot_script(figure, data));
    return draw(folder_ / "out", "results/a.gp", format);
  }
  /// What is said by a drawing that fails; "" if it does not.
  std::string complaint(const std::string& template_name = "line") {
    try {
      static_cast<void>(draw_line(template_name));
      return "";
    } catch (const Failure& failure) {
      return failure.what();
    }
  }
  /// The next drawings are made by this shell script.
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
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("<path"), std::string::npos);
  EXPECT_NE(svg.find("A line"), std::string::npos);
  EXPECT_EQ(svg.find(folder_.string()), std::string::npos) << "a path of the machine in a picture";
  EXPECT_EQ(draw_line(), svg);
}

TEST_F(Draw, GivesAPngWhereTheStyleKnowsHow) {
  put(folder_ / "figures/style.gp",
      "if (exists('png')) { set terminal pngcairo size 400,300 } else { set terminal svg }\nset datafile "
      "separator ','\n");
  const std::string png = draw_line("line", "results/a.csv", "A line", PictureFormat::png);
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n")) << png.substr(0, 8);
  EXPECT_NE(png.find("IEND"), std::string::npos);
}

TEST_F(Draw, PassesQuotesOnToTheTemplate) {
  EXPECT_NE(draw_line("line", "results/a.csv", "Williams' toggle; \"x\"").find("Williams' toggle; "),
            std::string::npos);
}

TEST_F(Draw, FindsDataWithAQuoteInTheirName) {
  put(folder_ / "out/results/it's.csv", "0,1\n1,3\n");
  EXPECT_NE(draw_line("line", "results/it's.csv").find("<path"), std::string::npos);
}

// Continuous integration and cron run in the C locale, in which gnuplot cannot say "degree" without a
// warning.
TEST_F(Draw, IsTheSameInEveryLocale) {
  put(folder_ / "figures/style.gp", "set terminal svg\nset encoding utf8\nset datafile separator ','\n");
  std::map<std::string, std::string> pictures;
  for (const char* locale : {"C", "C.UTF-8", "de_DE.UTF-8"}) {
    ::setenv("LC_ALL", locale, 1);
    pictures[locale] = draw_line("line", "results/a.csv", "\xcf\x86 in \xc2\xb0");
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

TEST_F(Draw, NamesTheTemplateThatIsMissing) {
  EXPECT_EQ(complaint("circle"), (folder_ / "figures/templates/circle.gp").string() + ": no such template");
}

TEST_F(Draw, SaysThatGnuplotIsMissing) {
  ::setenv("PATH", folder_.string().c_str(), 1);
  EXPECT_EQ(complaint(), "gnuplot: cannot be started: No such file or directory");
}

TEST_F(Draw, SaysThatGnuplotIsMissingWithAnEmptyPath) {
  ::setenv("PATH", "", 1);
  EXPECT_EQ(complaint(), "gnuplot: cannot be started: No such file or directory");
}

TEST_F(Draw, PassesOnWhyGnuplotFailed) {
  put(folder_ / "figures/templates/line.gp", "plot no_such_function(x)\n");
  const std::string said = complaint();
  EXPECT_NE(said.find("gnuplot ended with 1: "), std::string::npos) << said;
  EXPECT_NE(said.find("undefined function"), std::string::npos) << said;
}

TEST_F(Draw, FailsWithoutData) {
  fs::remove(folder_ / "out/results/a.csv");
  EXPECT_NE(complaint().find("gnuplot"), std::string::npos);
}

TEST_F(Draw, DoesNotLetAWarningPass) {
  put(folder_ / "out/results/a.csv", "nothing,here\nis,a number\n");
  const std::string said = complaint();
  EXPECT_NE(said.find("gnuplot"), std::string::npos) << "an empty frame was accepted";
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
}  // namespace nlmech::scene::gnuplot_test
