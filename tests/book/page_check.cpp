#include "tests/book/page_check.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cstring>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "tests/book/browser.hpp"
#include "tests/places.hpp"

namespace nlmech::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What the script found on a page.
struct Page {
  std::vector<std::string> links;
  std::set<std::string> anchors;
  std::vector<std::string> friends;  // addresses that a list of a class's members calls friends
};

using Addresses = std::set<std::string>;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot open " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A path as part of an address, and back.
std::string encoded(const std::string& path) {
  std::ostringstream out;
  for (const char c : path) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
        std::string_view("/._-~").find(c) != std::string::npos) {
      out << c;
    } else {
      out << '%' << std::uppercase << std::hex << static_cast<int>(static_cast<unsigned char>(c)) << std::dec;
    }
  }
  return out.str();
}
std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::vector<std::string> pages_under(const fs::path& folder) {
  std::vector<std::string> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string page = entry.path().lexically_relative(folder).string();
    if (entry.path().extension() != ".html") continue;
    if (page.starts_with("mathjax/") || page.starts_with("search/")) continue;
    pages.push_back(page);
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

/// Pictures of the chapters, each of which can be opened by itself.
std::vector<std::string> pictures_under(const fs::path& folder) {
  std::vector<std::string> pictures;
  if (!fs::exists(folder / "figures")) return pictures;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "figures")) {
    if (entry.path().extension() == ".svg")
      pictures.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

/// What surrounds a page's contents: what comes before them, without the page's title and its place in the
/// tree. Pages with the same frame differ in their contents alone, and those of such pages need no script of
/// their own. Nothing for pages without a frame, with formulas, or with figures or tables, which scripts
/// prepare.
std::optional<std::string> frame_of(const std::string& page) {
  const std::size_t contents = page.find("<div id=\"doc-content\">");
  if (contents == std::string::npos) return std::nullopt;
  for (const char* prepared : {"mathjax/MathJax.js", "<figure", "class=\"markdownTable\""}) {
    if (page.find(prepared) != std::string::npos) return std::nullopt;
  }
  std::string frame = page.substr(0, contents);
  for (const auto& [begin, end] : {std::pair("<title>", "</title>"), std::pair("initNavTree('", "'")}) {
    const std::size_t from = frame.find(begin);
    if (from != std::string::npos) frame.erase(from, frame.find(end, from + std::strlen(begin)) - from);
  }
  return frame;
}

/// By anything but files and what a page holds itself.
bool leaves_the_machine(const std::string& url) {
  const std::string scheme = url.substr(0, url.find(':'));
  return !url.empty() && scheme != "file" && scheme != "data" && scheme != "blob" && scheme != "about";
}

/// A browser with one empty page, which shows one file after another.
class Reader {
 public:
  Reader(const std::string& program, const Checking& how)
      : how_(how),
        browser_(program),
        script_(read(NLMECH_SOURCE_DIR "/tests/book/probe.js")),
        layout_(read(NLMECH_SOURCE_DIR "/tests/book/layout.js")),
        picture_(read(NLMECH_SOURCE_DIR "/tests/book/picture.js")) {
    const Deadline deadline = in_seconds(60);  // a cold start on a busy machine
    const json target = browser_.call("Target.createTarget", {{"url", "about:blank"}}, "", deadline);
    const json session = browser_.call("Target.attachToTarget",
                                       {{"targetId", target["targetId"]}, {"flatten", true}}, "", deadline);
    session_ = session["sessionId"].get<std::string>();
    for (const char* domain : {"Page", "Runtime", "Log", "Network"})
      browser_.call(std::string(domain) + ".enable", json::object(), session_, deadline);
    resize(how.width, 844, deadline);
  }

  /// Shows a page and adds what is wrong with it. @throws BrowserLost
  Page look(const fs::path& file, const std::string& name, std::set<Finding>& findings) {
    const Deadline deadline = in_seconds(how_.seconds);
    (void)browser_.take_events();
    const std::string address = "file://" + encoded(file.string()), text = read(file);
    const auto frame = frame_of(text);
    const bool framed = frame && frame == frame_;
    std::vector<json> events;
    if (!framed) {
      events = open(address, deadline);
      frame_ = frame;
    }
    const json page = framed ? json(text) : json();
    const auto found = run(script_ + "(" + page.dump(-1, ' ', false, json::error_handler_t::replace) + "," +
                               json(address).dump() + ")",
                           name, findings, deadline);
    if (found && (*found)["explains"] == true) look_at_layout(name, findings, deadline);
    for (json& event : browser_.take_events()) events.push_back(std::move(event));
    for (const json& event : events) note(event, name, findings);
    if (!found) return {};
    add((*found)["findings"], name, findings);
    return {(*found)["links"].get<std::vector<std::string>>(),
            (*found)["anchors"].get<std::set<std::string>>(),
            (*found)["friends"].get<std::vector<std::string>>()};
  }

  /// Opens a picture by itself and adds what its frame cuts off. @throws BrowserLost
  void look_at_picture(const fs::path& file, const std::string& name, std::set<Finding>& findings) {
    const Deadline deadline = in_seconds(how_.seconds);
    (void)browser_.take_events();
    open("file://" + encoded(file.string()), deadline);
    if (const auto found = run(picture_, name, findings, deadline)) add(*found, name, findings);
  }

 private:
  /// Loads what is at the address. @return what happened meanwhile
  std::vector<json> open(const std::string& address, Deadline deadline) {
    std::vector<json> events;
    frame_.reset();
    browser_.call("Page.navigate", {{"url", address}}, session_, deadline);
    while (events.empty() || events.back()["method"] != "Page.loadEventFired")
      events.push_back(browser_.next_event(deadline));
    return events;
  }

  /// The value of a script; nothing, and a finding, if it failed.
  std::optional<json> run(const std::string& script, const std::string& page, std::set<Finding>& findings,
                          Deadline deadline) {
    json answer = browser_.call("Runtime.evaluate",
                                {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}},
                                session_, deadline);
    if (!answer.contains("exceptionDetails")) return answer["result"]["value"];
    findings.insert({page, "error", "the probe failed: " + answer["exceptionDetails"].dump().substr(0, 300)});
    return std::nullopt;
  }

  /// Figures and tables at the width of a phone and at that of a desk.
  void look_at_layout(const std::string& page, std::set<Finding>& findings, Deadline deadline) {
    if (const auto narrow = run(layout_, page, findings, deadline)) add(*narrow, page, findings);
    resize(how_.desk_width, 900, deadline);
    if (const auto wide = run(layout_, page, findings, deadline)) add(*wide, page, findings);
    resize(how_.width, 844, deadline);
  }

  void resize(int width, int height, Deadline deadline) {
    browser_.call("Emulation.setDeviceMetricsOverride",
                  {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}},
                  session_, deadline);
  }

  static void add(const json& found, const std::string& page, std::set<Finding>& findings) {
    for (const json& finding : found)
      findings.insert({page, finding[0].get<std::string>(), finding[1].get<std::string>()});
  }

  static void note(const json& event, const std::string& page, std::set<Finding>& findings) {
    const std::string method = event.value("method", "");
    const json& p = event["params"];
    if (method == "Runtime.exceptionThrown") {
      const json& details = p["exceptionDetails"];
      const std::string text = details.contains("exception")
                                   ? details["exception"].value("description", details.value("text", ""))
                                   : details.value("text", "");
      findings.insert({page, "error", text.substr(0, text.find('\n'))});
    } else if (method == "Runtime.consoleAPICalled" && (p["type"] == "error" || p["type"] == "assert")) {
      std::string text = "console:";
      for (const json& argument : p["args"])
        text +=
            " " + argument.value("description", argument.contains("value") ? argument["value"].dump() : "");
      findings.insert({page, "error", text});
    } else if (method == "Log.entryAdded" && p["entry"]["level"] == "error") {
      // A request that leaves the machine is a finding by itself; its failure may come after the page is
      // done.
      const std::string url = p["entry"].value("url", "");
      if (!leaves_the_machine(url))
        findings.insert({page, "error", p["entry"].value("text", "") + " " + url});
    } else if (method == "Network.requestWillBeSent") {
      const std::string url = p["request"].value("url", "");
      if (leaves_the_machine(url)) findings.insert({page, "network", url});
    }
  }

  Checking how_;
  Browser browser_;
  std::string session_, script_, layout_, picture_;
  std::optional<std::string> frame_;  // of the page that is loaded, if other pages can be shown in it
};

/// Doxygen 1.9.4 gives friends of a class, and nested classes that are private, no place on the page that it
/// links to. The lists of members name the friends; a summary of nested classes is linked from its own page.
bool has_no_place_in_doxygen(const std::string& address, const std::string& from, const std::string& name,
                             const std::string& place, const Addresses& friends) {
  return friends.contains(address) || (place == "nested-classes" && from == name);
}

/// What is wrong with a link to `address`, if anything.
std::optional<std::string> broken(const std::string& from, const std::string& address, const fs::path& folder,
                                  const std::map<std::string, Page>& pages, const Addresses& friends) {
  if (!address.starts_with("file://")) return std::nullopt;  // out of the book, or a script's
  const std::size_t hash = address.find('#');
  const std::string place = hash == std::string::npos ? "" : decoded(address.substr(hash + 1));
  const std::string path = address.substr(7, std::min(hash, address.find('?')) - 7);
  const fs::path file = fs::path(decoded(path)).lexically_normal();
  const std::string name = file.lexically_relative(folder).string();
  if (name.starts_with("..")) return "leads out of the book: " + file.string();
  if (!fs::exists(file)) return "leads to no file: " + name;
  if (fs::is_directory(file)) return "leads to a folder: " + name;
  const auto page = pages.find(name);
  if (place.empty() || place == "top" || page == pages.end()) return std::nullopt;
  if (page->second.anchors.contains(place)) return std::nullopt;
  if (has_no_place_in_doxygen(address, from, name, place, friends)) return std::nullopt;
  return "leads to no place on its page: " + name + "#" + place;
}

/// What one browser saw of the pages that it took.
struct Seen {
  std::map<std::string, Page> pages;
  std::set<Finding> findings;
  std::string slowest;
  double slowest_seconds = 0;
};

/// Takes page after page, and picture after picture, until none is left.
Seen look_at(const std::vector<std::string>& names, std::atomic<std::size_t>& next,
             const std::string& program, const fs::path& folder, const Checking& how) {
  Seen seen;
  std::unique_ptr<Reader> reader;
  for (std::size_t i = next++; i < names.size(); i = next++) {
    const std::string& name = names[i];
    const auto begin = std::chrono::steady_clock::now();
    if (!reader) reader = std::make_unique<Reader>(program, how);
    try {
      if (name.ends_with(".svg"))
        reader->look_at_picture(folder / name, name, seen.findings);
      else
        seen.pages[name] = reader->look(folder / name, name, seen.findings);
    } catch (const BrowserLost& lost) {
      seen.findings.insert({name, "time", lost.what()});
      reader.reset();
    }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    if (time.count() > seen.slowest_seconds) {
      seen.slowest = name;
      seen.slowest_seconds = time.count();
    }
  }
  return seen;
}

}  // namespace

Checked check_pages(const std::string& program, const fs::path& given, const Checking& how) {
  const fs::path folder = fs::canonical(given);
  Checked checked{.pages = pages_under(folder), .findings = {}, .slowest = {}};
  std::vector<std::string> names = checked.pages;
  std::ranges::move(pictures_under(folder), std::back_inserter(names));
  std::atomic<std::size_t> next = 0;
  std::vector<std::future<Seen>> readers;
  for (int i = 0; i < how.browsers; ++i) {
    readers.push_back(
        std::async(std::launch::async, [&] { return look_at(names, next, program, folder, how); }));
  }
  std::map<std::string, Page> pages;
  for (auto& reader : readers) {
    Seen seen = reader.get();
    pages.merge(seen.pages);
    checked.findings.merge(seen.findings);
    if (seen.slowest_seconds > checked.slowest_seconds) {
      checked.slowest = seen.slowest;
      checked.slowest_seconds = seen.slowest_seconds;
    }
  }
  Addresses friends;
  for (const auto& [name, page] : pages) friends.insert(page.friends.begin(), page.friends.end());
  for (const auto& [name, page] : pages) {
    for (const std::string& link : page.links) {
      if (const auto what = broken(name, link, folder, pages, friends))
        checked.findings.insert({name, "link", *what});
    }
  }
  return checked;
}

std::string summary(const std::set<Finding>& findings) {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> grouped;
  for (const Finding& finding : findings) grouped[{finding.kind, finding.text}].push_back(finding.page);
  std::ostringstream out;
  for (const auto& [what, pages] : grouped) {
    out << pages.front() << ": " << what.first << ": " << what.second;
    if (pages.size() > 1) out << " (on " << pages.size() << " pages)";
    out << '\n';
  }
  return out.str();
}

}  // namespace nlmech::tests
