#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/evidence/ratios.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/provenance.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

Json to_json(const RatioVerdict& v) {
  return {
      {"printed", v.printed}, {"ours", v.ours.middle}, {"low", v.ours.low}, {"high", v.ours.high},
      {"apart", v.apart},     {"holds", v.holds},      {"lost", v.lost()},  {"same_faster", v.same_faster}};
}

Json to_json(const TimeRatios& ratios) {
  const BuildInfo& build = build_info();
  Json json = {{"processor", processor_name()}, {"commit", build.commit}, {"dirty", build.dirty},
               {"compiler", build.compiler},    {"flags", build.flags},   {"rows", Json::array()},
               {"claims", Json::array()}};
  for (const TimeRatio& r : ratios.rows) {
    json["rows"].push_back({{"place", r.place},
                            {"row", r.row},
                            {"reference", r.reference},
                            {"printed_seconds", r.printed_seconds},
                            {"seconds", r.seconds},
                            {"verdict", to_json(r.verdict)}});
  }
  for (const RatioClaim& c : ratios.claims) {
    json["claims"].push_back({{"place", c.place},
                              {"row", c.row},
                              {"quantity", c.quantity},
                              {"over", c.over},
                              {"verdict", to_json(c.verdict)}});
  }
  return json;
}

/// What all programs measured: rows by their places, and on what.
struct Evidence {
  std::vector<Json> rows, claims;
  std::string builds;
};

Evidence read_all(const fs::path& folder) {
  Evidence all;
  for (const fs::path& file : files_with(folder, ".json")) {
    const Json json = Json::parse(read_whole(file));
    for (const Json& row : json["rows"]) all.rows.push_back(row);
    for (const Json& claim : json["claims"]) all.claims.push_back(claim);
    all.builds +=
        fmt::format("- {}: {}, {}, commit {}{}.\n", file.stem().string(),
                    json["processor"].get<std::string>(), json["compiler"].get<std::string>(),
                    json["commit"].get<std::string>(), json["dirty"].get<bool>() ? " with changes" : "");
  }
  std::stable_sort(all.rows.begin(), all.rows.end(), [](const Json& a, const Json& b) {
    return a["place"].get<std::string>() < b["place"].get<std::string>();
  });
  return all;
}

std::string text(const Json& row, const char* key) { return row[key].get<std::string>(); }
double number(const Json& row, const char* key) { return row["verdict"][key].get<double>(); }
bool is(const Json& row, const char* key) { return row["verdict"][key].get<bool>(); }
bool is_reference(const Json& row) { return text(row, "row") == text(row, "reference"); }
std::string verdict(const Json& row) { return is(row, "holds") ? "holds" : "does not hold"; }

/// "table-4.2" as a heading has it.
std::string spoken(std::string place) {
  std::replace(place.begin(), place.end(), '-', ' ');
  place.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(place.front())));
  return place;
}

std::vector<Json> compared(const Evidence& all) {
  std::vector<Json> rows;
  std::copy_if(all.rows.begin(), all.rows.end(), std::back_inserter(rows),
               [](const Json& row) { return !is_reference(row); });
  return rows;
}

/// Rows whose ratio would hold with another factor.
std::ptrdiff_t held(const std::vector<Json>& rows, double factor) {
  return std::count_if(rows.begin(), rows.end(), [factor](const Json& row) {
    return is(row, "same_faster") && number(row, "apart") <= factor;
  });
}

std::string introduction(const Evidence& all) {
  const std::vector<Json> rows = compared(all);
  return fmt::format(
      "# Ratios of run times\n\n"
      "The dissertation prints seconds of MATLAB on an unknown machine. Seconds cannot be compared; that one "
      "method took so many times longer than another can. A ratio is the time of a row's method over that of "
      "the *reference* of its table: the series (Analytic-Cont) over as many orbits in Tables 3.2 and 3.3, "
      "collocation with 35 nodes (RBF-Coll-2) in Tables 4.2, 4.4 and 4.6. Above 1 the reference, the "
      "source's "
      "own method, is the faster one. Each run has the setting of its row and is the one whose error stands "
      "in "
      "our table of that name; all run in one process and one thread, repeated in random order after a run "
      "that warms up. *Ours* is the ratio of medians; *from* and *to* are the ratios of opposite "
      "quartiles.\n\n"
      "A printed ratio *holds* if the same of the two methods is the faster one here, and the two ratios are "
      "at most a factor of {:g} apart: ratios of compiled programs moved by up to a half between the "
      "machines "
      "that we tried, and printed digits leave a tenth or two more. What is further off says more of two "
      "programs, and of MATLAB's interpreter, where a step costs the same whatever it computes, than of two "
      "methods. Of {} ratios {} hold; with factors of 2, 5 and 10 it would be {}, {} and {}. No test asserts "
      "a "
      "time. Written by `make bench`.\n",
      allowed_factor, rows.size(), held(rows, allowed_factor), held(rows, 2), held(rows, 5), held(rows, 10));
}

std::string lost_cases(const Evidence& all) {
  std::vector<Json> lost;
  for (const Json& row : compared(all)) {
    if (is(row, "lost")) lost.push_back(row);
  }
  std::stable_sort(lost.begin(), lost.end(),
                   [](const Json& a, const Json& b) { return number(a, "apart") > number(b, "apart"); });
  Table table({{"table"}, {"method"}, {"over"}, {"printed"}, {"ours"}, {"from"}, {"to"}, {"apart"}});
  for (const Json& row : lost) {
    table.add({text(row, "place").substr(6), text(row, "row"), text(row, "reference"), number(row, "printed"),
               number(row, "ours"), number(row, "low"), number(row, "high"), number(row, "apart")});
  }
  return "\n## Faster in print, slower here\n\n" +
         (lost.empty() ? "In no row.\n"
                       : "The reference wins in print, and loses here to the method of the row; "
                         "furthest apart first.\n\n" +
                             table.markdown());
}

std::string claims_in_prose(const Evidence& all) {
  Table table(
      {{"claim"}, {"orbit"}, {"of"}, {"printed"}, {"ours"}, {"from"}, {"to"}, {"apart"}, {"verdict"}});
  for (const Json& c : all.claims) {
    table.add({text(c, "place").substr(6), text(c, "row"), text(c, "quantity"), number(c, "printed"),
               number(c, "ours"), number(c, "low"), number(c, "high"), number(c, "apart"), verdict(c)});
  }
  return "\n## Claims in prose\n\nThe text says \"on average\", and the mean of the printed rows over 5, 10 "
         "and 20 orbits gives its "
         "numbers; ours is the same mean.\n\n" +
         table.markdown();
}

std::string tables(const Evidence& all) {
  std::string page;
  for (auto row = all.rows.begin(); row != all.rows.end();) {
    const std::string place = text(*row, "place");
    Table table({{"method"},
                 {"printed (s)", 6},
                 {"ours (s)"},
                 {"printed ratio"},
                 {"ours"},
                 {"from"},
                 {"to"},
                 {"apart"},
                 {"verdict"}});
    for (; row != all.rows.end() && text(*row, "place") == place; ++row) {
      table.add({text(*row, "row"), (*row)["printed_seconds"].get<double>(), (*row)["seconds"].get<double>(),
                 number(*row, "printed"), number(*row, "ours"), number(*row, "low"), number(*row, "high"),
                 number(*row, "apart"), is_reference(*row) ? "reference" : verdict(*row)});
    }
    page += fmt::format("\n## {}\n\n{}", spoken(place), table.markdown());
  }
  return page;
}

/// What pages may quote.
Json quantities(const Evidence& all) {
  Json list = Json::array();
  const auto add = [&list](const std::string& name, const Json& value, const char* unit) {
    list.push_back({{"name", name}, {"value", value}, {"unit", unit}});
  };
  const auto add_ratio = [&add](const std::string& name, const Json& row) {
    add(name + ", printed", number(row, "printed"), "1");
    add(name + ", ours", number(row, "ours"), "1");
    add(name + ", verdict", verdict(row), "");
  };
  for (const Json& row : all.rows)
    add(fmt::format("{}, {}, printed seconds over ours", text(row, "place"), text(row, "row")),
        row["printed_seconds"].get<double>() / row["seconds"].get<double>(), "1");
  const std::vector<Json> rows = compared(all);
  const auto lost = std::count_if(rows.begin(), rows.end(), [](const Json& row) { return is(row, "lost"); });
  add("ratios", rows.size(), "1");
  add("ratios that hold", held(rows, allowed_factor), "1");
  add("faster in print, slower here", lost, "1");
  for (const Json& row : rows) add_ratio(text(row, "place") + ", " + text(row, "row"), row);
  for (const Json& c : all.claims)
    add_ratio(fmt::format("{}, {}, {}", text(c, "place"), text(c, "row"), text(c, "quantity")), c);
  return {{"quantities", list}};
}

}  // namespace

void write_ratios(const std::string& name, const TimeRatios& ratios, const fs::path& out) {
  const fs::path folder = out / "results" / "ratios";
  write_whole(folder / (name + ".json"), to_json(ratios).dump(2) + "\n");
  const Evidence all = read_all(folder);
  write_whole(out / "tables" / "RATIOS.md", introduction(all) + lost_cases(all) + claims_in_prose(all) +
                                                tables(all) + "\n## Measured on\n\n" + all.builds);
  write_whole(out / "tables" / "ratios.json", quantities(all).dump(2) + "\n");
}

}  // namespace nlmech::scene
