#include "tools/reproduction/completeness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "tools/reproduction/guide.hpp"

namespace nlmech::reproduction {
namespace fs = std::filesystem;
using namespace scene;

namespace {

/// Rows of a CSV file without its header; none if there is no such file.
std::size_t rows_of(const fs::path& file) {
  if (!fs::exists(file)) return 0;
  const auto records = parse_csv(read_whole(file), file.string());
  return records.empty() ? 0 : records.size() - 1;
}

/// Gnuplot gives every curve a group of its own, named by the terminal of style.gp; one without a stroke or a
/// mark shows nothing.
bool has_curves(const fs::path& picture) {
  if (!fs::exists(picture)) return false;
  const std::string svg = read_whole(picture);
  const auto curve = svg.find("id=\"nlmech_plot_1");
  if (curve == std::string::npos) return false;
  return svg.find("<path", curve) != std::string::npos || svg.find("<use", curve) != std::string::npos ||
         svg.find("<polygon", curve) != std::string::npos || svg.find("<image", curve) != std::string::npos;
}

/// The quantities of a scene, out of its provenance.
void count_quantities(const fs::path& file, Shown& shown) {
  if (!fs::exists(file)) return;
  const auto json = nlohmann::json::parse(read_whole(file), nullptr, false);
  if (json.is_discarded()) throw input_error("{}: no JSON", file.string());
  for (const auto& quantity : json.value("quantities", nlohmann::json::array())) {
    ++shown.checked;
    if (quantity.value("passes", false)) ++shown.passed;
  }
}

/// What one scene left, added to the others of its place.
void count_scene(const fs::path& out, const std::string& scene, Shown& s) {
  const bool figure = s.place.kind == "figure";
  const std::size_t numbers = rows_of(out / (figure ? "results" : "tables") / (scene + ".csv"));
  s.numbers += numbers;
  s.drawn = s.drawn && numbers > 0 && (!figure || has_curves(out / "figures" / (scene + ".svg")));
  count_quantities(out / "results" / (scene + ".json"), s);
}

/// Links as they read from the folder `tables`.
std::string links(const Shown& s) {
  if (!s.built || !s.drawn) return s.place.name;
  std::string text;
  for (const std::string& scene : s.place.scenes)
    text +=
        fmt::format("{}[{}]({}#{})", text.empty() ? "" : ", ", scene, Guide::page(s.place.chapter), scene);
  return s.place.scenes.front() == s.place.name ? text : s.place.name + ": " + text;
}

std::string state(const Shown& s) {
  if (!s.built) return "not built";
  return s.complete() ? "complete" : "INCOMPLETE";
}

Cell count(std::size_t number) { return static_cast<std::int64_t>(number); }

Table totals(const std::vector<Shown>& shown) {
  struct Total {
    std::int64_t figures = 0, tables = 0, quantities = 0, incomplete = 0;
  };
  std::map<std::string, Total> by_source;
  for (const Shown& s : shown) {
    Total& total = by_source[s.place.source];
    ++(s.place.kind == "figure" ? total.figures : total.tables);
    total.quantities += static_cast<std::int64_t>(s.checked);
    if (!s.complete()) ++total.incomplete;
  }
  Table table({{"source"}, {"figures"}, {"tables"}, {"quantities checked"}, {"incomplete"}});
  for (const auto& [source, t] : by_source)
    table.add({source, t.figures, t.tables, t.quantities, t.incomplete});
  return table;
}

}  // namespace

std::vector<Shown> collect_shown(const std::vector<std::string>& built, const fs::path& data_folder,
                                 const fs::path& out) {
  const std::vector<PublishedValue> values = read_published(data_folder);
  std::vector<Shown> shown;
  for (Place& place : read_places(data_folder)) {
    if (place.kind != "figure" && place.kind != "table") continue;
    Shown s{std::move(place), false, false, 0, 0, 0, 0};
    s.built = std::find(built.begin(), built.end(), s.place.chapter) != built.end();
    s.drawn = true;
    for (const std::string& name : s.place.scenes) count_scene(out, s.place.chapter + "/" + name, s);
    s.published =
        static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [&](const PublishedValue& v) {
          return v.source == s.place.source && v.place == s.place.name;
        }));
    shown.push_back(std::move(s));
  }
  return shown;
}

std::string completeness_page(const std::vector<Shown>& shown) {
  std::string page =
      "# What is shown\n\n"
      "Every figure and table of the sources is a scene: drawn anew, with quantities that are checked "
      "against "
      "independent values each time. *Complete* means that there are curves or rows, at least one such "
      "quantity, and that all pass. Written by `make check`.\n\n" +
      totals(shown).markdown();
  std::map<std::string, std::vector<const Shown*>> by_source;
  for (const Shown& s : shown) by_source[s.place.source].push_back(&s);
  for (const auto& [source, entries] : by_source) {
    Table table({{"scene"},
                 {"chapter"},
                 {"subject"},
                 {"rows of data"},
                 {"checks that pass"},
                 {"numbers printed"},
                 {"state"}});
    for (const Shown* s : entries) {
      table.add({links(*s), s->place.chapter, s->place.subject, count(s->numbers), count(s->passed),
                 count(s->published), state(*s)});
    }
    page += fmt::format("\n## Figures and tables of {}\n\n{}", source, table.markdown());
  }
  return page;
}

}  // namespace nlmech::reproduction
