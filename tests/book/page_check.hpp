/// @file
/// Every page of the book as a reader's browser shows it: what is broken, and where.
#pragma once

#include <compare>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace nlmech::tests {

/// Something that a reader would stumble over.
struct Finding {
  std::string page;  ///< file, relative to the book's folder
  std::string kind;  ///< "link", "image", "formula", "error", "network", "width" or "time"
  std::string text;  ///< what it is

  /// By page, kind and text.
  auto operator<=>(const Finding&) const = default;
};

/// How the pages are looked at.
struct Checking {
  int browsers = 2;     ///< at work at the same time
  int width = 390;      ///< of the window, px: a phone held upright
  double seconds = 60;  ///< for one page, on a busy machine; after that the browser is started anew
};

/// What came out.
struct Checked {
  std::vector<std::string> pages;  ///< relative to the book's folder, sorted
  std::set<Finding> findings;      ///< none, if all is well
  std::string slowest;             ///< the page that took longest
  double slowest_seconds = 0;      ///< and how long
};

/// Loads all .html files under a folder, each browser one after another.
///
/// Findings: a link to a file that does not exist, that lies outside the folder, or to a place that its page
/// does not have ("link"); an image that cannot be shown ("image"); a formula left as TeX or refused by
/// MathJax
/// ("formula"); an error on the console, a script or style that cannot be loaded, or an exception that nobody
/// caught ("error"); a request that would leave the machine ("network"); a page that scrolls sideways
/// ("width"); a page that is not done in time ("time").
///
/// What belongs to MathJax or is loaded by the search box inside other pages is no page.
/// @param program the browser's
[[nodiscard]] Checked check_pages(const std::string& program, const std::filesystem::path& folder,
                                  const Checking& how = {});

/// One line for each kind and text: where first, and on how many pages.
[[nodiscard]] std::string summary(const std::set<Finding>& findings);

}  // namespace nlmech::tests
