/// What `run` leaves on disk, and what it leaves when something goes wrong.
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "tests/places.hpp"
#include "tests/scene/fixture_program.hpp"

namespace nlmech::tests::scenes_on_disk_test {
namespace {

namespace fs = std::filesystem;
using ScenesOnDisk = FixtureProgram;
using Names = std::set<std::string>;

Names names(const std::map<std::string, std::string>& files) {
  Names names;
  for (const auto& [name, bytes] : files) names.insert(name);
  return names;
}

Names runs_of(const std::string& provenance) {
  const auto json = nlohmann::json::parse(provenance);
  Names runs;
  for (const auto& run : json.at("runs")) runs.insert(run.at("name"));
  return runs;
}

TEST_F(ScenesOnDisk, AreTheFilesOfTheSceneAlone) {
  EXPECT_EQ(fixture({"run", "fig-1", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(names(written("a")), (Names{"figures/fixture/fig-1.svg", "results/fixture/fig-1.csv",
                                        "results/fixture/fig-1.gp", "results/fixture/fig-1.json"}));
  EXPECT_EQ(fixture({"run", "table-1", "--out", "b"}).exit_code, 0);
  EXPECT_EQ(names(written("b")), (Names{"results/fixture/table-1.json", "tables/fixture/table-1.csv",
                                        "tables/fixture/table-1.md"}));
  EXPECT_EQ(fixture({"run", "both", "both", "--out", "c"}).exit_code, 0);
  EXPECT_EQ(names(written("c")),
            (Names{"figures/fixture/both.svg", "results/fixture/both.csv", "results/fixture/both.gp",
                   "results/fixture/both.json", "tables/fixture/both.csv", "tables/fixture/both.md"}));
  EXPECT_EQ(fixture({"run", "both", "--no-plots", "--out", "d"}).exit_code, 0);
  EXPECT_EQ(names(written("d")),
            (Names{"results/fixture/both.csv", "results/fixture/both.gp", "results/fixture/both.json",
                   "tables/fixture/both.csv", "tables/fixture/both.md"}));
}

TEST_F(ScenesOnDisk, KeepADotInTheNameOfTheScene) {
  EXPECT_EQ(fixture({"run", "fig-3.14"}).exit_code, 0);
  EXPECT_EQ(names(written()), (Names{"figures/fixture/fig-3.14.svg", "results/fixture/fig-3.14.csv",
                                     "results/fixture/fig-3.14.gp", "results/fixture/fig-3.14.json"}));
}

TEST_F(ScenesOnDisk, GoIntoTheCurrentFolderByDefault) {
  EXPECT_EQ(fixture({"run", "--all", "--quick"}).exit_code, 0);
  EXPECT_EQ(written().size(), 21U);
}

TEST_F(ScenesOnDisk, OfACheckThatDrawsAreThoseOfARun) {
  EXPECT_EQ(fixture({"run", "--all", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(fixture({"check", "--draw", "--out", "b"}).exit_code, 0);
  auto checked = written("b");
  EXPECT_EQ(checked.erase("results/fixture/check.csv"), 1U);
  EXPECT_EQ(checked, written("a"));
}

TEST_F(ScenesOnDisk, AreTheSameByteForByteInASecondRun) {
  for (const char* out : {"a", "b"}) EXPECT_EQ(fixture({"run", "--all", "--out", out}).exit_code, 0);
  EXPECT_EQ(written("a"), written("b"));
  EXPECT_EQ(written("a").size(), 21U);
}

TEST_F(ScenesOnDisk, DoNotDependOnWhichOthersRan) {
  EXPECT_EQ(fixture({"run", "--all", "--out", "all"}).exit_code, 0);
  EXPECT_EQ(fixture({"run", "fig-2", "--out", "one"}).exit_code, 0);
  const auto all = written("all");
  for (const auto& [name, bytes] : written("one")) EXPECT_EQ(bytes, all.at(name)) << name;
}

TEST_F(ScenesOnDisk, NameExactlyTheRunsBehindThem) {
  EXPECT_EQ(fixture({"run", "--all", "--quick"}).exit_code, 0);
  const auto files = written();
  EXPECT_EQ(runs_of(files.at("results/fixture/fig-1.json")), (Names{"counted"}));
  EXPECT_EQ(runs_of(files.at("results/fixture/fig-2.json")), (Names{"counted", "squared", "summed"}));
  EXPECT_EQ(runs_of(files.at("results/fixture/table-1.json")), (Names{"alone", "counted", "squared"}));
  EXPECT_EQ(runs_of(files.at("results/fixture/both.json")), (Names{"counted"}));
  EXPECT_EQ(runs_of(files.at("results/fixture/fig-3.14.json")), (Names{"counted", "squared"}));
}

TEST_F(ScenesOnDisk, HoldNoPathOfTheMachine) {
  EXPECT_EQ(fixture({"run", "--all", "--quick", "--out", (folder_ / "out").string()}).exit_code, 0);
  for (const auto& [name, bytes] : written("out")) {
    for (const std::string& path :
         {std::string(NLMECH_SOURCE_DIR), std::string(NLMECH_BINARY_DIR), folder_.string()}) {
      EXPECT_EQ(bytes.find(path), std::string::npos) << name << " holds " << path;
    }
  }
}

TEST_F(ScenesOnDisk, KeepTheirDataWithoutGnuplot) {
  const Finished done = fixture({"run", "--all", "--quick"}, {"PATH=" + folder_.string()});
  EXPECT_EQ(done.exit_code, 1);
  for (const char* figure : {"fig-1", "fig-2", "both", "fig-3.14"}) {
    expect_sentence(done.errors, std::string("fixture: ") + figure);
    EXPECT_TRUE(written().contains(std::string("results/fixture/") + figure + ".csv")) << figure;
  }
  expect_sentence(done.errors, "gnuplot: cannot be started: No such file or directory");
  EXPECT_EQ(written().size(), 17U) << "all but the four pictures";
}

TEST_F(ScenesOnDisk, KeepNoOldPictureBesideNewData) {
  EXPECT_EQ(fixture({"run", "fig-1", "--quick"}).exit_code, 0);
  EXPECT_EQ(fixture({"run", "fig-1"}, {"PATH=" + folder_.string()}).exit_code, 1);
  EXPECT_FALSE(written().contains("figures/fixture/fig-1.svg"));
}

TEST_F(ScenesOnDisk, AreNotDrawnAgainFromTheSame) {
  const TemporaryFolder data;
  fs::copy(data_, data.path(), fs::copy_options::recursive);
  data_ = data.path();
  const std::vector<std::string> without_gnuplot = {"PATH=" + folder_.string()};
  const auto drawn_again = [&] { return fixture({"run", "fig-1"}, without_gnuplot).exit_code != 0; };
  for (const std::string changed : {"figures/style.gp", "figures/templates/fixture-line.gp"}) {
    EXPECT_EQ(fixture({"run", "fig-1"}).exit_code, 0);
    EXPECT_FALSE(drawn_again());
    put(data / changed, bytes_of(data / changed) + "# a remark\n");
    EXPECT_TRUE(drawn_again()) << changed;
  }
}

TEST_F(ScenesOnDisk, KeepTheSvgWhenThePngFails) {
  const TemporaryFolder data;
  fs::copy(data_, data.path(), fs::copy_options::recursive);
  put(data / "figures/style.gp",
      "if (exists('png')) { exit status 2 }\n" + bytes_of(data_ / "figures/style.gp"));
  data_ = data.path();
  const Finished done = fixture({"run", "fig-1", "--png"});
  EXPECT_EQ(done.exit_code, 1);
  expect_sentence(done.errors, "fig-1.png");
  EXPECT_TRUE(written().contains("figures/fixture/fig-1.svg"));
}

TEST_F(ScenesOnDisk, DoNotSufferFromOneThatFails) {
  const Finished done = fixture({"run", "--all", "--quick"}, {"FIXTURE_FAULT=run"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.errors, "fixture: fig-2: not_converged: summed stalled at term 3; start nearer\n");
  EXPECT_EQ(written().size(), 17U) << "all but the four of fig-2";
}

TEST_F(ScenesOnDisk, KeepWhatMissesItsPromise) {
  EXPECT_EQ(fixture({"run", "fig-1"}, {"FIXTURE_FAULT=quantity"}).exit_code, 0)
      << "a promise is for `check` to hold";
  const auto json = nlohmann::json::parse(written().at("results/fixture/fig-1.json"));
  EXPECT_EQ(json.at("quantities")[0].at("passes"), false);
}

TEST_F(ScenesOnDisk, EndWithASentenceWhereTheyCannotBeWritten) {
  put(folder_ / "file", "in the way");
  fs::create_directories(folder_ / "occupied/results/fixture/fig-1.csv");
  fs::create_directories(folder_ / "occupied/results/fixture/check.csv");
  for (const std::string out : {"file", "occupied", "/proc/nowhere", "/dev/null"}) {
    for (const std::vector<std::string>& command : {std::vector<std::string>{"run", "fig-1"}, {"check"}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {"--out", out});
      const Finished done = fixture(arguments);
      EXPECT_EQ(done.exit_code, 1) << command[0] << " --out " << out;
      EXPECT_EQ(done.output, "") << command[0] << " --out " << out;
      expect_sentence(done.errors, out);
    }
  }
  EXPECT_EQ(names(written()), Names{"file"}) << "temporary files were left behind";
}

TEST_F(ScenesOnDisk, AreNotDrawnWithoutTheirTemplate) {
  const TemporaryFolder data;
  fs::copy(data_, data.path(), fs::copy_options::recursive);
  fs::remove(data / "figures/templates/fixture-line.gp");
  data_ = data.path();
  const Finished done = fixture({"run", "fig-1", "table-1"});
  EXPECT_EQ(done.exit_code, 1);
  expect_sentence(done.errors, "fixture-line.gp: no such template");
  EXPECT_TRUE(written().contains("tables/fixture/table-1.md"));
}

// Quick and full runs write different bytes into the same files, and are killed at any moment: each file
// there is then holds one or the other, never a part of them.
TEST_F(ScenesOnDisk, AreWholeAfterAKill) {
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(fixture({"run", "--all", "--out", "full"}).exit_code, 0);
  const std::chrono::duration<double> one_run = std::chrono::steady_clock::now() - before;
  EXPECT_EQ(fixture({"run", "--all", "--quick", "--out", "quick"}).exit_code, 0);
  const auto full = written("full"), quick = written("quick");
  EXPECT_NE(full.at("results/fixture/fig-1.csv"), quick.at("results/fixture/fig-1.csv"));

  std::mt19937 random(1);
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    const double seconds = 0.001 + 0.9 * one_run.count() * std::generate_canonical<double, 32>(random);
    const Finished done = shell("timeout -s KILL " + std::to_string(seconds) +
                                " $fixture run --all --out out" + (i % 2 == 0 ? " --quick" : ""));
    killed += done.exit_code == 0 ? 0 : 1;
    for (const auto& [name, bytes] : written("out")) {
      if (fs::path(name).filename().string().starts_with('.')) continue;  // begun under a temporary name
      EXPECT_TRUE(bytes == full.at(name) || bytes == quick.at(name)) << name << " after " << seconds << " s";
    }
  }
  EXPECT_GT(killed, 0) << "no run was killed: this test has seen nothing";
  EXPECT_EQ(fixture({"run", "--all", "--out", "out"}).exit_code, 0);
  auto out = written("out");
  std::erase_if(out,
                [](const auto& file) { return fs::path(file.first).filename().string().starts_with('.'); });
  EXPECT_EQ(out, full) << "and the next run repairs all";
}

}  // namespace
}  // namespace nlmech::tests::scenes_on_disk_test
