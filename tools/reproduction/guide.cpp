#include "tools/reproduction/guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "nlmech/scene/program/files.hpp"

namespace nlmech::reproduction {
namespace fs = std::filesystem;
using namespace scene;

namespace {

/// The lines "name: title" of `docs/chapters.txt`.
std::map<std::string, std::string> read_titles(const fs::path& file) {
  std::map<std::string, std::string> titles;
  if (!fs::exists(file)) return titles;
  std::istringstream lines(read_whole(file));
  for (std::string line; std::getline(lines, line);) {
    const auto colon = line.find(": ");
    if (!line.starts_with('#') && colon != std::string::npos)
      titles[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return titles;
}

/// The files under the folder that define a test, by "Suite.Name".
std::map<std::string, std::vector<fs::path>> read_tests(const fs::path& top) {
  static const std::regex test(R"(\nTEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
  std::map<std::string, std::vector<fs::path>> files;
  if (!fs::exists(top / "tests")) return files;
  for (const auto& entry : fs::recursive_directory_iterator(top / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_whole(entry.path());
    for (auto at = std::sregex_iterator(text.begin(), text.end(), test); at != std::sregex_iterator(); ++at)
      files[(*at)[1].str() + "." + (*at)[2].str()].push_back(fs::relative(entry.path(), top));
  }
  return files;
}

bool upper(char c) { return c >= 'A' && c <= 'Z'; }
bool lower(char c) { return c >= 'a' && c <= 'z'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// The name of a test as a sentence, which a narrow column may break: "Table2_6_TheSign" is "Table 2.6 the
/// sign".
std::string in_words(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i], before = i > 0 ? name[i - 1] : '_',
               after = i + 1 < name.size() ? name[i + 1] : '_';
    if (c == '_') {
      text += digit(before) && digit(after) ? '.' : ' ';
      continue;
    }
    const bool begins = (upper(c) && (lower(before) || digit(before) || (upper(before) && lower(after)))) ||
                        (digit(c) && lower(before));
    if (begins) text += ' ';
    const bool article = c == 'A' && lower(before) && upper(after);
    text += (upper(c) && lower(after) && !text.empty()) || article ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

}  // namespace

Guide::Guide(const fs::path& data_folder)
    : places_(read_places(data_folder)),
      titles_(read_titles(data_folder / "docs" / "chapters.txt")),
      tests_(read_tests(data_folder)) {}

std::string Guide::chapter_title(const std::string& chapter) const {
  const auto title = titles_.find(chapter);
  return title == titles_.end() ? chapter : title->second;
}

std::ptrdiff_t Guide::rank(const std::string& chapter) const {
  return std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.chapter == chapter; }) -
         places_.begin();
}

std::string Guide::page(const std::string& chapter) { return fmt::format("../docs/chapters/{}.md", chapter); }

std::string Guide::link(const std::string& chapter, const std::string& source, const std::string& place,
                        const std::string& text) const {
  const auto found = std::find_if(places_.begin(), places_.end(), [&](const Place& p) {
    return p.source == source && p.name == place && p.chapter == chapter;
  });
  const bool shown = found != places_.end() && (found->kind == "figure" || found->kind == "table");
  return fmt::format("[{}]({}{})", text, page(chapter), shown ? "#" + found->scenes.front() : "");
}

std::string Guide::link_words(const std::string& chapter, const std::string& source,
                              const std::string& words) const {
  static const std::regex form(R"((Table|Figure|Fig\.) (\w+(?:\.\w+)?)((?:,| ).*)?)");
  std::smatch match;
  if (!std::regex_match(words, match, form)) return words;
  const std::string place = (match[1] == "Table" ? "table-" : "fig-") + match[2].str();
  const auto known = std::any_of(places_.begin(), places_.end(), [&](const Place& p) {
    return p.source == source && p.name == place && p.chapter == chapter;
  });
  if (!known) return words;
  return link(chapter, source, place, match[1].str() + " " + match[2].str()) + match[3].str();
}

std::string Guide::test_link(const std::string& test) const {
  const auto colon = test.find(':');
  const auto found = colon == std::string::npos ? tests_.end() : tests_.find(test.substr(colon + 1));
  if (found == tests_.end()) return "`" + test + "`";
  // Several programs may have a test of one name: "unit_frames" is made of the folder "frames".
  const std::string folder = test.substr(test.find('_') + 1, colon - test.find('_') - 1);
  const auto own = std::find_if(found->second.begin(), found->second.end(), [&](const fs::path& file) {
    return std::find(file.begin(), file.end(), folder) != file.end();
  });
  const fs::path& file = own == found->second.end() ? found->second.front() : *own;
  return fmt::format("[{}](../{})", in_words(test.substr(test.find('.') + 1)), file.generic_string());
}

std::string source_title(const std::string& source) {
  static const std::map<std::string, std::string> titles = {
      {"elgohary", "T. A. Elgohary, dissertation, Texas A&M University (2015)"},
      {"filipich-rosales",
       "C. P. Filipich and M. B. Rosales, A straightforward approach to solve ordinary nonlinear "
       "differential systems"},
      {"laier", "J. E. Laier, High-order algorithm for non-linear dynamics"},
      {"roy", "D. Roy, A multi-step transversal linearization method in nonlinear dynamics"}};
  const auto title = titles.find(source);
  return title == titles.end() ? source : title->second;
}

std::string section_link(std::string_view page, const std::string& chapter, const std::string& text) {
  return fmt::format("[{}](#{}_{})", text, page, chapter);
}

std::string section_mark(std::string_view page, const std::string& chapter) {
  return fmt::format("<a id=\"{}_{}\"></a>", page, chapter);
}

}  // namespace nlmech::reproduction
