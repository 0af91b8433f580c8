/// The search of the book, as a reader uses it: typed into the box of a page that is opened from the file
/// system.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "tests/book/browser.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::search_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class Search : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path page = NLMECH_BINARY_DIR "/book/html/glossary.html";
    if (!fs::exists(page)) GTEST_SKIP() << "there is no book; `make book` writes it";
    const auto program = find_chromium();
    if (!program) GTEST_SKIP() << "no Chromium is installed (Debian package chromium)";
    browser_.emplace(*program);
    const Deadline deadline = in_seconds(120);
    const json target = browser_->call("Target.createTarget", {{"url", "about:blank"}}, "", deadline);
    session_ = browser_->call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}},
                              "", deadline)["sessionId"];
    browser_->call("Page.enable", json::object(), session_, deadline);
    browser_->call("Page.navigate", {{"url", "file://" + page.string()}}, session_, deadline);
    while (browser_->next_event(deadline)["method"] != "Page.loadEventFired") {
    }
  }

  /// The files, without places on them, that are offered for what is typed, best first.
  std::vector<std::string> found(const std::string& typed) {
    const std::string script =
        "(async () => {"
        "const field = document.querySelector('#book-search input');"
        "const list = document.querySelector('#book-search ol');"
        "list.replaceChildren();"
        "field.value = " +
        json(typed).dump() +
        ";"
        "field.dispatchEvent(new Event('input'));"
        "while (!list.children.length) await new Promise((done) => setTimeout(done, 20));"
        "return [...list.querySelectorAll('a')].map((a) => a.getAttribute('href'));"
        "})()";
    const json answer = browser_->call(
        "Runtime.evaluate", {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}},
        session_, in_seconds(60));
    EXPECT_FALSE(answer.contains("exceptionDetails")) << answer.dump();
    std::vector<std::string> files;
    for (const json& href : answer["result"]["value"]) {
      const auto address = href.get<std::string>();
      const std::string file = address.substr(0, address.find('#'));
      EXPECT_TRUE(fs::exists(fs::path(NLMECH_BINARY_DIR "/book/html") / file)) << address;
      files.push_back(file);
    }
    return files;
  }

  std::optional<Browser> browser_;
  std::string session_;
};

/// Terms of the field, and where a reader expects to be led: by one of the first three.
TEST_F(Search, FindsTermsInTheTextOfPages) {
  for (const auto& [typed, page] :
       std::vector<std::pair<std::string, std::string>>{{"limit point", "chapter_homotopy.html"},
                                                        {"Kepler", "chapter_two_body_series.html"},
                                                        {"pork-chop", "chapter_rbf_inverse.html"},
                                                        {"flexible spacecraft", "chapter_gss_control.html"},
                                                        {"geodetic", "chapter_geodesy.html"}}) {
    const auto files = found(typed);
    ASSERT_GE(files.size(), 3U) << typed;
    EXPECT_NE(std::find(files.begin(), files.begin() + 3, page), files.begin() + 3)
        << typed << ": " << files[0];
  }
  for (const char* typed : {"misprint", "boundary value", "step control", "tolerance", "rounding level"})
    EXPECT_FALSE(found(typed).empty()) << typed;
}

TEST_F(Search, FindsNamesOfTheLibrary) {
  const auto files = found("solve_lambert");
  EXPECT_NE(
      std::ranges::find_if(files, [](const std::string& f) { return f.starts_with("namespacenlmech"); }),
      files.end());
}

TEST_F(Search, SaysSoWhereNothingIs) { EXPECT_TRUE(found("xyzzy plugh").empty()); }

}  // namespace
}  // namespace nlmech::tests::search_test
