/// `integrators integrate --states` and `merge`: rows are what single runs print, in any division.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>

#include "nlmech/scene/program/files.hpp"
#include "tests/chapters/integrators/run.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::integrators_states_test {
namespace {

using integrators_commands_test::integrators;
using integrators_commands_test::Words;
using scene::Finished;
using tests::TemporaryFolder;

std::string output(const Words& words, const std::string& folder) {
  const Finished f = integrators(words, folder);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  return f.output;
}

void refused(const Words& words, const std::string& folder, const Words& named) {
  const Finished f = integrators(words, folder);
  EXPECT_EQ(f.exit_code, 2) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string& part : named)
    EXPECT_NE(f.errors.find(part), std::string::npos) << part << "\n" << f.errors;
}

// Unknowns and a parameter by name, the oscillator's own start for what is not given, a name handed on.
TEST(States, RowsAreRuns) {
  const TemporaryFolder folder;
  std::string text = "w,name,x\n";
  for (int i = 0; i < 40; ++i) text += fmt::format("{},\"run, {}\",{}\n", 1 + 0.1 * i, i, 0.5 + i);
  scene::write_whole(folder / "starts.csv", text);
  const Words words = {"integrate", "--equation", "x'' + w^2 x = 0; w = 1; x(0) = 1; x'(0) = 0",
                       "--states",  "starts.csv", "--until",
                       "3",         "--every",    "1.5",
                       "--method",  "dop853"};
  const std::string whole = output(words, folder.string());
  const auto records = scene::parse_csv(whole, "output");
  EXPECT_EQ(records.at(0).cells, (Words{"row", "t", "x", "x'", "name", "status"}));
  ASSERT_EQ(records.size(), 121U);
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Words& cells = records[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k) + 1].cells;
      const double t = 1.5 * k, w = 1 + 0.1 * i, x = 0.5 + i;
      EXPECT_EQ(cells[0], std::to_string(i + 1));
      EXPECT_EQ(std::stod(cells[1]), t);
      EXPECT_NEAR(std::stod(cells[2]) / x, std::cos(w * t),
                  1e-6);  // a tolerance of 1e-9 a step, some dozens of them
      EXPECT_EQ(cells[4], fmt::format("run, {}", i));
      EXPECT_EQ(cells[5], "success");
    }
  }
  // The bytes of one run: by one thread, by the row itself, by shards.
  Words more = words;
  more.insert(more.end(), {"--threads", "1"});
  EXPECT_EQ(output(more, folder.string()), whole);
  const std::string alone =
      output({"integrate", "--equation", "x'' + w^2 x = 0; w = 1; x(0) = 1; x'(0) = 0", "--set", "w=1.1",
              "--initial", "x=1.5", "--until", "3", "--method", "dop853"},
             folder.string());
  const auto single = scene::parse_csv(alone, "output");
  EXPECT_EQ(single.at(2).cells[1], records[6].cells[2]);
  Words merge = {"merge"};
  for (int k = 3; k >= 1; --k) {
    Words part = words;
    part.insert(part.end(), {"--shard", fmt::format("{}/3", k)});
    scene::write_whole(folder / fmt::format("{}.csv", k), output(part, folder.string()));
    merge.push_back(fmt::format("{}.csv", k));
  }
  EXPECT_EQ(output(merge, folder.string()), whole);
  merge.pop_back();
  refused(merge, folder.string(), {"shards 1 of 3 are missing"});
}

// x' = x^2 from 1 ends at t = 1, from 1/4 at 4.
TEST(States, FailuresAreTheirOwn) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "x,tag\n1,a\n0.25,b\n");
  const Finished f = integrators({"integrate", "--equation", "x' = x^2; x(0) = 1", "--states", "starts.csv",
                                  "--until", "2", "--method", "ode45"},
                                 folder.string());
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_NE(f.errors.find("1 of the runs failed; the first is row 1"), std::string::npos) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[1].cells[3], "a");
  EXPECT_NE(records[1].cells[4], "success");
  EXPECT_EQ(records[3].cells[4], "success");
  EXPECT_NEAR(std::stod(records[3].cells[2]), 0.5, 1e-7);  // 1/(4 - 2)
}

// Series moves several rows in a register: each is what its own run prints, with events and ends of its own,
// and whatever stands beside; a row that fails, too.
// A pulse after a rest, which is met by no step that is much longer than it: side by side by series, one by
// one by others, alone. The area is that of exp(-s^2) times a.
TEST(States, StepsKeepToTheirBound) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "a\n1\n2\n3\n");
  const std::string equation = "x' = a exp(-((t-50)/0.5)^2); a = 1; x(0) = 0";
  for (const std::string method : {"series", "dop853"}) {
    const std::string text = output({"integrate", "--equation", equation, "--states", "starts.csv",
                                     "--method", method, "--until", "100", "--largest-step", "0.5"},
                                    folder.string());
    const auto lines = scene::parse_csv(text, "output");
    ASSERT_EQ(lines.size(), 7U);
    for (std::size_t a = 1; a <= 3; ++a)
      EXPECT_NEAR(std::stod(lines[2 * a].cells.at(2)), static_cast<double>(a) * 0.88622692545275801, 4e-7);
  }
}

TEST(States, SeriesSideBySide) {
  const TemporaryFolder folder;
  std::string text = "x,a,until\n";
  for (int i = 0; i < 25; ++i) text += fmt::format("{},{},{}\n", 0.5 + 0.1 * i, 1 + i % 3, 1 + 0.4 * i);
  text += "3,-9,1\n";  // x'' + 0.1 x' = 9 x^3 is infinite near t = 0.2
  scene::write_whole(folder / "starts.csv", text);
  const std::string equation = "x'' + 0.1 x' + a x^3 = 0; a = 1; x(0) = 1; x'(0) = 0";
  const Words words = {"integrate", "--equation", equation, "--states",    "starts.csv", "--method",
                       "series",    "--event",    "x=0",    "--no-verify", "--threads"};
  const auto by = [&](const std::string& threads) {
    Words all = words;
    all.push_back(threads);
    const Finished f = integrators(all, folder.string());
    EXPECT_EQ(f.exit_code, 1);
    EXPECT_NE(f.errors.find("1 of the runs failed; the first is row 26"), std::string::npos) << f.errors;
    return f.output;
  };
  const std::string whole = by("1");
  EXPECT_EQ(by("3"), whole);
  std::string rows = "row,t,x,x',event,status\n";
  for (int i = 0; i < 25; ++i) {
    const std::string alone =
        output({"integrate", "--equation", equation, "--method", "series", "--event", "x=0", "--no-verify",
                "--initial", fmt::format("x={}", 0.5 + 0.1 * i), "--set", fmt::format("a={}", 1 + i % 3),
                "--until", fmt::format("{}", 1 + 0.4 * i)},
               folder.string());
    const auto lines = scene::parse_csv(alone, "output");
    for (std::size_t k = 1; k < lines.size(); ++k)
      rows += fmt::format("{},{},success\n", i + 1, fmt::join(lines[k].cells, ","));
  }
  EXPECT_EQ(whole.substr(0, rows.size()), rows);
  EXPECT_EQ(whole.substr(rows.size()).substr(0, 7), "26,,,,,");
}

// Ends stand in the file or on the command line, not in both, and a parameter of that name is a parameter.
TEST(States, EndsOfTheirOwn) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "ends.csv", "x,until\n1,1\n2,-1\n");
  scene::write_whole(folder / "none.csv", "x\n1\n");
  const Words start = {"integrate", "--equation", "x' = -x", "--initial", "x=1", "--states"};
  const auto with = [&](Words more) {
    more.insert(more.begin(), start.begin(), start.end());
    return more;
  };
  const auto records = scene::parse_csv(output(with({"ends.csv"}), folder.string()), "output");
  ASSERT_EQ(records.size(), 5U);
  EXPECT_EQ(records[4].cells[1], "-1");
  EXPECT_NEAR(std::stod(records[2].cells[2]), std::exp(-1), 1e-8);     // a tolerance of 1e-9 a step
  EXPECT_NEAR(std::stod(records[4].cells[2]), 2 * std::exp(1), 1e-7);  // the same of 5.4
  refused(with({"ends.csv", "--until", "2"}), folder.string(), {"--until 2", "ends.csv has a column until"});
  refused(with({"none.csv"}), folder.string(), {"none.csv", "no column until"});
  refused(with({"ends.csv", "--every", "1e-8"}), folder.string(), {"ends.csv: line 2", "--every 1e-08"});
  refused({"integrate", "--equation", "x' = -x", "--initial", "x=1"}, folder.string(), {"--until"});
  const std::string named = output({"integrate", "--equation", "x' = -until*x; until = 1", "--initial", "x=1",
                                    "--states", "ends.csv", "--until", "3"},
                                   folder.string());
  EXPECT_EQ(scene::parse_csv(named, "output").at(2).cells[1], "3");
}

// No column of the answer is there twice, and X is not x.
TEST(States, ColumnsThatTheAnswerHasAlready) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "row,\"t\",x,X,status,\n7,5,2,3,success,\n");
  const Words words = {"integrate", "--equation", "x' = -x", "--states", "starts.csv", "--until", "1"};
  const auto records = scene::parse_csv(output(words, folder.string()), "output");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0].cells,
            (Words{"row", "t", "x", "input_row", "input_t", "X", "input_status", "status"}));
  EXPECT_NEAR(std::stod(records[2].cells[2]), 2 * std::exp(-1), 1e-8);  // a tolerance of 1e-9 a step
  scene::write_whole(folder / "starts.csv", "x\n");
  const Finished f = integrators(words, folder.string());
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_EQ(f.output, "row,t,x,status\n");
  EXPECT_NE(f.errors.find("starts.csv: no row stands behind the header"), std::string::npos) << f.errors;
  scene::write_whole(folder / "starts.csv", "1\n2\n");
  refused(words, folder.string(), {"starts.csv: line 1", "does not name the columns", "some of x,until"});
}

// What is not done in time says so in its row.
TEST(States, LimitEndsWhatIsNotDone) {
  const TemporaryFolder folder;
  std::string text = "x\n";
  for (int i = 0; i < 50; ++i) text += fmt::format("{}\n", i);
  scene::write_whole(folder / "starts.csv", text);
  const Finished f = integrators({"integrate", "--equation", "x' = -x", "--initial", "x=1", "--states",
                                  "starts.csv", "--until", "2", "--method", "ode45", "--limit", "1e-9"},
                                 folder.string());
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_NE(f.errors.find("50 of the runs failed; the first is row 1"), std::string::npos) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 51U);
  for (std::size_t i = 1; i < records.size(); ++i) EXPECT_EQ(records[i].cells.back(), "time_limit");
}

// A run of many is held to what a single run is held to, with as much time for it. Robertson's reactions by
// series come to 0.33687370, where four other methods agree on 0.3368745.
TEST(States, VerifiedAsSingleRunsAre) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "a\n1\n");
  const Finished row =
      integrators({"integrate", "--file", NLMECH_SOURCE_DIR "/chapters/integrators/examples/robertson.ode",
                   "--until", "1000", "--method", "series", "--states", "starts.csv"},
                  folder.string());
  EXPECT_EQ(row.exit_code, 1);
  EXPECT_NE(row.errors.find("not_converged: series: verified by integration"), std::string::npos)
      << row.errors;
}

// An initial state is asked for if an unknown has no column.
TEST(States, NoInitialStateWhereAllUnknownsHaveColumns) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "v,x,a\n1,2,1\n0,1,3\n");
  const Words words = {"integrate", "--equation", "x' = -a*x; v' = 0; a = 2", "--states", "starts.csv",
                       "--until",   "1"};
  const auto rows = scene::parse_csv(output(words, folder.string()), "output");
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_NEAR(std::stod(rows[2].cells[2]), 2 * std::exp(-1), 1e-8);  // a tolerance of 1e-9 a step
  EXPECT_NEAR(std::stod(rows[4].cells[2]), std::exp(-3), 1e-8);
  scene::write_whole(folder / "starts.csv", "x\n2\n");
  refused(words, folder.string(), {"an initial value is missing", "v="});
}

// Without --method: what suits the first row to the farthest end, not a run of no length.
TEST(States, MethodForTheFarthestEnd) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "ends.csv", "a,until\n1,0\n1,1000\n");
  scene::write_whole(folder / "starts.csv", "a\n1\n");
  const Words words = {"integrate", "--file",
                       NLMECH_SOURCE_DIR "/chapters/integrators/examples/robertson.ode", "--states"};
  Words own = words, common = words;
  own.emplace_back("ends.csv");
  common.insert(common.end(), {"starts.csv", "--until", "1000"});
  const auto a = scene::parse_csv(output(own, folder.string()), "output"),
             b = scene::parse_csv(output(common, folder.string()), "output");
  EXPECT_EQ(a.back().cells.at(2), b.back().cells.at(2));
}

// Runs that came to their ends when the time of all was over are not taken for verified ones.
TEST(States, NoTimeToVerifyIsNoSuccess) {
  const TemporaryFolder folder;
  std::string text = "u\n";
  for (int i = 0; i < 300; ++i) text += fmt::format("{}\n", 0.01 * i + 1);
  scene::write_whole(folder / "starts.csv", text);
  const Finished f = integrators({"integrate", "--problem", "lorenz", "--states", "starts.csv", "--until",
                                  "300", "--method", "series", "--limit", "0.05"},
                                 folder.string());
  EXPECT_EQ(f.exit_code, 1);
  for (const auto& record : scene::parse_csv(f.output, "output")) EXPECT_NE(record.cells.back(), "success");
}

// Parts by settings that differ in a late digit, or in whether they are verified, are parts of different
// runs.
TEST(States, PartsOfOtherSettingsAreRefused) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "starts.csv", "x\n1\n2\n");
  const auto part = [&](const std::string& shard, Words settings) {
    Words words = {"integrate",  "--equation", "x' = -x", "--initial", "x=1", "--states",
                   "starts.csv", "--until",    "1",       "--shard",   shard};
    words.insert(words.end(), settings.begin(), settings.end());
    const std::string file = fmt::format("{}.csv", shard.substr(0, 1));
    scene::write_whole(folder / file, output(words, folder.string()));
  };
  part("1/2", {"--method", "rk4", "--step", "0.01"});
  for (const Words& other : {Words{"--method", "rk4", "--step", "0.0100000004"},
                             Words{"--method", "rk4", "--step", "0.01", "--no-verify"}}) {
    part("2/2", other);
    refused({"merge", "1.csv", "2.csv"}, folder.string(), {"2.csv"});
  }
  part("2/2", {"--method", "rk4", "--step", "0.01"});
  EXPECT_EQ(output({"merge", "1.csv", "2.csv"}, folder.string()).substr(0, 16), "row,t,x,status\n1");
}

TEST(States, BadInputIsNamed) {
  const TemporaryFolder folder;
  scene::write_whole(folder / "bad.csv", "u,r\n1,2\n3,x\n");
  scene::write_whole(folder / "foreign.csv", "p,q\n1,2\n");
  const Words start = {"integrate", "--problem", "lorenz", "--until", "1"};
  const auto with = [&](Words more, const Words& named) {
    more.insert(more.begin(), start.begin(), start.end());
    refused(more, folder.string(), named);
  };
  with({"--states", "bad.csv"}, {"bad.csv", "line 3, column 2 (r)", "'x'"});
  with({"--states", "foreign.csv"}, {"foreign.csv", "none of its columns", "sigma"});
  with({"--states", "bad.csv", "--plot", "a.svg"}, {"--plot a.svg"});
  with({"--states", "-", "--shard", "1/2"}, {"standard input"});
  with({"--threads", "2"}, {"--threads 2", "--states"});
  with({"--shard", "1/2"}, {"--shard 1/2", "--states"});
}

}  // namespace
}  // namespace nlmech::integrators_states_test
