/// `two_body_series propagate --states` and `merge` as a user types them, and as a scheduler does.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/chapters/program_in_folder.hpp"
#include "tests/places.hpp"

namespace nlmech::catalogue_test {
namespace {

using scene::Finished;

class StatesCommand : public tests::ProgramInFolder {
 protected:
  StatesCommand() : ProgramInFolder(NLMECH_BINARY_DIR "/bin/two_body_series") {}
  /// Ellipses about mu = 1, with a name that has a comma, columns in an order of its own, and a comment.
  [[nodiscard]] static std::string ellipses(int count) {
    std::string text = "# a comment\n\nname,vx,vy,vz,until,x,y,z,mu\n\n";
    for (int i = 0; i < count; ++i) {
      const double e = 0.8 * i / count;
      text += fmt::format("\"body, {}\",0,{:.17g},0,{:.17g},{:.17g},0,0,1\n", i, std::sqrt((1 + e) / (1 - e)),
                          20 + 0.01 * i, 1 - e);
    }
    return text;
  }
};

// Each row against Kepler's problem in closed form, within what one orbit is held to; names come back as they
// were.
TEST_F(StatesCommand, RowsAreOrbits) {
  write("orbits.csv", ellipses(100));
  const std::string rows = output({"propagate", "--states", "orbits.csv"});
  const auto records = scene::parse_csv(rows, "output");
  ASSERT_EQ(records.size(), 101U);
  EXPECT_TRUE(rows.starts_with("row,t,x,y,z,vx,vy,vz,name,status\n")) << rows.substr(0, 100);
  for (int i = 0; i < 100; ++i) {
    const auto& cells = records[static_cast<std::size_t>(i) + 1].cells;
    ASSERT_EQ(cells.size(), 10U);
    EXPECT_EQ(cells[0], std::to_string(i + 1));
    EXPECT_EQ(cells[8], fmt::format("body, {}", i));
    EXPECT_EQ(cells[9], "success");
    const double e = 0.8 * i / 100, t = 20 + 0.01 * i;
    const orbit::State start{{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
    const auto there = orbit::propagate_kepler(start, t, 1).state;
    EXPECT_EQ(std::stod(cells[1]), t);
    // 16 kappa eps, 8 of them Kepler's.
    const double bound = 16 * 2.3e-16 * orbit::kepler_condition(start, t, 1).position;
    const orbit::Vector3<double> r(std::stod(cells[2]), std::stod(cells[3]), std::stod(cells[4]));
    EXPECT_LE((r - there.position).norm() / there.position.norm(), bound) << i;
  }
  const auto closed =
      scene::parse_csv(output({"propagate", "--states", "orbits.csv", "--method", "kepler"}), "output");
  EXPECT_NEAR(std::stod(closed[7].cells[2]), std::stod(records[7].cells[2]), 1e-12);
}

// The bytes of one run: with any number of threads, from standard input, from shards in any order.
TEST_F(StatesCommand, SameBytesHoweverItIsDivided) {
  write("orbits.csv", ellipses(300));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--every", "3"}, {"--zonal", "1e-3", "--radius", "0.1"}}) {
    std::vector<std::string> words = {"propagate", "--states", "orbits.csv"};
    words.insert(words.end(), more.begin(), more.end());
    const std::string whole = output(words);
    auto threads = words;
    threads.insert(threads.end(), {"--threads", "3"});
    EXPECT_EQ(output(threads), whole);
    for (const int shards : {1, 7, 301}) {
      if (shards > 7 && !more.empty()) continue;
      std::vector<std::string> merge = {"merge"};
      for (int k = shards; k >= 1; --k) {
        auto part = words;
        part.insert(part.end(), {"--shard", fmt::format("{}/{}", k, shards)});
        write(fmt::format("{}.csv", k), output(part));
        merge.push_back(fmt::format("{}.csv", k));
      }
      EXPECT_EQ(output(merge), whole) << shards;
    }
  }
}

TEST_F(StatesCommand, EveryGivesRowsBetween) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n1,0,0,0,1,0\n1,0,0,0,1.2,0\n");
  const auto every = scene::parse_csv(
      output({"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "-5", "--every", "2"}),
      "output");
  ASSERT_EQ(every.size(), 9U);
  for (int k = 0; k < 4; ++k) {
    const auto& cells = every[static_cast<std::size_t>(k) + 1].cells;
    const double t = k == 3 ? -5 : -2. * k;
    EXPECT_EQ(std::stod(cells[1]), t);
    EXPECT_NEAR(std::stod(cells[2]), std::cos(t), 1e-13);
    EXPECT_NEAR(std::stod(cells[3]), std::sin(t), 1e-13);
  }
  const std::string closed = output({"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "-5",
                                     "--every", "2", "--method", "kepler"});
  EXPECT_NE(closed.find("\n1,0,1,0,"), std::string::npos) << closed;
}

// The answer is a file of states itself: its columns come back once, those of the first run under other
// names.
TEST_F(StatesCommand, ItsAnswerIsAFileOfStates) {
  write("orbits.csv", "X,Y,Z,VX,VY,VZ,\n1,0,0,0,1,0,\n");
  const std::vector<std::string> words = {"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "1"};
  const std::string first = output(words);
  EXPECT_TRUE(first.starts_with("row,t,x,y,z,vx,vy,vz,status\n")) << first;
  write("orbits.csv", first);
  const auto records = scene::parse_csv(output(words), "output");
  ASSERT_EQ(records.size(), 2U);
  const std::vector<std::string> header = {
      "row", "t", "x", "y", "z", "vx", "vy", "vz", "input_row", "input_t", "input_status", "status"};
  EXPECT_EQ(records[0].cells, header);
  EXPECT_EQ(records[1].cells[9], "1");
  EXPECT_NEAR(std::stod(records[1].cells[2]), std::cos(2.), 1e-13);  // the state is where the run begins
  write("orbits.csv", "1,0,0,0,1,0\n");
  EXPECT_EQ(output(words), first);
}

TEST_F(StatesCommand, NoRowsAreSaid) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n");
  const Finished f = run({"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "1"});
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_EQ(f.output, "row,t,x,y,z,vx,vy,vz,status\n");
  EXPECT_NE(f.errors.find("orbits.csv: no row stands behind the header"), std::string::npos) << f.errors;
}

// A fall into the centre ends where it does, and the rest goes on.
TEST_F(StatesCommand, FailuresAreTheirOwn) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n1,0,0,0,1,0\n1,0,0,0,0,0\n1,0,0,0,1.1,0\n");
  const Finished f = run({"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "5"});
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_NE(f.errors.find("1 of the orbits failed; the first is row 2: collision"), std::string::npos)
      << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[1].cells[8], "success");
  EXPECT_EQ(records[2].cells[8], "collision");
  EXPECT_NEAR(std::stod(records[2].cells[1]), std::acos(-1.) / std::sqrt(8.), 1e-6);
  EXPECT_EQ(records[3].cells[8], "success");
}

// Rows of few digits say so: of the data after 1e5 revolutions and more, of steps that are too long, which
// Kepler's solution tells.
TEST_F(StatesCommand, RowsOfFewDigitsSayIt) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n1,0,0,0,1.1,0\n1,0,0,0,1.2,0.1\n");
  const auto statuses = [&](const std::vector<std::string>& more, const std::string& says, int exit_code) {
    std::vector<std::string> words = {"propagate", "--states", "orbits.csv", "--mu", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Finished f = run(words);
    EXPECT_EQ(f.exit_code, exit_code) << f.errors;
    EXPECT_NE(f.errors.find(says), std::string::npos) << f.errors;
    std::vector<std::string> found;
    for (const auto& record : scene::parse_csv(f.output, "output")) found.push_back(record.cells.back());
    found.erase(found.begin());
    return found;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(statuses({"--until", "1e12", "--method", "kepler"}, "determine the position", 0),
            Texts({"low_accuracy", "low_accuracy"}));
  EXPECT_EQ(statuses({"--until", "30", "--tolerance", "1e-4"}, "differs from Kepler's solution", 0),
            Texts({"low_accuracy", "low_accuracy"}));
  EXPECT_EQ(statuses({"--until", "300", "--tolerance", "0.1"}, "2 of the orbits failed", 1),
            Texts({"outside_validity", "outside_validity"}));
  EXPECT_EQ(statuses({"--until", "30"}, "", 0), Texts({"success", "success"}));
}

// So many revolutions that no digit is left end the closed form, at the last row that had one.
TEST_F(StatesCommand, ClosedFormKeepsTheTimeThatItReached) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n1,0,0,0,1,0\n");
  for (const std::string sign : {"", "-"}) {
    const Finished f = run({"propagate", "--states", "orbits.csv", "--mu", "1", "--until", sign + "1e14",
                            "--every", "1e12", "--method", "kepler"});
    EXPECT_EQ(f.exit_code, 1);
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_GT(records.size(), 4U);
    ASSERT_LT(records.size(), 90U);
    auto good = records[records.size() - 2].cells, last = records.back().cells;
    EXPECT_EQ(last.back(), "outside_validity");
    EXPECT_EQ(good.back(), "low_accuracy");
    EXPECT_GT(std::abs(std::stod(last[1])), 1e12);
    good.back() = last.back();
    EXPECT_EQ(last, good);
  }
}

// What is not done in time says so in its row; a minute is no bound for a catalogue.
TEST_F(StatesCommand, LimitEndsWhatIsNotDone) {
  write("orbits.csv", ellipses(2000));
  for (const char* method : {"series", "kepler"}) {
    const Finished f = run({"propagate", "--states", "orbits.csv", "--method", method, "--limit", "1e-9"});
    EXPECT_EQ(f.exit_code, 1);
    EXPECT_NE(f.errors.find("time_limit"), std::string::npos) << f.errors;
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_EQ(records.size(), 2001U);
    for (std::size_t i = 1; i < records.size(); ++i) EXPECT_EQ(records[i].cells[9], "time_limit");
  }
  // Zonal orbits of more than 1e8 revolutions each.
  std::string forever = "x,y,z,vx,vy,vz\n";
  for (int i = 0; i < 400; ++i) forever += "1,0,0,0,1.1,0.1\n";
  write("forever.csv", forever);
  const Finished f = run({"propagate", "--states", "forever.csv", "--mu", "1", "--until", "1e9", "--zonal",
                          "1e-3", "--radius", "0.1", "--limit", "0.3", "--threads", "1"});
  EXPECT_EQ(f.exit_code, 1);
  const auto records = scene::parse_csv(f.output, "output");
  ASSERT_EQ(records.size(), 401U) << f.errors;
  for (std::size_t i = 1; i < records.size(); ++i) EXPECT_EQ(records[i].cells[8], "time_limit");
  EXPECT_NE(output({"propagate", "--help"}).find("as long as it takes"), std::string::npos);
}

// Nothing is printed of a file with a mistake, wherever it stands.
TEST_F(StatesCommand, BadInputIsNamed) {
  const std::string head = "x,y,z,vx,vy,vz,until\n", row = "1,0,0,0,1,0,5\n";
  const auto bad = [&](const std::string& text, std::vector<std::string> named,
                       std::vector<std::string> more = {}) {
    write("bad.csv", text);
    named.emplace_back("bad.csv");
    more.insert(more.begin(), {"propagate", "--states", "bad.csv", "--mu", "1"});
    refused(more, named);
  };
  std::string long_one = head;
  for (int i = 0; i < 20000; ++i) long_one += row;
  bad(long_one + "1,0,0,0,one,0,5\n", {"line 20002, column 5 (vy)", "'one'"});
  bad(head + row + "0,0,0,0,1,0,5\n", {"line 3", "x,y,z = 0,0,0", "centre"});
  write("km.csv", head + "7000,0,0,0,7.5,0,5\n");
  refused({"propagate", "--states", "km.csv"}, {"km.csv", "line 2", "--mu"});
  bad(head + "1,0,0,0,inf,0,5\n", {"line 2", "'inf'"});
  bad(head + "1,0,0,0,1,0\n", {"line 2", "6 of 7 cells"});
  bad(head + "1,0,0,0,1,0,5,7\n", {"line 2", "'7'", "beyond the 7 columns"});
  bad("x,y,z,vx,vy,until\n" + row, {"line 1", "no column vz", "must name x,y,z,vx,vy,vz"});
  bad("JDTDB;X;Y;Z;VX;VY;VZ\n1;1;0;0;0;1;0\n", {"line 1", "no column x", "separated by commas"});
  bad("1,0,0,0,1,0,5\n", {"line 1", "'1,0,0,0,1,0,5'", "must name x,y,z,vx,vy,vz"});
  bad("x,y,z,vx,vy,vz,x,until\n", {"line 1", "two columns are called x"});
  bad("", {"is empty"});
  bad("name," + head + "a," + row + "# a comment, late\n",
      {"line 3", "'late'", "comments stand before the header"});
  bad("x,y,z,vx,vy,vz\n1,0,0,0,1,0\n", {"no column until"});
  bad(head + row, {"--until 3", "has a column until"}, {"--until", "3"});
  bad(head + row, {"until = 5", "10 million"}, {"--every", "1e-9"});
  bad(head + "\"1,0,0\n", {"line 2", "never closed"});
  bad(std::string(3U << 20U, 'x'), {"line 1", "no table"});
  write("mu.csv", "x,y,z,vx,vy,vz,until,mu\n1,0,0,0,1,0,5,0\n");
  refused({"propagate", "--states", "mu.csv"}, {"mu.csv", "line 2", "mu = 0"});
  refused({"propagate", "--states", "none.csv"}, {"none.csv", "No such file"});
  write("good.csv", head + row);
  const std::vector<std::string> good = {"propagate", "--states", "good.csv", "--mu", "1"};
  const auto with = [&](std::vector<std::string> more, const std::vector<std::string>& named) {
    more.insert(more.begin(), good.begin(), good.end());
    refused(more, named);
  };
  with({"--position", "1,0,0"}, {"--position 1,0,0", "--states good.csv"});
  with({"--method", "rkn1210"}, {"--method rkn1210", "series or kepler"});
  with({"--method", "kepler", "--zonal", "1e-3", "--radius", "1"}, {"--zonal", "kepler"});
  with({"--threads", "0"}, {"--threads 0"});
  for (const char* shard : {"2", "0/2", "3/2", "1/0", "a/b", "1/2/3"}) with({"--shard", shard}, {"--shard"});
  refused({"propagate", "--position", "1,0,0", "--velocity", "0,1,0", "--until", "1", "--threads", "2"},
          {"--threads 2", "--states"});
}

TEST_F(StatesCommand, MergeRefusesWhatIsNotWhole) {
  write("orbits.csv", ellipses(20));
  const auto part = [&](const std::string& shard, const std::string& tolerance = "1e-15") {
    return output({"propagate", "--states", "orbits.csv", "--shard", shard, "--tolerance", tolerance});
  };
  for (const char* k : {"1", "2", "3"}) write(std::string(k) + ".csv", part(std::string(k) + "/3"));
  refused({"merge", "1.csv", "3.csv"}, {"shards 2 of 3 are missing"});
  refused({"merge", "1.csv", "2.csv", "3.csv", "2.csv"}, {"2.csv", "shard 2 / 3", "already"});
  write("half.csv", part("2/2"));
  refused({"merge", "1.csv", "half.csv"}, {"half.csv, line 1", "shard 2 / 2"});
  write("other.csv", part("2/3", "1e-9"));
  refused({"merge", "1.csv", "other.csv", "3.csv"}, {"other.csv, line 1", "shard 2 / 3"});
  const std::string second = part("2/3");
  for (const std::size_t cut : {second.size() - 1, second.size() / 2, second.rfind("# end")}) {
    write("cut.csv", second.substr(0, cut));
    const Finished f = run({"merge", "1.csv", "cut.csv", "3.csv"});
    // Without the last line break the last line is there.
    if (cut == second.size() - 1) continue;
    EXPECT_EQ(f.exit_code, 2) << cut;
    EXPECT_NE(f.errors.find("cut.csv"), std::string::npos) << f.errors;
    EXPECT_TRUE(f.output.empty());
  }
  write("torn.csv", second.substr(0, second.find("\n8,") + 1) + second.substr(second.find("\n10,") + 1));
  refused({"merge", "1.csv", "torn.csv", "3.csv"}, {"torn.csv, line 4", "row"});
  refused({"merge", "orbits.csv"}, {"orbits.csv, line 1", "--shard"});
}

// With several lines a row their numbers alone do not tell what is missing.
TEST_F(StatesCommand, MergeCountsAndComparesLines) {
  write("orbits.csv", ellipses(4));
  const auto part = [&](const std::string& shard, const std::string& file = "orbits.csv") {
    return output({"propagate", "--states", file, "--every", "2", "--shard", shard});
  };
  write("1.csv", part("1/2"));
  const std::string second = part("2/2");
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < second.size(); at = second.find('\n', at) + 1)
    lines.push_back(second.substr(at, second.find('\n', at) + 1 - at));
  ASSERT_GT(lines.size(), 20U);
  const auto refused_with = [&](const std::vector<std::string>& of) {
    std::string text;
    for (const std::string& line : of) text += line;
    write("2.csv", text);
    refused({"merge", "1.csv", "2.csv"}, {"2.csv, line", "missing, doubled, changed or of another run"});
  };
  auto changed = lines;
  changed.erase(changed.begin() + 5, changed.begin() + 8);
  refused_with(changed);
  changed = lines;
  changed.insert(changed.begin() + 3, lines[3]);
  refused_with(changed);
  changed = lines;
  std::swap(changed[4], changed[5]);
  refused_with(changed);
  changed = lines;
  changed[6][changed[6].find('.') + 3] ^= 1;
  refused_with(changed);
  // The lines of another run under the first line of this one.
  std::string other = ellipses(4);
  other.replace(other.find("body, 3"), 7, "body, 9");
  write("others.csv", other);
  const std::string foreign = part("2/2", "others.csv");
  refused_with({lines[0], foreign.substr(foreign.find('\n') + 1)});
  write("2.csv", second + second);
  refused({"merge", "1.csv", "2.csv"}, {"2.csv, line", "behind the end"});
  write("2.csv", second);
  EXPECT_EQ(output({"merge", "2.csv", "1.csv"}),
            output({"propagate", "--states", "orbits.csv", "--every", "2"}));
  // A pipe gives its lines once only.
  const Finished f =
      scene::run_program({"bash", "-c", program_ + " merge <(cat 1.csv) <(cat 2.csv)"}, folder_);
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_TRUE(f.output.empty());
  EXPECT_NE(f.errors.find("/dev/fd/"), std::string::npos) << f.errors;
  EXPECT_NE(f.errors.find("is no file"), std::string::npos) << f.errors;
}

// Rows that failed make the exit code of one run, and all is printed.
TEST_F(StatesCommand, MergeEndsAsOneRunDoes) {
  write("orbits.csv", "x,y,z,vx,vy,vz\n1,0,0,0,1,0\n1,0,0,0,0,0\n1,0,0,0,1.1,0\n");
  const std::vector<std::string> words = {"propagate", "--states", "orbits.csv", "--mu", "1", "--until", "5"};
  for (const char* k : {"1", "2", "3"}) {
    auto part = words;
    part.insert(part.end(), {"--shard", std::string(k) + "/3"});
    const Finished f = run(part);
    EXPECT_EQ(f.exit_code, *k == '2' ? 1 : 0);
    write(std::string(k) + ".csv", f.output);
  }
  const Finished f = run({"merge", "1.csv", "2.csv", "3.csv"});
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.output, run(words).output);
  EXPECT_NE(f.errors.find("1 of the rows failed"), std::string::npos) << f.errors;
}

}  // namespace
}  // namespace nlmech::catalogue_test
