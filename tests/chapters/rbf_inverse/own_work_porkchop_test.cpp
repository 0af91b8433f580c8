/// `rbf_inverse porkchop` and `merge` as a user types them, and as a scheduler or GNU parallel does.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/chapters/program_in_folder.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_porkchop_test {
namespace {

namespace fs = std::filesystem;
using scene::Finished;

const std::string program = NLMECH_BINARY_DIR "/bin/rbf_inverse";
/// The file of the chapter's page.
const std::string orbits = NLMECH_SOURCE_DIR "/chapters/rbf_inverse/earth-mars.toml";

class PorkchopCommand : public tests::ProgramInFolder {
 protected:
  PorkchopCommand() : ProgramInFolder(program) {}
  /// As far as the commands of the page see.
  void stand_in_the_source_folder() const {
    fs::create_directory_symlink(NLMECH_BINARY_DIR, folder_ / "build");
    fs::create_directory_symlink(NLMECH_SOURCE_DIR "/chapters", folder_ / "chapters");
  }
};

TEST_F(PorkchopCommand, AnyNumberOfThreadsAndShardsWritesTheSameBytes) {
  const std::string whole = output({"porkchop", orbits, "--grid", "23x31", "--threads", "1"});
  EXPECT_TRUE(whole.starts_with("departure,arrival,v_departure,v_arrival,revolutions\n"));
  for (const char* threads : {"0", "2", "7"})
    EXPECT_EQ(output({"porkchop", orbits, "--grid", "23x31", "--threads", threads}), whole) << threads;
  for (const int shards : {1, 3, 23, 30}) {
    std::vector<std::string> merge = {"merge"};
    for (int k = shards; k >= 1; --k) {  // in any order
      const std::string shard = std::to_string(k) + "/" + std::to_string(shards);
      merge.push_back("part-" + std::to_string(k) + ".csv");
      write(merge.back(),
            output({"porkchop", orbits, "--grid", "23x31", "--shard", shard, "--threads", "2"}));
    }
    EXPECT_EQ(output(merge), whole) << shards;
  }
}

// Summer of 2003, recorded over continuous times by other code: 5669.373 m/s in all, leaving 1253.40 days
// and arriving 1457.10 days after J2000. The grid has steps of 5 days and is above by less than a thousandth,
// since the cost is flat there.
TEST_F(PorkchopCommand, FindsTheWindowOfSummer2003) {
  const std::string text = output({"porkchop", orbits, "--grid", "51x81"});
  const auto n = scene::parse_numbers(text, "output",
                                      {"departure", "arrival", "v_departure", "v_arrival", "revolutions"});
  double least = HUGE_VAL, leave = 0, arrive = 0;
  for (std::size_t i = 0; i < n.rows(); ++i) {
    const double sum = n.column[2][i] + n.column[3][i];
    if (sum < least) {
      least = sum;
      leave = n.column[0][i] / 86400;
      arrive = n.column[1][i] / 86400;
    }
    EXPECT_GE(n.column[1][i], n.column[0][i]);
  }
  EXPECT_GE(least, 5669.373);
  EXPECT_LE(least, 5669.373 * (1 + 2e-3));
  EXPECT_NEAR(leave, 1253.40, 5);
  EXPECT_NEAR(arrive, 1457.10, 5);
}

TEST_F(PorkchopCommand, DrawsThePictureInTheCurrentFolder) {
  write("two.toml",
        "mu = 1\n[from]\na = 1\ne = 0\n[to]\nposition = [0, 2, 0]\nvelocity = [-0.7, 0, 0.1]\n"
        "[departures]\nfirst = 0\nlast = 6\n[arrivals]\nfirst = 4\nlast = 16\n");
  const std::string plain = output({"porkchop", "two.toml", "--grid", "20x20"});
  EXPECT_EQ(output({"porkchop", "two.toml", "--grid", "20x20", "--plot"}), plain);
  EXPECT_NE(scene::read_whole(folder_ / "two.svg").find("</svg>"), std::string::npos);
  refused({"porkchop", "two.toml", "--grid", "20x20", "--plot", "--shard", "1/2"}, {"--shard 1/2", "--plot"});
}

// The picture is drawn when the numbers are written, over an older picture of this command and nothing else.
TEST_F(PorkchopCommand, NoPictureCostsNumbersOrFiles) {
  const std::string text = scene::read_whole(orbits);
  write("input.svg", text);
  refused({"porkchop", "input.svg", "--grid", "5x5", "--plot"}, {"input.svg", "overwrites nothing else"});
  EXPECT_EQ(scene::read_whole(folder_ / "input.svg"), text);
  write("two.toml", text);
  write("two.svg", "<svg>of somebody else</svg>\n");
  refused({"porkchop", "two.toml", "--grid", "5x5", "--plot"}, {"two.svg"});
  fs::remove(folder_ / "two.svg");
  const std::string plain = output({"porkchop", "two.toml", "--grid", "5x5"});
  for (int k = 0; k < 2; ++k) EXPECT_EQ(output({"porkchop", "two.toml", "--grid", "5x5", "--plot"}), plain);
  EXPECT_TRUE(fs::exists(folder_ / "two.svg"));
  refused({"porkchop", "two.toml", "--grid", "3x9", "--plot"}, {"--grid 3x9", "4x4"});
  // gnuplot is not there: the numbers are.
  const Finished f = scene::run_program(
      {"/usr/bin/env", "PATH=/nowhere", program, "porkchop", "two.toml", "--grid", "5x5", "--plot"}, folder_);
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.output, plain);
  EXPECT_NE(f.errors.find("all numbers are written"), std::string::npos) << f.errors;
}

TEST_F(PorkchopCommand, MergeRefusesWhatIsNotOneWholeGrid) {
  const auto part = [&](const std::string& shard, const std::string& grid = "8x6") {
    return output({"porkchop", orbits, "--grid", grid, "--shard", shard});
  };
  write("1.csv", part("1/3"));
  write("2.csv", part("2/3"));
  write("3.csv", part("3/3"));
  EXPECT_EQ(run({"merge", "1.csv", "2.csv", "3.csv"}).exit_code, 0);
  refused({"merge", "1.csv", "3.csv"}, {"shards 2 of 3 are missing"});
  refused({"merge", "1.csv", "2.csv", "3.csv", "2.csv"}, {"2.csv", "shard 2 / 3", "already"});
  write("other.csv", part("2/3", "8x7"));
  refused({"merge", "1.csv", "other.csv", "3.csv"}, {"other.csv, line 1", "8 x 7", "no part"});
  write("halves.csv", part("2/2"));
  refused({"merge", "1.csv", "halves.csv"}, {"halves.csv, line 1", "shard 2 / 2"});
  // The same grid of other orbits.
  std::string text = scene::read_whole(orbits);
  text.replace(text.find("0.0933941"), 9, "0.0933942");
  write("other.toml", text);
  write("foreign.csv", output({"porkchop", "other.toml", "--grid", "8x6", "--shard", "2/3"}));
  refused({"merge", "1.csv", "foreign.csv", "3.csv"}, {"foreign.csv, line 1", "no part"});
  // A whole grid, a file of something else, and none.
  write("whole.csv", output({"porkchop", orbits, "--grid", "8x6"}));
  refused({"merge", "whole.csv"}, {"whole.csv, line 1", "departure,arrival"});
  write("empty.csv", "");
  refused({"merge", "empty.csv"}, {"empty.csv, line 1"});
  refused({"merge", "absent.csv"}, {"absent.csv"});
  // A writer that was killed; a number that was changed; rows that changed places.
  const std::string second = part("2/3");
  write("2.csv", second.substr(0, second.rfind('\n', second.size() - 2) + 1));
  refused({"merge", "1.csv", "2.csv", "3.csv"}, {"2.csv", "announces"});
  const std::size_t at = second.rfind('\n', second.size() - 2) + 1;
  write("2.csv", second.substr(0, at) + "x" + second.substr(at));
  refused({"merge", "1.csv", "2.csv", "3.csv"}, {"2.csv", "line", "'x"});
  const std::size_t before = second.rfind('\n', at - 2) + 1;
  write("2.csv", second.substr(0, before) + second.substr(at) + second.substr(before, at - before));
  refused({"merge", "1.csv", "2.csv", "3.csv"}, {"2.csv, line", "do not come after"});
}

TEST_F(PorkchopCommand, WrongWordsAreNamed) {
  for (const char* grid : {"5", "x", "0x5", "5x-1", "5x2.5", "5x", "1e9x2", "nanx3"})
    refused({"porkchop", orbits, "--grid", grid}, {"--grid"});
  for (const char* shard : {"2", "0/2", "3/2", "1/0", "a/b", "1/2/3"})
    refused({"porkchop", orbits, "--grid", "4x4", "--shard", shard}, {"--shard"});
  refused({"porkchop", orbits, "--grid", "4x4", "--threads", "-2"}, {"--threads -2"});
  refused({"porkchop", orbits, "--grid", "50000x50000"}, {"earth-mars.toml", "50000 x 50000"});
  refused({"porkchop", "absent.toml", "--grid", "4x4"}, {"absent.toml"});
}

TEST_F(PorkchopCommand, WrongFilesAreNamedByLineAndValue) {
  const std::string start = "mu = 1\n[from]\na = 1\ne = 0.1\n", goal = "[to]\na = 2\ne = 0\n",
                    windows = "[departures]\nfirst = 0\nlast = 6\n[arrivals]\nfirst = 4\nlast = 16\n";
  const auto bad = [&](const std::string& text, const std::vector<std::string>& named) {
    write("bad.toml", text);
    std::vector<std::string> all = named;
    all.emplace_back("bad.toml");
    refused({"porkchop", "bad.toml", "--grid", "4x4"}, all);
  };
  write("bad.toml", start + goal + windows);
  EXPECT_EQ(run({"porkchop", "bad.toml", "--grid", "4x4"}).exit_code, 0);
  bad("mu = = 1\n", {"line 1"});
  bad("mu = 1\n" + goal + windows, {"[from]"});
  bad(goal + windows, {"mu is missing"});
  bad("mu = -1\n[from]\na = 1\ne = 0\n" + goal + windows, {"line 1", "mu = -1"});
  bad("mu = \"one\"\n[from]\na = 1\ne = 0\n" + goal + windows, {"line 1", "one"});
  bad("mu = nan\n[from]\na = 1\ne = 0\n" + goal + windows, {"line 1", "nan"});
  bad("mu = 1\n[from]\na = 1\ne = -0.5\n" + goal + windows, {"line 4", "-0.5"});
  bad("mu = 1\n[from]\na = -1\ne = 0.5\n" + goal + windows, {"line 3", "from.a = -1"});
  bad("mu = 1\n[from]\na = 1\ne = 1\n" + goal + windows, {"line 3", "from.a = 1"});
  bad("mu = 1\n[from]\na = 1\np = 1\ne = 0\n" + goal + windows, {"one of from.a and from.p"});
  bad("mu = 1\n[from]\np = -1\ne = 0\n" + goal + windows, {"line 3", "-1"});
  bad(start + "[to]\nposition = [1, 2]\nvelocity = [0, 1, 0]\n" + windows, {"line 6", "to.position"});
  bad(start + "[to]\nposition = [0, 0, 0]\nvelocity = [0, 1, 0]\n" + windows, {"line 6", "to.position"});
  bad(start + "[to]\nposition = [1, 0, inf]\nvelocity = [0, 1, 0]\n" + windows, {"line 6", "inf"});
  bad(start + "[to]\nposition = [1, 0, 0]\n" + windows, {"to.velocity is missing"});
  bad(start + "[to]\na = 2\ne = 0\nincl = 3\n" + windows, {"line 8", "to.incl"});
  bad(start + "[to]\na = 2\ne = 0\ni = 400\n" + windows, {"line 8", "to.i = 400", "180"});
  bad(start + "[to]\na = 2\ne = 0\ni = -1\n" + windows, {"line 8", "to.i = -1"});
  for (const std::string key : {"raan", "argp", "nu"})
    bad(start + "[to]\na = 2\ne = 0\n" + key + " = 1e6\n" + windows,
        {"line 8", "to." + key + " = 1000000", "360"});
  bad("mu = 1e-200\n[from]\na = 1\ne = 0\n" + goal + windows, {"line 1", "mu", "1e-200"});
  bad(start + "[to]\na = 1e200\ne = 0\n" + windows, {"line 6", "to.a", "1e+200"});
  bad(start + "[to]\nposition = [1e150, 0, 0]\nvelocity = [0, 1, 0]\n" + windows, {"line 6", "to.position"});
  bad(start + goal + "[departures]\nfirst = 6\nlast = 0\n[arrivals]\nfirst = 4\nlast = 16\n",
      {"line 10", "departures.last = 0"});
  bad(start + goal + "[departures]\nfirst = 0\n[arrivals]\nfirst = 4\nlast = 16\n",
      {"departures.last is missing"});
  bad(start + goal + windows + "[other]\n", {"line 14", "other"});
  bad("revolutions = 1.5\n" + start + goal + windows, {"line 1", "1.5"});
  bad("revolutions = -1\n" + start + goal + windows, {"line 1", "-1"});
}

/// The lines of the page between a mark and the end of its block.
std::string block_of_page(const std::string& first) {
  const std::string page = scene::read_whole(NLMECH_SOURCE_DIR "/chapters/rbf_inverse/rbf_inverse.md");
  const std::size_t begin = page.find(first);
  if (begin == std::string::npos) return {};
  return page.substr(begin, page.find("```", begin) - begin);
}

TEST_F(PorkchopCommand, FirstCommandOfThePageDraws) {
  const std::string command = block_of_page("build/bin/rbf_inverse porkchop");
  ASSERT_NE(command.find("--plot"), std::string::npos);
  stand_in_the_source_folder();
  const Finished f = scene::run_program({"sh", "-e", "-c", command}, folder_);
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(scene::read_whole(folder_ / "earth-mars.svg").find("</svg>"), std::string::npos);
}

// The command line of the page, as a reader types it.
TEST_F(PorkchopCommand, GnuParallelRunsThePagesCommandLine) {
  if (scene::run_program({"sh", "-c", "command -v parallel && parallel --version | grep -q GNU"}, folder_)
          .exit_code != 0)
    GTEST_SKIP() << "GNU parallel is not installed: apt-get install parallel";
  const std::string commands = block_of_page("seq 8 | parallel");
  ASSERT_NE(commands.find("--shard"), std::string::npos) << "the page has no line for GNU parallel";
  stand_in_the_source_folder();
  const Finished f = scene::run_program({"sh", "-e", "-c", commands}, folder_);
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(scene::read_whole(folder_ / "grid.csv"), output({"porkchop", orbits, "--grid", "400x400"}));
}

// The job array of the page: its script with the scheduler's variable set by hand.
TEST_F(PorkchopCommand, JobArrayOfThePageNeedsNothingButItsNumber) {
  const std::string script = block_of_page("#SBATCH --array");
  ASSERT_NE(script.find("SLURM_ARRAY_TASK_ID"), std::string::npos) << "the page has no job array";
  stand_in_the_source_folder();
  for (int k = 1; k <= 8; ++k) {
    const Finished f =
        scene::run_program({"sh", "-e", "-c", script}, folder_, {"SLURM_ARRAY_TASK_ID=" + std::to_string(k)});
    ASSERT_EQ(f.exit_code, 0) << f.errors;
  }
  std::vector<std::string> merge = {"merge"};
  for (int k = 1; k <= 8; ++k) merge.push_back("part-" + std::to_string(k) + ".csv");
  EXPECT_EQ(output(merge), output({"porkchop", orbits, "--grid", "400x400"}));
}

}  // namespace
}  // namespace nlmech::own_work_porkchop_test
