/// Every figure and table of the sources is a scene, or belongs to a chapter that is not built; and the other
/// way round.
#include <gtest/gtest.h>

#include <iostream>
#include <utility>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::completeness_test {
namespace {

/// The scenes of all chapters of this build, by chapter.
std::map<std::string, std::set<std::string>> built_scenes() {
  std::map<std::string, std::set<std::string>> scenes;
  for (const std::string& chapter : chapters()) {
    const scene::Finished listed =
        scene::run_program({NLMECH_BINARY_DIR "/bin/" + chapter, "list", "--csv"}, {});
    EXPECT_EQ(listed.exit_code, 0) << listed.errors;
    const auto rows = scene::parse_csv(listed.output, "list");
    for (std::size_t i = 1; i < rows.size(); ++i) scenes[chapter].insert(rows[i].cells.at(0));
  }
  return scenes;
}

TEST(Completeness, EveryFigureAndTableIsAScene) {
  const auto scenes = built_scenes();
  int here = 0, not_built = 0;
  for (const scene::Place& place : scene::read_places(NLMECH_SOURCE_DIR)) {
    if (place.kind != "figure" && place.kind != "table") continue;
    const auto chapter = scenes.find(place.chapter);
    if (chapter == scenes.end()) {
      ++not_built;
      continue;
    }
    for (const std::string& scene : place.scenes)
      EXPECT_TRUE(chapter->second.contains(scene))
          << place.chapter << " lacks " << scene << " of " << place.source << " " << place.name << ": "
          << place.subject;
    ++here;
  }
  std::cout << here << " figures and tables are scenes of this build; " << not_built
            << " belong to chapters that are not\n";
  RecordProperty("not_built", not_built);
}

TEST(Completeness, EveryNumberedSceneStandsInASource) {
  std::set<std::pair<std::string, std::string>> places;
  for (const scene::Place& place : scene::read_places(NLMECH_SOURCE_DIR))
    for (const std::string& scene : place.scenes) places.emplace(place.chapter, scene);
  for (const auto& [chapter, scenes] : built_scenes()) {
    for (const std::string& scene : scenes) {
      if (!scene.starts_with("fig-") && !scene.starts_with("table-")) continue;
      EXPECT_TRUE(places.contains({chapter, scene}))
          << "tables/places.csv does not list " << scene << " of " << chapter;
    }
  }
}

}  // namespace
}  // namespace nlmech::tests::completeness_test
