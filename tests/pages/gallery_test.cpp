/// Each picture of README and docs/chapters, docs/gallery/<chapter>-<scene>.svg, is what that scene draws
/// today.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <regex>
#include <set>
#include <sstream>

#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::gallery_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> pictures() {
  std::vector<std::string> names;
  for (const auto& file : fs::directory_iterator(NLMECH_SOURCE_DIR "/docs/gallery"))
    names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A picture without the line that says which program drew it.
std::string picture(const fs::path& file) {
  std::string text;
  for (const std::string& line : lines_in(text_of(file))) {
    if (!line.starts_with("<!-- drawn from ")) text += line + "\n";
  }
  return text;
}

/// Words of a picture in their order, numbers at ticks left out.
std::vector<std::string> words(const std::string& svg) {
  static const std::regex label("<text[^>]*>(.*)</text>"), mark(R"(<!\[CDATA\[|\]\]>|<[^>]*>)");
  std::vector<std::string> found;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), label); at != std::sregex_iterator(); ++at) {
    const std::string word = std::regex_replace((*at)[1].str(), mark, "");
    if (std::regex_search(word, std::regex("[A-Za-z]"))) found.push_back(word);
  }
  return found;
}

/// Places that lines go through, in units of the picture.
using Places = std::set<std::pair<double, double>>;

Places places(const std::string& svg) {
  static const std::regex place(R"((-?\d+(?:\.\d+)?),(-?\d+(?:\.\d+)?))");
  Places found;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), place); at != std::sregex_iterator(); ++at)
    found.emplace(std::stod((*at)[1]), std::stod((*at)[2]));
  return found;
}

/// What a script says whatever was measured: abscissae, captions of panels.
std::vector<std::string> what_stays(const std::string& script) {
  static const std::regex label("(?:set xlabel|captions =) '([^']+)'");
  std::vector<std::string> found;
  for (auto at = std::sregex_iterator(script.begin(), script.end(), label); at != std::sregex_iterator();
       ++at) {
    std::istringstream all((*at)[1]);
    for (std::string one; std::getline(all, one, '|');) found.push_back(one);
  }
  return found;
}

/// Those of these places that have none of the others within @p far to either side.
std::vector<std::pair<double, double>> strays(const Places& these, const Places& others, double far) {
  std::vector<std::pair<double, double>> found;
  std::copy_if(these.begin(), these.end(), std::back_inserter(found), [&](const auto& place) {
    const auto first = others.lower_bound({place.first - far, -HUGE_VAL});
    const auto last = others.upper_bound({place.first + far, HUGE_VAL});
    return std::none_of(first, last,
                        [&](const auto& other) { return std::abs(other.second - place.second) <= far; });
  });
  return found;
}

/// What to do about a picture that is no longer what its scene draws.
std::string advice(const fs::path& file, const fs::path& drawn) {
  return file.string() + " differs from " + drawn.string() +
         ".\nWhere you changed the scene: make gallery, and look at the picture. Where you did not, it hangs "
         "on "
         "rounding: draw the median of perturbed runs, or remove it from docs/gallery.";
}

class Gallery : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);  // a picture that differs is to be looked at
  }

  std::string chapter_ = GetParam().substr(0, GetParam().find('-'));
  std::string scene_ = GetParam().substr(GetParam().find('-') + 1);
  fs::path folder_ = fs::temp_directory_path() / ("nlmech-" + GetParam() + std::to_string(::getpid()));
};

/// The same words and, to 3 of some 700 units of length, lines through the same places, in whatever pieces:
/// where gnuplot cuts a contour differs from machine to machine. Of a picture with measured times, which
/// decide even whom it names, axes and panels alone.
TEST_P(Gallery, ShowsWhatTheSceneDraws) {
  const fs::path program = fs::path(NLMECH_BINARY_DIR "/bin") / chapter_;
  if (!fs::exists(program)) GTEST_SKIP() << chapter_ << " is not built";
  const auto run = [&](std::vector<std::string> options) {
    std::vector<std::string> words = {program.string(), "run", scene_, "--out", folder_.string()};
    words.insert(words.end(), options.begin(), options.end());
    const scene::Finished finished = scene::run_program(words, {});
    ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  };
  run({"--quick"});
  const std::string data = text_of(folder_ / "results" / chapter_ / (scene_ + ".csv"));
  const bool timed = ("," + data.substr(0, data.find('\n'))).find(",time_") != std::string::npos;
  if (!timed) run({});
  const fs::path now = folder_ / "figures" / chapter_ / (scene_ + ".svg");
  const std::string drawn = picture(now);
  const fs::path file = fs::path(NLMECH_SOURCE_DIR "/docs/gallery") / (GetParam() + ".svg");
  const std::string shown = picture(file);
  if (timed) {
    const auto axes = what_stays(text_of(folder_ / "results" / chapter_ / (scene_ + ".gp")));
    EXPECT_FALSE(axes.empty());
    for (const std::string& label : axes)
      EXPECT_EQ(std::ranges::count(words(shown), label), 1) << label << "\n" << advice(file, now);
    return;
  }
  EXPECT_FALSE(words(drawn).empty());
  EXPECT_EQ(words(shown), words(drawn)) << advice(file, now);
  const Places there = places(shown), here = places(drawn);
  EXPECT_GT(here.size(), 20U);
  const std::vector<std::pair<double, double>> none;
  EXPECT_EQ(strays(there, here, 3), none) << "places of docs/gallery that are not drawn now\n"
                                          << advice(file, now);
  EXPECT_EQ(strays(here, there, 3), none) << "places drawn now that are not in docs/gallery\n"
                                          << advice(file, now);
}

/// README shows eight; pages on forges show those of their chapter.
TEST(GalleryOfPages, HasPicturesThatPagesShow) {
  const std::string readme = text_of(NLMECH_SOURCE_DIR "/README.md");
  std::size_t of_readme = 0;
  std::uintmax_t all = 0;
  for (const std::string& name : pictures()) {
    const std::string chapter = name.substr(0, name.find('-'));
    const std::string page = text_of(NLMECH_SOURCE_DIR "/docs/chapters/" + chapter + ".md");
    const bool in_readme = readme.find("(docs/gallery/" + name + ".svg)") != std::string::npos;
    EXPECT_TRUE(in_readme || page.find("(../gallery/" + name + ".svg)") != std::string::npos) << name;
    of_readme += in_readme ? 1 : 0;
    const std::uintmax_t size = fs::file_size(fs::path(NLMECH_SOURCE_DIR "/docs/gallery") / (name + ".svg"));
    EXPECT_LT(size, in_readme ? 500'000U : 60'000U) << name;
    all += size;
  }
  EXPECT_EQ(of_readme, 8U);
  EXPECT_LT(all, 3'000'000U);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& picture) {
  return std::regex_replace(picture.param, std::regex("[^A-Za-z0-9_]"), "_");
}

INSTANTIATE_TEST_SUITE_P(Pages, Gallery, ::testing::ValuesIn(pictures()), test_name);

}  // namespace
}  // namespace nlmech::tests::gallery_test
