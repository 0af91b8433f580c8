#include "chapters/transversal/overflow.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "chapters/transversal/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double end = 40;

/// h = 0.01, 0.02, ..., 0.5, or less of it.
std::vector<double> steps(bool quick) {
  std::vector<double> all;
  for (int k = 1; k <= 50; ++k) {
    if (!quick || k % 5 == 0 || (k > 17 && k < 24) || (k > 29 && k < 38)) all.push_back(k / 100.);
  }
  return all;
}

ivp::NamedIntegrator<2> method(const std::string& name, double step) {
  return name.starts_with("mtl") ? transversal(step, name.back() - '0') : classical(name, step);
}

Fates fates(double e2, bool quick) {
  const problems::DrivenDuffing problem = stand_in(e2);
  const Truth truth(problem, {0, 0}, 0, end);
  Fates all;
  for (int i = 0; i <= 4000; ++i)
    all.amplitude = std::max(all.amplitude, std::abs(static_cast<double>(truth(end * i / 4000.0L)[0])));
  for (const std::string name : {"rk4", "rk6", "mtl 3", "mtl 4", "mtl 5"}) {
    for (const double h : steps(quick)) {
      const Course c = course(problem, {0, 0}, end, method(name, h), &truth);
      all.fates.push_back({name, h, std::string(to_string(c.status.outcome())), c.error, c.largest});
    }
  }
  return all;
}

}  // namespace

double Fates::overflow_from(const std::string& name) const {
  for (const Fate& f : fates) {
    if (f.method == name && f.status == "non_finite") return f.step;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const Fate& Fates::at(const std::string& name, double step) const {
  for (const Fate& f : fates) {
    if (f.method == name && std::abs(f.step - step) < 1e-9) return f;
  }
  throw std::out_of_range("no run of " + name + " with the step " + std::to_string(step));
}

namespace {

void add_quantities(const std::string& label, const Fates& all, const std::vector<double>& known,
                    std::vector<scene::Quantity>& out) {
  const char* recorded = "recorded; steps in hundredths are the resolution";
  out.push_back(scene::near("RK6 overflows from h, " + label, "1", all.overflow_from("rk6"), known[0],
                            0.0101 / known[0], recorded));
  out.push_back(scene::near("RK4 overflows from h, " + label, "1", all.overflow_from("rk4"), known[1],
                            0.0101 / known[1], recorded));
  const Fate& bounded = all.at("mtl 3", 0.21);
  out.push_back({"error of p = 3 at h = 0.21 over the amplitude, " + label, "1",
                 bounded.error / all.amplitude, 0.5, 3,
                 "no digit is right, and twice the amplitude and a little is all that bounded motions can be "
                 "apart"});
  double wild = std::numeric_limits<double>::quiet_NaN();
  for (const Fate& f : all.fates) {
    if (f.method == "mtl 3" && f.status == "success" && f.error > 10 * all.amplitude) {
      wild = f.step;
      break;
    }
  }
  out.push_back({"p = 3 errs by ten amplitudes from h, " + label, "1", wild, 0.22, 0.5,
                 "beyond the 0.21 of the paper; nothing bounds the roots that a block's equations may have"});
  out.push_back({"error of RK6 over that of p = 3 at h = 0.1, " + label, "1",
                 all.at("rk6", 0.1).error / all.at("mtl 3", 0.1).error, 0, 0.5,
                 "order 6 against 4; a seventh and a quarter are recorded"});
}

/// "RK6"; "MTL p = 3" with an italic p and blanks that survive beside it.
std::string in_legend(const std::string& name) {
  if (name.starts_with("mtl")) return "MTL \u200b{/:Italic p}\u200b = " + name.substr(4);
  return "RK" + name.substr(2);
}

scene::Showing show(const Fates& soft, const Fates& stiff) {
  scene::Table data({{"series", 3, true}, {"step"}, {"error"}, {"overflow"}});
  scene::Table table({{"method"},
                      {"h"},
                      {"error, e2 = 0.5", 2},
                      {"ends, e2 = 0.5"},
                      {"error, e2 = 1", 2},
                      {"ends, e2 = 1"}});
  std::int64_t number = 0;
  std::string legend, last, crosses;
  const auto cell = [](const Fate& f) {
    return scene::to_cell(std::isfinite(f.error) ? std::optional(f.error) : std::nullopt);
  };
  for (std::size_t i = 0; i < soft.fates.size(); ++i) {
    const Fate &f = soft.fates[i], &g = stiff.fates[i];
    if (f.method != last) {
      ++number;
      last = f.method;
      legend += (legend.empty() ? "" : "|") + in_legend(last);
    }
    std::optional<double> cross;
    if (!std::isfinite(f.error)) cross = 20 * std::pow(1.5, static_cast<double>(number - 1));
    data.add({number, f.step, cell(f), scene::to_cell(cross)});
    const std::string word = std::to_string(number);
    if (cross && !crosses.ends_with(word)) crosses += (crosses.empty() ? "" : " ") + word;
    const int hundredths = static_cast<int>(std::lround(f.step * 100));
    if (hundredths == 5 || hundredths == 10 || hundredths == 15 || hundredths == 20 || hundredths == 21 ||
        hundredths == 30)
      table.add({f.method, f.step, cell(f), f.status, cell(g), g.status});
  }
  scene::Showing showing;
  showing.table = std::move(table);
  showing.figure = {
      std::move(data),
      "transversal-steps",
      {{"heading", "Bounded is not accurate: at \u200b{/:Italic h}\u200b = 0.21 nothing is right"},
       {"legend", legend},
       {"xrange", "[8e-3:0.6]"},
       {"yrange", "[1e-9:300]"},
       {"xlabel", "step \u200b{/:Italic h}\u200b (periods of the force)"},
       {"ylabel", "greatest error of \u200b{/:Italic x}\u200b to \u200b{/:Italic t}\u200b = 40"},
       {"level", fmt::format("{:.6g}", soft.amplitude)},
       {"level_words", "amplitude of the motion"},
       {"mark", "0.21"},
       {"crosses", crosses},
       {"overflow_words", "overflow or no root"}}};
  add_quantities("e2 = 0.5", soft, {0.19, 0.31}, showing.quantities);
  add_quantities("e2 = 1", stiff, {0.20, 0.36}, showing.quantities);
  return showing;
}

}  // namespace

static const scene::Run<Fates>& add_fates_run(scene::Chapter& chapter, double e2) {
  return chapter.add_run<Fates>(
      fmt::format("fates-e2-{}", e2),
      fmt::format(
          "stand-in parameters e1 = 0.25, e2 = {}, e3 = 0.5, from rest to t = 40; RK6 is Butcher's of 7 "
          "stages",
          e2),
      {}, [e2](Workshop& w) { return fates(e2, w.quick()); });
}

void add_transversal_overflow(scene::Chapter& chapter) {
  const auto& soft = add_fates_run(chapter, 0.5);
  const auto& stiff = add_fates_run(chapter, 1);
  chapter.add({.name = "overflow",
               .title = "RK4, RK6 and MTL against the step: bounded is not accurate",
               .place = "our own, for Figure 2",
               .needs = {&soft, &stiff},
               .show = [&soft, &stiff](Workshop& w) { return show(w.result(soft), w.result(stiff)); }});
  chapter.add({.name = "roy/fig-2/sixth-order Runge-Kutta/overflows at step",
               .needs = {&soft},
               .measure = [&soft](Workshop& w) {
                 return scene::Measured{{}, w.result(soft).overflow_from("rk6")};
               }});
}

}  // namespace nlmech::chapters
