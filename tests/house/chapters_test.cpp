/// What every chapter of this build must be able to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::chapters_test {
namespace {

using Files = std::map<std::string, std::string>;

/// A row of `list --csv`.
struct Listed {
  std::string scene;
  std::vector<std::string> runs;
};

class EveryChapter : public ::testing::TestWithParam<std::string> {
 protected:
  scene::Finished run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all = {NLMECH_BINARY_DIR "/bin/" + GetParam()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return scene::run_program(all, folder_.path());
  }
  std::vector<Listed> list() const {
    const scene::Finished listed = run({"list", "--csv"});
    EXPECT_EQ(listed.exit_code, 0) << listed.errors;
    std::vector<Listed> scenes;
    const auto rows = scene::parse_csv(listed.output, "list");
    for (std::size_t i = 1; i < rows.size(); ++i)
      scenes.push_back({rows[i].cells.at(0), words_of(rows[i].cells.at(3))});
    return scenes;
  }
  std::string figure(const std::string& scene) const {
    return "figures/" + GetParam() + "/" + scene + ".svg";
  }
  std::string result(const std::string& scene, const std::string& end) const {
    return "results/" + GetParam() + "/" + scene + end;
  }
  std::string table(const std::string& scene, const std::string& end) const {
    return "tables/" + GetParam() + "/" + scene + end;
  }
  /// Scenes with a column of measured times: their data, tables and figures differ from run to run, their
  /// provenance not.
  std::set<std::string> files_of_timed_scenes(const Files& files) const {
    std::set<std::string> timed;
    for (const Listed& scene : list()) {
      const auto data = files.find(result(scene.scene, ".csv"));
      if (data == files.end()) continue;
      const std::string header = "," + data->second.substr(0, data->second.find('\n'));
      if (header.find(",time_") == std::string::npos) continue;
      for (const std::string& file :
           {figure(scene.scene), result(scene.scene, ".csv"), result(scene.scene, ".gp"),
            table(scene.scene, ".csv"), table(scene.scene, ".md")}) {
        timed.insert(file);
      }
    }
    return timed;
  }
  void expect_something_to_see(const Files& files, const std::string& scene) const;
  void expect_provenance(const Files& files, const Listed& scene) const;

  TemporaryFolder folder_;
};

/// A picture with something drawn in it and the script that draws it, a table with rows, or both.
void EveryChapter::expect_something_to_see(const Files& files, const std::string& scene) const {
  const bool data = files.contains(result(scene, ".csv")), rows = files.contains(table(scene, ".csv"));
  EXPECT_TRUE(data || rows) << scene << " has neither figure nor table";
  if (data) {
    ASSERT_TRUE(files.contains(figure(scene))) << scene << " has data and no picture";
    EXPECT_TRUE(files.contains(result(scene, ".gp"))) << scene << " has a picture and no script";
    const std::string& svg = files.at(figure(scene));
    const auto drawn = [&svg](const char* element) { return svg.find(element) != std::string::npos; };
    EXPECT_TRUE(drawn("<path") || drawn("<polyline") || drawn("<image") || drawn("<text"))
        << scene << ": an empty picture";
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << scene;
    EXPECT_GT(scene::parse_csv(files.at(result(scene, ".csv")), scene).size(), 1U) << scene;
  }
  if (rows) {
    EXPECT_TRUE(files.contains(table(scene, ".md"))) << scene;
    EXPECT_GT(scene::parse_csv(files.at(table(scene, ".csv")), scene).size(), 1U) << scene;
  }
}

/// Names of the runs, the declared ones among them; at least one promise, and each of them kept.
void EveryChapter::expect_provenance(const Files& files, const Listed& scene) const {
  ASSERT_TRUE(files.contains(result(scene.scene, ".json"))) << scene.scene;
  const auto json = nlohmann::json::parse(files.at(result(scene.scene, ".json")));
  EXPECT_EQ(json.at("chapter"), GetParam());
  EXPECT_EQ(json.at("scene"), scene.scene);
  EXPECT_EQ(json.at("effort"), "quick");
  std::vector<std::string> runs;
  for (const auto& r : json.at("runs")) runs.push_back(r.at("name"));
  EXPECT_TRUE(std::is_sorted(runs.begin(), runs.end())) << scene.scene;
  EXPECT_EQ(std::set<std::string>(runs.begin(), runs.end()).size(), runs.size())
      << scene.scene << ": a run twice";
  for (const std::string& declared : scene.runs) {
    EXPECT_TRUE(std::binary_search(runs.begin(), runs.end(), declared))
        << scene.scene << " lists " << declared;
  }
  EXPECT_TRUE(!scene.runs.empty() || runs.empty()) << scene.scene << " lists no run and rests on some";
  EXPECT_GE(json.at("quantities").size(), 1U) << scene.scene;
  for (const auto& q : json.at("quantities")) {
    EXPECT_FALSE(q.at("reason").get<std::string>().empty()) << scene.scene << ": " << q.at("name");
    EXPECT_FALSE(q.at("unit").get<std::string>().empty()) << scene.scene << ": " << q.at("name");
    EXPECT_TRUE(q.at("value").is_number()) << scene.scene << ": " << q.at("name");
  }
}

TEST_P(EveryChapter, ListsItsScenes) {
  const auto scenes = list();
  EXPECT_FALSE(scenes.empty());
  std::set<std::string> names;
  for (const Listed& scene : scenes) EXPECT_TRUE(names.insert(scene.scene).second) << scene.scene;
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_EQ(run({"run"}).exit_code, 2);
  EXPECT_EQ(run({"run", "no-such-scene"}).exit_code, 2);
}

TEST_P(EveryChapter, ShowsAllItsScenesTheSameTwice) {
  const scene::Finished first = run({"run", "--all", "--quick", "--out", (folder_ / "first").string()});
  EXPECT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_EQ(first.errors, "");
  Files files = files_in(folder_ / "first");
  EXPECT_LE(files.erase("figures/style.gp"), 1U);  // which scripts load: one for all scenes
  std::string names;
  for (const auto& [name, bytes] : files) {
    EXPECT_NE(("\n" + first.output).find("\n" + name + "\n"), std::string::npos) << name << " is not named";
    names += name + "\n";
  }
  EXPECT_EQ(first.output.size(), names.size()) << "a file twice, or one that is not there";
  std::set<std::string> expected;
  for (const Listed& scene : list()) {
    expect_something_to_see(files, scene.scene);
    expect_provenance(files, scene);
    for (const std::string& file :
         {figure(scene.scene), result(scene.scene, ".csv"), result(scene.scene, ".gp"),
          result(scene.scene, ".json"), table(scene.scene, ".csv"), table(scene.scene, ".md")}) {
      expected.insert(file);
    }
  }
  for (const auto& [name, bytes] : files) {
    EXPECT_TRUE(expected.contains(name)) << name << " belongs to no scene";
    for (const std::string& path :
         {std::string(NLMECH_SOURCE_DIR), std::string(NLMECH_BINARY_DIR), folder_.string()}) {
      EXPECT_EQ(bytes.find(path), std::string::npos) << name << " holds the path " << path;
    }
  }
  // A picture is what its script makes of its data.
  std::erase_if(files, [](const auto& file) { return file.first.ends_with(".svg"); });
  EXPECT_EQ(run({"run", "--all", "--quick", "--no-plots", "--out", (folder_ / "second").string()}).exit_code,
            0);
  Files again = files_in(folder_ / "second");
  again.erase("figures/style.gp");
  ASSERT_EQ(again.size(), files.size());
  const std::set<std::string> timed = files_of_timed_scenes(files);
  for (const auto& [name, bytes] : files) {
    if (timed.contains(name)) continue;
    EXPECT_TRUE(again.at(name) == bytes) << name << " differs in a second run";
  }
}

TEST_P(EveryChapter, WritesOnlyTheSceneThatIsAskedFor) {
  const auto scenes = list();
  ASSERT_FALSE(scenes.empty());
  // One whose runs the fewest others share: these are what takes long.
  const auto sharing = [&](const Listed& scene) {
    return std::ranges::count(scenes, scene.runs, &Listed::runs);
  };
  const std::string& scene = std::ranges::min_element(scenes, {}, sharing)->scene;
  EXPECT_EQ(run({"run", scene, "--quick"}).exit_code, 0);
  const Files files = files_in(folder_.path());
  EXPECT_TRUE(files.contains(result(scene, ".json")));
  const std::set<std::string> its_own = {"figures/style.gp",   figure(scene),          result(scene, ".csv"),
                                         result(scene, ".gp"), result(scene, ".json"), table(scene, ".csv"),
                                         table(scene, ".md")};
  for (const auto& [name, bytes] : files) EXPECT_TRUE(its_own.contains(name)) << scene << " wrote " << name;
}

/// Problems of `integrate`, and their equations: what its help says between "Problems" and "Methods".
std::map<std::string, std::string> problems_of(const std::string& chapter) {
  const TemporaryFolder folder;
  const scene::Finished help =
      scene::run_program({NLMECH_BINARY_DIR "/bin/" + chapter, "integrate", "--help"}, folder.path());
  std::map<std::string, std::string> problems;
  if (help.exit_code != 0) return problems;  // a chapter without problems in time
  std::istringstream lines(help.output.substr(std::min(help.output.find("Problems"), help.output.size())));
  for (std::string line; std::getline(lines, line) && !line.starts_with("Methods");) {
    const auto colon = line.find(": ");
    if (line.starts_with("  ") && line[2] != ' ' && colon != std::string::npos)
      problems[line.substr(2, colon - 2)] = line.substr(colon + 2);
  }
  return problems;
}

// A user who takes a command from one page to another chapter gets the same equation, or none.
TEST(Problems, OneNameIsOneEquation) {
  std::map<std::string, std::string> equations, owners;
  for (const std::string& chapter : chapters()) {
    for (const auto& [name, equation] : problems_of(chapter)) {
      const auto known = equations.emplace(name, equation).first;
      const std::string& owner = owners.emplace(name, chapter).first->second;
      EXPECT_EQ(equation, known->second) << name << " of " << chapter << " and of " << owner;
    }
  }
  const std::set<std::string> with_problems = {"rbf_ivp", "algebraic_series", "hermitian", "transversal",
                                               "integrators"};
  const auto all = chapters();
  const bool built =
      std::any_of(all.begin(), all.end(), [&](const auto& c) { return with_problems.contains(c); });
  EXPECT_EQ(equations.contains("duffing"), built) << "the help is read";
}

INSTANTIATE_TEST_SUITE_P(House, EveryChapter, ::testing::ValuesIn(chapters()),
                         [](const auto& chapter) { return chapter.param; });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryChapter);

}  // namespace
}  // namespace nlmech::tests::chapters_test
