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
  /// "link", "image", "formula", "number", "summary", "alternative", "table", "length", "error", "network",
  /// "width", "picture" or "time"
  std::string kind;
  std::string text;  ///< what it is

  /// By page, kind and text.
  auto operator<=>(const Finding&) const = default;
};

/// How the pages are looked at.
struct Checking {
  int browsers = 2;       ///< at work at the same time
  int width = 390;        ///< of the window, px: a phone held upright
  int desk_width = 1400;  ///< of the window in which figures and tables are looked at once more, px
  double seconds = 60;    ///< for one page, on a busy machine; after that the browser is started anew
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
/// ("width"); a page that is not done in time ("time"); a list that begins with another number than 1, or a
/// blank before a full stop, where a number was lost ("number"); a brief description that ends within a
/// bracket
/// ("summary"). Of pages with figures or tables, at both widths: a picture for which fewer than eight words
/// stand, or its caption ("alternative"); a table of at most eleven columns that is wider than its own column
/// on a desk, or one whose verdict or effect is out of sight ("table"); a chapter of more than 40 screens
/// ("length").
///
/// Pages that differ in nothing but plain contents, as most of the API reference, are shown in the frame of
/// the first of them, for loading the same scripts a thousand times takes minutes.
///
/// What belongs to MathJax or is loaded by the search box inside other pages is no page.
/// @param program the browser's
[[nodiscard]] Checked check_pages(const std::string& program, const std::filesystem::path& folder,
                                  const Checking& how = {});

/// One line for each kind and text: where first, and on how many pages.
[[nodiscard]] std::string summary(const std::set<Finding>& findings);

}  // namespace nlmech::tests
