#include "tools/reproduction/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "nlmech/scene/evidence/check.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "tools/reproduction/guide.hpp"

namespace nlmech::reproduction {
namespace fs = std::filesystem;
using namespace scene;

namespace {

const std::vector<std::string> header = {"source",   "place", "chapter", "claim",  "scene",
                                         "quantity", "means", "verdict", "reading"};
constexpr std::array verdicts = {Verdict::holds, Verdict::does_not_hold, Verdict::not_stated};
/// Evidence that is no scene: pages beside this one.
constexpr std::string_view printed_numbers = "REPRODUCTION", run_time_ratios = "RATIOS";
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Range {
  double low, high;
};

Range parse_range(std::string_view words) {
  Range range{-infinite, infinite};
  bool right = false;
  if (words.starts_with("at least ")) {
    right = parse_number(words.substr(9), range.low);
  } else if (words.starts_with("at most ")) {
    right = parse_number(words.substr(8), range.high);
  } else if (const auto to = words.find(" to "); to != std::string_view::npos) {
    right = parse_number(words.substr(0, to), range.low) && parse_number(words.substr(to + 4), range.high) &&
            range.low <= range.high;
  }
  if (!right) {
    throw input_error("'{}' is not of the form 'at least 2', 'at most 2' or '1 to 2'", echoed(words));
  }
  return range;
}

void refuse(bool wrong, const std::string& where, const std::string& what) {
  if (wrong) throw input_error("{}: {}", where, what);
}

Verdict parse_verdict(const std::string& text, const std::string& where) {
  const auto* v =
      std::find_if(verdicts.begin(), verdicts.end(), [&](Verdict other) { return to_string(other) == text; });
  refuse(v == verdicts.end(), where, fmt::format("'{}' is no verdict on a claim", echoed(text)));
  return *v;
}

Claim to_claim(const CsvRecord& record, const std::string& file) {
  const std::string where = fmt::format("{}: line {}", file, record.line);
  const auto& c = record.cells;
  refuse(c.size() != header.size(), where, fmt::format("{} of {} cells", c.size(), header.size()));
  Claim claim{c[0], c[1], c[2], c[3], c[4], c[5], c[6], parse_verdict(c[7], where), c[8]};
  refuse(claim.text.empty(), where, "no claim");
  const bool judged = claim.expected != Verdict::not_stated;
  refuse(judged && (claim.scene.empty() || claim.quantity.empty()), where, "a verdict without evidence");
  refuse(judged == claim.means.empty(), where, "what a claim means for its quantity: of each that is judged");
  refuse(!judged && claim.reading.empty(), where, "not stated, and not said what is left out");
  try {
    if (judged) static_cast<void>(parse_range(claim.means));
  } catch (const InputError& error) {
    throw input_error("{}: {}", where, error.what());
  }
  return claim;
}

using Values = std::map<std::string, double>;

/// Quantities by name, of one file that a check or a measurement left.
Values read_quantities(const fs::path& file) {
  Values found;
  if (!fs::exists(file)) return found;
  const auto json = nlohmann::json::parse(read_whole(file), nullptr, false);
  if (json.is_discarded()) throw input_error("{}: no JSON", file.string());
  for (const auto& quantity : json.value("quantities", nlohmann::json::array())) {
    if (quantity.contains("value") && quantity["value"].is_number())
      found[quantity.value("name", "")] = quantity["value"].get<double>();
  }
  return found;
}

/// What was measured for a printed number of the source: by the text as it stands, where that says enough.
Values measured_of(const std::string& source, const std::vector<Checked>& checks) {
  Values found;
  for (const Checked& c : checks) {
    const std::optional<double> ours = c.measured.nominal ? c.measured.nominal : c.measured.inferred;
    if (c.value.source == source && ours) found[c.value.name().substr(source.size() + 1)] = *ours;
  }
  return found;
}

/// The range in place of such a number, where rounding decides which number of it is found; else empty.
std::string range_of(const Claim& claim, const std::vector<Checked>& checks) {
  if (claim.scene != printed_numbers) return "";
  const auto found = std::ranges::find_if(checks, [&](const Checked& c) {
    return c.value.source == claim.source && c.value.name() == claim.source + "/" + claim.quantity;
  });
  return found == checks.end() || range_by_rounding(found->value).empty() ? "" : nominal_text(*found);
}

Verdict verdict_of(const Claim& claim, double value) {
  if (claim.expected == Verdict::not_stated) return Verdict::not_stated;
  return within(claim.means, value) ? Verdict::holds : Verdict::does_not_hold;
}

/// Where the evidence can be read, as a link from the folder `tables`.
std::string evidence(const JudgedClaim& c) {
  if (c.claim.scene.empty()) return "";
  const bool page = c.claim.scene == printed_numbers || c.claim.scene == run_time_ratios;
  const std::string scene = page ? fmt::format("[{0}]({0}.md)", c.claim.scene)
                                 : fmt::format("[{0}]({1}#{0})", c.claim.scene, Guide::page(c.claim.chapter));
  return c.claim.quantity.empty() ? scene : fmt::format("{}: {}", scene, c.claim.quantity);
}

Table totals(const std::vector<JudgedClaim>& claims) {
  Table table({{"source"}, {"holds"}, {"does not hold"}, {"not stated"}});
  std::vector<std::string> sources;
  for (const JudgedClaim& c : claims) {
    if (std::find(sources.begin(), sources.end(), c.claim.source) == sources.end())
      sources.push_back(c.claim.source);
  }
  for (const std::string& source : sources) {
    std::vector<Cell> row = {source};
    for (const Verdict v : verdicts) {
      row.emplace_back(
          static_cast<std::int64_t>(std::count_if(claims.begin(), claims.end(), [&](const JudgedClaim& c) {
            return c.claim.source == source && c.claim.expected == v;
          })));
    }
    table.add(std::move(row));
  }
  return table;
}

Cell shown_value(const JudgedClaim& c) {
  if (!c.range.empty()) return c.range;
  return std::isnan(c.value) ? Cell("") : Cell(c.value);
}

}  // namespace

bool within(std::string_view words, double value) {
  const Range range = parse_range(words);
  return value >= range.low && value <= range.high;
}

std::vector<Claim> parse_claims(std::string_view text, const std::string& file) {
  const auto records = parse_csv(text, file);
  refuse(records.empty() || records[0].cells != header, file, "the header is another one");
  std::vector<Claim> claims;
  for (std::size_t i = 1; i < records.size(); ++i) claims.push_back(to_claim(records[i], file));
  return claims;
}

std::vector<JudgedClaim> judge_claims(const std::vector<std::string>& built, const fs::path& data_folder,
                                      const fs::path& out) {
  const fs::path list = data_folder / "tables" / "claims.csv";
  const std::vector<Checked> checks = collect_checks(built, data_folder, out);
  const auto values_for = [&](const Claim& claim) {
    if (claim.scene == printed_numbers) return measured_of(claim.source, checks);
    if (claim.scene == run_time_ratios) return read_quantities(data_folder / "tables" / "ratios.json");
    return read_quantities(out / "results" / claim.chapter / (claim.scene + ".json"));
  };
  std::vector<JudgedClaim> judged;
  const std::vector<Place> places = read_places(data_folder);
  for (Claim& claim : parse_claims(read_whole(list), list.string())) {
    refuse(std::none_of(places.begin(), places.end(),
                        [&](const Place& place) { return place.chapter == claim.chapter; }),
           list.string(), fmt::format("no chapter '{}' in places.csv", echoed(claim.chapter)));
    JudgedClaim j{std::move(claim), std::nan(""), "", Verdict::not_built, true};
    if (std::find(built.begin(), built.end(), j.claim.chapter) != built.end()) {
      const Values values = values_for(j.claim);
      const auto value = values.find(j.claim.quantity);
      const bool there = value != values.end();
      if (there) j.value = value->second;
      j.range = range_of(j.claim, checks);
      j.verdict = verdict_of(j.claim, j.value);
      j.passes = j.verdict == j.claim.expected && (there || j.claim.quantity.empty());
    }
    judged.push_back(std::move(j));
  }
  return judged;
}

std::string claims_page(const std::vector<JudgedClaim>& claims) {
  std::string page =
      "# Claims in prose\n\n"
      "What the sources say in words and a computation can decide, a row each, in our words. The claim "
      "*holds* "
      "if the quantity of the scene beside it lies where the claim puts it; a text that leaves out what "
      "would decide is *not stated*. Numbers in tables are judged one by one in "
      "[Published beside reproduced](REPRODUCTION.md). Written by `make check` from "
      "`tables/claims.csv`.\n\n" +
      totals(claims).markdown();
  std::vector<std::pair<std::string, Table>> sources;
  for (const JudgedClaim& c : claims) {
    if (sources.empty() || sources.back().first != c.claim.source) {
      sources.emplace_back(c.claim.source, Table({{"place"},
                                                  {"chapter"},
                                                  {"claim"},
                                                  {"evidence"},
                                                  {"value", 3},
                                                  {"claimed"},
                                                  {"verdict"},
                                                  {"reading"}}));
    }
    sources.back().second.add({c.claim.place, c.claim.chapter, c.claim.text, evidence(c), shown_value(c),
                               c.claim.means, std::string(to_string(c.verdict)), c.claim.reading});
  }
  for (const auto& [source, table] : sources)
    page += fmt::format("\n## Claims of {}\n\n{}", source, table.markdown());
  return page;
}

}  // namespace nlmech::reproduction
