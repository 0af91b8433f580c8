/// The check of the book's pages finds what it is there for: each page of the folder fixture/ is broken in
/// one way.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/book/browser.hpp"
#include "tests/book/page_check.hpp"
#include "tests/places.hpp"

namespace nlmech::tests {
namespace {

namespace fs = std::filesystem;

/// Copies of some of the pages in a folder of their own, checked.
class PageCheck : public testing::Test {
 protected:
  void SetUp() override {
    program_ = find_chromium();
    if (!program_) GTEST_SKIP() << "no Chromium is installed (Debian package chromium)";
    folder_ = fs::temp_directory_path() / ("nlmech-pages-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    for (const char* name : {"good.html", "a picture.svg"}) copy(name);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }
  void copy(const std::string& name) {
    fs::copy_file(fs::path(NLMECH_SOURCE_DIR) / "tests/book/fixture" / name, folder_ / name);
  }
  [[nodiscard]] std::set<Finding> findings(double seconds = 30) const {
    return check_pages(*program_, folder_, {.seconds = seconds}).findings;
  }

  std::optional<std::string> program_;
  fs::path folder_;
};

TEST_F(PageCheck, FindsNothingOnAGoodPage) {
  const Checked checked = check_pages(*program_, folder_);
  EXPECT_EQ(checked.pages, std::vector<std::string>{"good.html"});
  EXPECT_TRUE(checked.findings.empty()) << summary(checked.findings);
}

TEST_F(PageCheck, FindsEachKindOfFailureAndNoOther) {
  const std::map<std::string, std::pair<std::string, std::vector<std::string>>> broken = {
      {"link.html",
       {"link",
        {"leads out of the book: " + fs::canonical(folder_).parent_path().string() + "/outside.html",
         "leads to no file: no-such-page.html", "leads to no place on its page: good.html#no-such-place"}}},
      // Friends and nested classes that Doxygen gives no place are no findings, all others are.
      {"friends.html",
       {"link",
        {"leads to no place on its page: good.html#affffffffffffffffffffffffffffffff",
         "leads to no place on its page: good.html#nested-classes"}}},
      {"formula.html", {"formula", {"As \\(x^2\\) shows.", "\\[ y \\]", "\\f$z\\f$"}}},
      {"refused.html", {"formula", {"Undefined control sequence"}}},
      {"exception.html", {"error", {"Error: thrown on purpose"}}},
      {"network.html", {"network", {"https://example.org/data"}}},
      {"width.html", {"width", {"608 px in 390 (div.: wide)"}}},
  };
  for (const auto& [page, what] : broken) copy(page);
  for (const char* page : {"console.html", "image.html", "script.html"}) copy(page);
  const std::set<Finding> found = findings();
  std::set<Finding> expected;
  for (const auto& [page, what] : broken) {
    for (const std::string& text : what.second) expected.insert({page, what.first, text});
  }
  const std::string at = "file://" + fs::canonical(folder_).string() + "/";
  const std::string missing = "Failed to load resource: net::ERR_FILE_NOT_FOUND " + at;
  expected.insert({"console.html", "error", "console: \"said on purpose\""});
  expected.insert({"image.html", "image", "no-such-picture.svg"});
  expected.insert({"image.html", "error", missing + "no-such-picture.svg"});
  expected.insert({"script.html", "error", missing + "no-such-script.js"});
  EXPECT_EQ(summary(found), summary(expected));
}

TEST_F(PageCheck, GivesUpAPageThatHangsAndGoesOn) {
  copy("hang.html");
  copy("width.html");  // comes after it
  const std::set<Finding> found = findings(25);
  ASSERT_EQ(found.size(), 2u) << summary(found);
  EXPECT_EQ(*found.begin(), (Finding{"hang.html", "time", "the browser does not answer"}));
  EXPECT_EQ(std::next(found.begin())->page, "width.html");
}

TEST_F(PageCheck, LeavesNoBrowserBehind) {
  const fs::path temporary = fs::temp_directory_path();
  const auto browsers = [&temporary] {
    std::ptrdiff_t count = 0;
    for (const auto& entry : fs::directory_iterator(temporary)) {
      if (entry.path().filename().string().starts_with("nlmech-browser-")) ++count;
    }
    return count;
  };
  const std::ptrdiff_t before = browsers();
  (void)findings();
  EXPECT_EQ(browsers(), before);
}

TEST(Browser, IsLostIfItsProgramEnds) {
  Browser browser("true");
  EXPECT_THROW(browser.call("Browser.getVersion", nlohmann::json::object(), "", in_seconds(20)), BrowserLost);
}

TEST(Browser, IsLostIfItDoesNotAnswer) {
  const fs::path script = fs::temp_directory_path() / ("nlmech-mute-" + std::to_string(::getpid()));
  std::ofstream(script) << "#!/bin/sh\nexec sleep 60\n";
  fs::permissions(script, fs::perms::owner_all);
  {
    Browser browser(script.string());
    EXPECT_THROW(browser.call("Browser.getVersion", nlohmann::json::object(), "", in_seconds(0.5)),
                 BrowserLost);
  }
  fs::remove(script);
}

TEST(Summary, SaysOnHowManyPages) {
  EXPECT_EQ(summary({{"a.html", "link", "x"}, {"b.html", "link", "x"}, {"b.html", "width", "y"}}),
            "a.html: link: x (on 2 pages)\nb.html: width: y\n");
}

}  // namespace
}  // namespace nlmech::tests
