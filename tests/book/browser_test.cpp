/// The check of the book's pages finds what it is there for: each page of the folder fixture/ is broken in
/// one way.
#include <gtest/gtest.h>

#include <thread>

#include "tests/book/browser.hpp"
#include "tests/book/page_check.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::browser_test {
namespace {

namespace fs = std::filesystem;

/// Copies of some of the pages in a folder of their own, checked.
class PageCheck : public testing::Test {
 protected:
  void SetUp() override {
    program_ = find_chromium();
    if (!program_) GTEST_SKIP() << "no Chromium is installed (Debian package chromium)";
    for (const char* name : {"good.html", "a picture.svg"}) copy(name);
  }
  void copy(const std::string& name) {
    fs::copy_file(fs::path(NLMECH_SOURCE_DIR) / "tests/book/fixture" / name, pages_ / name);
  }
  [[nodiscard]] std::set<Finding> findings(double seconds = 30) const {
    return check_pages(*program_, pages_.path(), {.seconds = seconds}).findings;
  }

  std::optional<std::string> program_;
  TemporaryFolder pages_;
};

TEST_F(PageCheck, FindsNothingOnAGoodPage) {
  const Checked checked = check_pages(*program_, pages_.path());
  EXPECT_EQ(checked.pages, std::vector<std::string>{"good.html"});
  EXPECT_TRUE(checked.findings.empty()) << summary(checked.findings);
}

TEST_F(PageCheck, FindsEachKindOfFailureAndNoOther) {
  const std::map<std::string, std::pair<std::string, std::vector<std::string>>> broken = {
      {"link.html",
       {"link",
        {"leads out of the book: " + fs::canonical(pages_.path()).parent_path().string() + "/outside.html",
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
      {"number.html", {"number", {"a list begins with 300", "It converges to ."}}},
      {"summary.html", {"summary", {"Newmark's method (N."}}},
      {"alternative.html",
       {"alternative",
        {"a%20picture.svg: \"Too few words\"",
         "a%20picture.svg: \"A caption that says with nine words nothing new\""}}},
      {"chapter_long.html", {"length", {"41 screens of 900 px"}}},
  };
  for (const auto& [page, what] : broken) copy(page);
  for (const char* page : {"console.html", "image.html", "script.html", "table.html"}) copy(page);
  const std::set<Finding> found = findings();
  std::set<Finding> expected;
  for (const auto& [page, what] : broken) {
    for (const std::string& text : what.second) expected.insert({page, what.first, text});
  }
  const std::string at = "file://" + fs::canonical(pages_.path()).string() + "/";
  const std::string missing = "Failed to load resource: net::ERR_FILE_NOT_FOUND " + at;
  expected.insert({"console.html", "error", "console: \"said on purpose\""});
  expected.insert({"table.html", "table", "900 px in 600: row | effect"});
  for (const char* width : {"390", "1400"})
    expected.insert(
        {"table.html", "table", std::string("effect is out of sight at ") + width + " px: row | effect"});
  expected.insert({"image.html", "image", "no-such-picture.svg"});
  expected.insert({"image.html", "error", missing + "no-such-picture.svg"});
  expected.insert({"script.html", "error", missing + "no-such-script.js"});
  EXPECT_EQ(summary(found), summary(expected));
}

TEST_F(PageCheck, FindsWordsThatThePictureCutsOff) {
  fs::create_directories(pages_ / "figures");
  for (const char* name : {"cut.svg", "a picture.svg"})
    fs::copy_file(fs::path(NLMECH_SOURCE_DIR) / "tests/book/fixture" / name, pages_ / "figures" / name);
  const std::set<Finding> found = findings();
  ASSERT_EQ(found.size(), 1u) << summary(found);
  EXPECT_EQ(found.begin()->kind, "picture");
  EXPECT_EQ(found.begin()->page, "figures/cut.svg");
  EXPECT_EQ(found.begin()->text.substr(0, 6), "below:");
}

/// The second page is shown in the frame of the first, and judged as if it were loaded.
TEST_F(PageCheck, JudgesPagesThatAreShownInTheFrameOfAnother) {
  copy("frame 1.html");
  copy("frame 2.html");
  EXPECT_EQ(summary(check_pages(*program_, pages_.path(), {.browsers = 1}).findings),
            "frame 2.html: link: leads to no place on its page: frame 1.html#second\n"
            "frame 2.html: width: 708 px in 390 (div.: wide)\n");
}

TEST_F(PageCheck, GivesUpAPageThatHangsAndGoesOn) {
  copy("hang.html");
  copy("width.html");  // comes after it
  const std::set<Finding> found = findings(25);
  ASSERT_EQ(found.size(), 2u) << summary(found);
  EXPECT_EQ(*found.begin(), (Finding{"hang.html", "time", "the browser does not answer"}));
  EXPECT_EQ(std::next(found.begin())->page, "width.html");
}

/// Command lines of running processes in which a text stands. One that has ended has none.
std::vector<std::string> commands_with(const std::string& text) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string command = bytes_of(entry.path() / "cmdline");
    if (command.find(text) != std::string::npos) found.push_back(command);
  }
  return found;
}

TEST_F(PageCheck, LeavesNoBrowserBehind) {
  const TemporaryFolder own;  // what tests beside this one start is elsewhere
  const TemporaryFilesIn there(own.path());
  {
    Browser browser(*program_);
    browser.call("Browser.getVersion", nlohmann::json::object(), "", in_seconds(60));
    EXPECT_FALSE(fs::is_empty(own.path()));
    EXPECT_FALSE(commands_with(own.string()).empty());
  }
  EXPECT_TRUE(fs::is_empty(own.path()));
  (void)findings();
  EXPECT_TRUE(fs::is_empty(own.path()));
  // Nobody waits for the processes of the killed group: they need a moment to end.
  const Deadline deadline = in_seconds(20);
  while (!commands_with(own.string()).empty() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(commands_with(own.string()), std::vector<std::string>{});
}

TEST(Browser, IsLostIfItsProgramEnds) {
  Browser browser("true");
  EXPECT_THROW(browser.call("Browser.getVersion", nlohmann::json::object(), "", in_seconds(20)), BrowserLost);
}

TEST(Browser, IsLostIfItDoesNotAnswer) {
  const TemporaryFolder folder;
  const fs::path script = folder / "mute";
  put(script, "#!/bin/sh\nexec sleep 60\n");
  fs::permissions(script, fs::perms::owner_all);
  Browser browser(script.string());
  EXPECT_THROW(browser.call("Browser.getVersion", nlohmann::json::object(), "", in_seconds(0.5)),
               BrowserLost);
}

TEST(Summary, SaysOnHowManyPages) {
  EXPECT_EQ(summary({{"a.html", "link", "x"}, {"b.html", "link", "x"}, {"b.html", "width", "y"}}),
            "a.html: link: x (on 2 pages)\nb.html: width: y\n");
}

}  // namespace
}  // namespace nlmech::tests::browser_test
