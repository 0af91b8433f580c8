#include "nlmech/scene/provenance.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "nlmech/scene/build_info.hpp"
#include "tests/places.hpp"

namespace nlmech::scene::provenance_test {
namespace {

const Run<int> run("series-4", "as \"printed\"", {}, [](Results&) { return 1; });

nlohmann::json written(bool quick, double value) {
  const Chapter chapter("optics", "Light", {});
  const Scene scene{.name = "fig-1", .title = "Rays", .place = "Figure 1"};
  Performance performance;
  performance.runs = {&run};
  performance.showing.quantities = {{"angle", "deg", value, 1, 3, "law of refraction"}};
  return nlohmann::json::parse(provenance(chapter, scene, performance, quick));
}

TEST(Provenance, SaysHowToMakeTheSceneAgain) {
  const auto json = written(false, 2);
  EXPECT_EQ(json.at("chapter"), "optics");
  EXPECT_EQ(json.at("scene"), "fig-1");
  EXPECT_EQ(json.at("title"), "Rays");
  EXPECT_EQ(json.at("place"), "Figure 1");
  EXPECT_EQ(json.at("command"), "optics run fig-1");
  EXPECT_EQ(json.at("effort"), "full");
  EXPECT_EQ(written(true, 2).at("command"), "optics run fig-1 --quick");
  EXPECT_EQ(written(true, 2).at("effort"), "quick");
}

TEST(Provenance, SaysWhatTheProgramWasMadeFrom) {
  const auto json = written(false, 2);
  EXPECT_EQ(json.at("version"), build_info().version);
  EXPECT_EQ(json.at("commit"), build_info().commit);
  EXPECT_TRUE(json.at("dirty").is_boolean());
  EXPECT_FALSE(json.at("compiler").get<std::string>().empty());
  EXPECT_TRUE(json.at("flags").is_string());
  EXPECT_FALSE(json.at("processor").get<std::string>().empty());
  for (const char* library : {"fmt", "CLI11", "nlohmann_json"})
    EXPECT_TRUE(json.at("libraries").contains(library)) << library;
}

TEST(Provenance, ListsRunsWithTheirReadings) {
  const auto json = written(false, 2);
  ASSERT_EQ(json.at("runs").size(), 1U);
  EXPECT_EQ(json.at("runs")[0].at("name"), "series-4");
  EXPECT_EQ(json.at("runs")[0].at("reading"), "as \"printed\"");
}

TEST(Provenance, ListsQuantitiesWithTheirRanges) {
  const auto json = written(false, 0.1);
  ASSERT_EQ(json.at("quantities").size(), 1U);
  const auto& q = json.at("quantities")[0];
  EXPECT_EQ(q.at("name"), "angle");
  EXPECT_EQ(q.at("unit"), "deg");
  EXPECT_EQ(q.at("value").get<double>(), 0.1);
  EXPECT_EQ(q.at("low").get<double>(), 1);
  EXPECT_EQ(q.at("high").get<double>(), 3);
  EXPECT_EQ(q.at("passes"), false);
  EXPECT_EQ(q.at("reason"), "law of refraction");
}

TEST(Provenance, WritesWhatIsNoNumberAsNull) {
  const auto json = written(false, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(json.at("quantities")[0].at("value").is_null());
  EXPECT_EQ(json.at("quantities")[0].at("passes"), false);
}

TEST(Provenance, HoldsNoPathOfTheMachine) {
  EXPECT_EQ(written(false, 2).dump().find(NLMECH_SOURCE_DIR), std::string::npos);
  EXPECT_EQ(written(false, 2).dump().find(NLMECH_BINARY_DIR), std::string::npos);
}

}  // namespace
}  // namespace nlmech::scene::provenance_test
