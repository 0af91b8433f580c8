#include "chapters/rbf_ivp/readings/readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;
using Questions = std::vector<Question>;

/// The option that explains most rows, the chosen one left aside.
const Option& best_other(const Question& q) {
  const auto less = [&](const Option& a, const Option& b) {
    const auto rank = [&](const Option& o) {
      return std::tuple(o.text != q.chosen, o.score.exact, o.score.close);
    };
    return rank(a) < rank(b);
  };
  return *std::max_element(q.options.begin(), q.options.end(), less);
}

std::string of_rows(int explained, const Score& score) {
  return fmt::format("{} of {}", explained, score.rows);
}

scene::Table tabulate(const Questions& questions) {
  scene::Table table({{"question"},
                      {"tables"},
                      {"options tried"},
                      {"text as it stands"},
                      {"explains"},
                      {"chosen"},
                      {"explains"},
                      {"within one unit"},
                      {"best of the others"},
                      {"explains"}});
  for (const Question& q : questions) {
    const Score& chosen = q.option(q.chosen).score;
    const Option& other = best_other(q);
    const bool stated = !q.literal.empty();
    table.add({q.text, q.tables, static_cast<std::int64_t>(q.options.size()),
               stated ? q.literal : "not stated",
               stated ? of_rows(q.option(q.literal).score.exact, chosen) : "", q.chosen,
               of_rows(chosen.exact, chosen), of_rows(chosen.close, chosen), other.text,
               of_rows(other.score.exact, other.score)});
  }
  return table;
}

/// Options that explain as many rows stand beside each other.
scene::Figure draw(const Questions& questions) {
  scene::Table data({{"question"}, {"name"}, {"share"}, {"offset"}, {"kind"}, {"option"}});
  int alone = 0, tried = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    const Score& chosen = q.option(q.chosen).score;
    alone += best_other(q).score.exact < chosen.exact ? 1 : 0;
    tried += static_cast<int>(q.options.size());
    std::map<int, int> standing, placed;
    for (const Option& o : q.options) ++standing[o.score.exact];
    for (const Option& o : q.options) {
      const int many = standing[o.score.exact], here = placed[o.score.exact]++;
      const double spread = many == 1 ? 0 : std::min(0.2, 0.7 / (many - 1));
      std::string text = o.text;
      std::replace(text.begin(), text.end(), ',', ';');  // the template reads this column
      data.add({static_cast<std::int64_t>(i) + 1, q.text, double(o.score.exact) / o.score.rows,
                (here - (many - 1) / 2.0) * spread,
                std::string(o.text == q.chosen    ? "chosen"
                            : o.text == q.literal ? "literal"
                                                  : "tried"),
                text});
    }
  }
  return {std::move(data),
          "rbf_ivp-readings",
          {{"heading", fmt::format("{} options tried; {} of {} choices beat all others", tried, alone,
                                   questions.size())},
           {"questions", fmt::format("{}", questions.size())}}};
}

scene::Showing show(const Questions& questions) {
  scene::Showing showing;
  showing.table = tabulate(questions);
  showing.figure = draw(questions);
  const auto promise = [&](const std::string& text, const std::string& option, int low, int high,
                           const char* reason) {
    for (const Question& q : questions) {
      if (q.text + " " + q.tables != text) continue;
      showing.quantities.push_back({fmt::format("rows explained by '{}'", option), "1",
                                    double(q.option(option).score.exact), double(low), double(high), reason});
    }
  };
  promise("end time and period 4.2", "P exact, to 100 P", 7, 9,
          "recorded: nine rows; ODE45-1 and HHT-1 lie within a tenth of a unit of the edge");
  promise("end time and period 4.2", "P = 4.77, to 500 s", 0, 3, "recorded: 500 s misses");
  promise("end time 4.4", "499 s", 5, 5,
          "tools/oracles/rbf_ivp_methods.py: all but HHT-2, probably a misprint");
  promise("alpha of HHT and its form 4.2 4.4 4.6", "alpha = -0.1, form of 1977", 4, 5,
          "recorded: all but HHT-2 of Table 4.4; HHT-1 of Table 4.2 lies on the edge");
  promise("restart of the explicit rows 4.4", "v(t_1 - h/2), read as v(t_1 - h/2), to 499 s", 2, 2,
          "both rows, of which 4.4 and x3 are tools/oracles/rbf_ivp_methods.py");
  promise("component in the explicit rows 4.6", "x3, v0 - h/2 a0, v(-h/2) first", 2, 2,
          "both rows, of which 4.4 and x3 are tools/oracles/rbf_ivp_methods.py");
  return showing;
}

}  // namespace

void add_readings(scene::Chapter& chapter) {
  const auto& tried = chapter.add_run<Questions>(
      "readings-tried", "every option of every question that the text leaves open, one question at a time",
      {}, [](Workshop& w) { return try_readings(w.quick()); });
  chapter.add({.name = "readings",
               .title = "How many readings were tried, and how many printed errors each explains",
               .place = "our own",
               .needs = {&tried},
               .show = [&tried](Workshop& w) { return show(w.result(tried)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
