/// Claim of section 4.4.2: RBF-Coll "may be a useful method" for aperiodic and chaotic responses.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/ivp/collocation.hpp"
#include "nlmech/ivp/dormand_prince.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

constexpr double half = 50, end = 100;
constexpr double tolerated = 0.01;  // error over amplitude, of a run that follows a motion

/// A motion of u'' + 0.05 u' + u^3 = B cos t from u = 3, u' = 4, to t = 100.
struct Motion {
  std::string name;
  ivp::System<2> system;
  ivp::State<2> x0;
  std::function<Vector<Extended, 2>(double)> reference;
  double amplitude;  ///< greatest |u|
};

Motion make_motion(const std::string& name, bool forced) {
  using Exact = problems::BasicForcedDuffing<Extended>;
  problems::ForcedDuffing problem;
  Exact exact;
  if (!forced) {
    problem.force = 0;
    exact.force = 0;
  }
  const auto x0 = problems::ForcedDuffing::initial_state();
  const auto trajectory = std::make_shared<const problems::ReferenceTrajectory<Extended, Exact>>(
      exact, x0.cast<Extended>(), 0, end);
  const auto at = [trajectory](double t) -> Vector<Extended, 2> { return (*trajectory)(t); };
  double amplitude = 0;
  for (int i = 0; i <= 4000; ++i)
    amplitude = std::max(amplitude, static_cast<double>(std::abs(at(end * i / 4000)[0])));
  return {name, ivp::System<2>(problem), x0, at, amplitude};
}

/// What a method makes of a motion.
struct Result {
  std::string method;
  std::string setting;
  std::int64_t steps = 0;                 ///< made
  double mean_step = 0;                   ///< 0 if it did not come to the end
  std::optional<double> at_half, at_end;  ///< |error of u| there
  double followed = end;                  ///< till the end of a step whose error exceeds 1 % of the amplitude
  std::int64_t right_hand_sides = 0;

  [[nodiscard]] bool follows() const { return at_end && followed == end; }
};

/// From 0 to 50, and from the state found there to 100.
template <class Method>
Result follow(const Motion& m, const std::string& name, const std::string& setting, const Method& method) {
  Result r;
  r.method = name;
  r.setting = setting;
  const auto error = [&m](double t, const ivp::State<2>& x) {
    return static_cast<double>(std::abs(Extended(x[0]) - m.reference(t)[0]));
  };
  const auto watch = [&](const ivp::Step<2>& step) {
    if (r.followed == end && !(error(step.t1, step.x1) <= tolerated * m.amplitude)) r.followed = step.t1;
    return true;
  };
  double t = 0;
  ivp::State<2> x = m.x0;
  for (const double until : {half, end}) {
    const auto part = ivp::integrate(m.system, x, t, until, method, ivp::Observer<2>(watch));
    r.steps += part.statistics.steps;
    r.right_hand_sides += part.statistics.right_hand_sides;
    if (!part.status.ok()) {
      r.followed = std::min(r.followed, part.t);
      return r;
    }
    t = until;
    x = part.x;
    (until == half ? r.at_half : r.at_end) = error(until, x);
  }
  r.mean_step = end / static_cast<double>(r.steps);
  return r;
}

constexpr std::array tolerances = {1e-4, 1e-6, 1e-9, 1e-13};

/// All runs on a motion: collocations with 8 to 512 steps to t = 50, and ode45.
struct Runs {
  Motion motion;
  std::vector<Result> all;

  [[nodiscard]] const Result& of(const std::string& method, const std::string& setting) const {
    const auto is = [&](const Result& r) { return r.method == method && r.setting == setting; };
    const auto found = std::find_if(all.begin(), all.end(), is);
    if (found == all.end()) throw std::out_of_range("no run of " + method + ", " + setting);
    return *found;
  }
  /// The run with the longest step that follows the motion to t = 100.
  [[nodiscard]] const Result& longest(const std::string& method) const {
    const Result* best = nullptr;
    for (const Result& r : all) {
      if (r.method == method && r.follows() && (best == nullptr || r.mean_step > best->mean_step)) best = &r;
    }
    if (best == nullptr) throw std::out_of_range(method + " follows with no step");
    return *best;
  }
};

std::string steps_to_half(int steps) { return fmt::format("{} steps to 50", steps); }

Runs run_all(Motion motion) {
  Runs runs{std::move(motion), {}};
  const auto add = [&runs](const std::string& name, const std::string& setting, const auto& method) {
    runs.all.push_back(follow(runs.motion, name, setting, method));
  };
  for (int k = 0; k <= 24; ++k) {
    const int steps = static_cast<int>(std::lround(8 * std::pow(2, k / 4.0)));
    const std::string setting = steps_to_half(steps);
    const double h = half / steps, shape = 0.77 * duffing_period() / 10 / h;  // c h of Table 4.2
    add("RBF-Coll, N = 7", setting, ivp::RbfCollocation{.step = h, .nodes = 7, .shape = shape});
    add("polynomials, N = 7", setting, ivp::PolynomialCollocation{.step = h, .nodes = 7});
    if (steps > 128) continue;
    add("RBF-Coll, N = 35", setting, ivp::RbfCollocation{.step = h, .nodes = 35});
    add("polynomials, N = 35", setting, ivp::PolynomialCollocation{.step = h, .nodes = 35});
  }
  for (const double tolerance : tolerances)
    add("ode45", fmt::format("tolerance {:g}", tolerance), ivp::Ode45{tolerance, tolerance});
  return runs;
}

constexpr std::array collocations = {"RBF-Coll, N = 35", "polynomials, N = 35", "RBF-Coll, N = 7",
                                     "polynomials, N = 7"};

/// For each collocation one step a period of the load, or ten, and the longest step that follows.
scene::Table table_of(const std::vector<Runs>& motions) {
  scene::Table table({{"motion"},
                      {"method"},
                      {"setting"},
                      {"followed to"},
                      {"error of u(50)", 2},
                      {"error of u(100)", 2},
                      {"right-hand sides"}});
  for (const Runs& runs : motions) {
    const auto add = [&](const Result& r) {
      table.add({runs.motion.name, r.method, r.setting, r.followed, scene::to_cell(r.at_half),
                 scene::to_cell(r.at_end), r.right_hand_sides});
    };
    for (const std::string method : collocations) {
      add(runs.of(method, steps_to_half(method.ends_with("35") ? 8 : 76)));
      add(runs.longest(method));
    }
    for (const Result& r : runs.all) {
      if (r.method == "ode45") add(r);
    }
  }
  return table;
}

/// Method by method, so that lines join its points.
scene::Table data_of(const std::vector<Runs>& motions) {
  scene::Table data({{"motion"}, {"method"}, {"step"}, {"error"}});
  for (const Runs& runs : motions) {
    for (const std::string method :
         {collocations[0], collocations[1], collocations[2], collocations[3], "ode45"}) {
      std::string word = method;  // a comma would part the cell
      std::erase(word, ',');
      for (const Result& r : runs.all) {
        if (r.method == method && r.at_end) data.add({runs.motion.name, word, r.mean_step, *r.at_end});
      }
    }
  }
  return data;
}

/// Thrice as much to a third of it: D has roundings, which other compilers and processors make elsewhere, and
/// the oracle has none.
scene::Quantity about(const std::string& name, const std::optional<double>& value, double known) {
  constexpr double widened = 3;
  return {name,
          "1",
          value.value_or(HUGE_VAL),
          known / widened,
          known * widened,
          "tools/oracles/rbf_ivp_chaos.py, without the roundings of D; a factor of 3 to both sides"};
}

/// The motions as the oracles have them.
void add_references(std::vector<scene::Quantity>& q, const Motion& chaotic, const Motion& transient) {
  const auto u = [](const Motion& m, double t) { return static_cast<double>(m.reference(t)[0]); };
  // oracle: algebraic_series_motions Duffing u(*
  const char* known = "tools/oracles/algebraic_series_motions.py";
  q.push_back(scene::near("chaotic u(50)", "1", u(chaotic, half), 1.221946638567542, 1e-14, known));
  q.push_back(scene::near("chaotic u(100)", "1", u(chaotic, end), 0.6948913708446737, 1e-14, known));

  // oracle: rbf_ivp_chaos transient u(*
  const char* also = "tools/oracles/rbf_ivp_chaos.py";
  q.push_back(scene::near("transient u(50)", "1", u(transient, half), 0.9725908921302836, 1e-14, also));
  q.push_back(scene::near("transient u(100)", "1", u(transient, end), -0.3969554297434740, 1e-14, also));
}

/// Errors of RBF-Coll.
void add_collocation(std::vector<scene::Quantity>& q, const Runs& chaotic, const Runs& transient) {
  const char *many = "RBF-Coll, N = 35", *few = "RBF-Coll, N = 7";
  const Result &a = chaotic.of(many, steps_to_half(27)), &b = transient.of(many, steps_to_half(32)),
               &c = chaotic.of(few, steps_to_half(256)), &d = transient.of(few, steps_to_half(256)),
               &e = chaotic.of(few, steps_to_half(215));
  // oracle: rbf_ivp_chaos chaotic N = 35 27 *: error*, transient N = 35 32 *: error*, * N = 7 *: error*
  q.push_back(about("error of u(50), chaotic, N = 35, 27 steps to 50", a.at_half, 1.0e-7));
  q.push_back(about("error of u(100), chaotic, N = 35, 27 steps to 50", a.at_end, 6.1e-5));
  q.push_back(about("error of u(50), transient, N = 35, 32 steps to 50", b.at_half, 2.9e-6));
  q.push_back(about("error of u(100), transient, N = 35, 32 steps to 50", b.at_end, 3.6e-6));
  q.push_back(about("error of u(50), chaotic, N = 7, 256 steps to 50", c.at_half, 4.8e-6));
  q.push_back(about("error of u(100), chaotic, N = 7, 256 steps to 50", c.at_end, 0.0068));
  q.push_back(about("error of u(50), chaotic, N = 7, 215 steps to 50", e.at_half, 5.8e-5));
  q.push_back(about("error of u(100), chaotic, N = 7, 215 steps to 50", e.at_end, 0.041));
  q.push_back(about("error of u(50), transient, N = 7, 256 steps to 50", d.at_half, 3.6e-5));
  q.push_back(about("error of u(100), transient, N = 7, 256 steps to 50", d.at_end, 6.1e-5));
}

/// The longest steps with which RBF-Coll follows.
void add_longest(std::vector<scene::Quantity>& q, const Runs& chaotic, const Runs& transient) {
  const char *many = "RBF-Coll, N = 35", *few = "RBF-Coll, N = 7";
  // Newton's iteration of the oracle fails after 1 step with 23 to t = 50 (chaotic) and with 27 (transient),
  // and with 8 after 0 and 2. oracle: rbf_ivp_chaos *: made
  const char* known =
      "tools/oracles/rbf_ivp_chaos.py: with this step it follows, with the next longer one not";
  const auto longest = [&q, known](const std::string& name, double value, int steps) {
    q.push_back(scene::near("longest step that follows, " + name, "1", value, half / steps, 1e-12, known));
  };
  longest("chaotic, N = 35", chaotic.longest(many).mean_step, 27);
  longest("transient, N = 35", transient.longest(many).mean_step, 32);
  longest("chaotic, N = 7", chaotic.longest(few).mean_step, 256);
  for (const Runs* runs : {&chaotic, &transient}) {
    q.push_back(scene::at_most(
        "steps of 6.25 before Newton's iteration fails, " + runs->motion.name + ", N = 35", "1",
        double(runs->of(many, steps_to_half(8)).steps), 2, "tools/oracles/rbf_ivp_chaos.py: 0 and 2"));
  }
}

scene::Showing show(const std::vector<Runs>& motions) {
  const Runs &chaotic = motions.at(0), &transient = motions.at(1);
  scene::Showing showing;
  showing.table = table_of(motions);
  showing.figure = {
      data_of(motions),
      "rbf_ivp-chaos",
      {{"heading", "RBF-Coll follows the chaotic motion too, with steps well below a period of its force"}}};
  add_references(showing.quantities, chaotic.motion, transient.motion);
  add_collocation(showing.quantities, chaotic, transient);
  add_longest(showing.quantities, chaotic, transient);
  const char* seen = "1 % of the amplitude: what is called following here";
  const Result& loose = chaotic.of("ode45", "tolerance 1e-06");
  showing.quantities.push_back(scene::at_most("error of u(100), chaotic, ode45, 1e-6", "1",
                                              loose.at_end.value_or(HUGE_VAL), 0.0335, seen));
  const Result& tight = chaotic.of("ode45", "tolerance 1e-09");
  const double grown = 1e-9 * double(tight.steps) * std::exp(8.33);
  showing.quantities.push_back(
      scene::at_most("error of u(100), chaotic, ode45, 1e-9", "1", tight.at_end.value_or(HUGE_VAL), grown,
                     "a tolerance a step, grown by e^8.33: tools/oracles/algebraic_series_starts.py"));
  return showing;
}

}  // namespace

void add_chaos(scene::Chapter& chapter) {
  const auto& runs = chapter.add_run<std::vector<Runs>>(
      "chaos",
      "u'' + 0.05 u' + u^3 = 7.5 cos t, chaotic, and without the force, a transient, from (3, 4) to t = 100; "
      "c h = "
      "0.367 with 7 nodes as in Table 4.2, (N - 1)/4 with 35; 8 to 512 steps to t = 50, to 128 with 35 nodes",
      {}, [](Workshop&) {
        return std::vector<Runs>{run_all(make_motion("chaotic", true)),
                                 run_all(make_motion("transient", false))};
      });
  chapter.add({.name = "chaos",
               .title = "RBF-Coll on a chaotic and on an aperiodic motion: error against step, beside ode45",
               .place = "our own",
               .needs = {&runs},
               .show = [&runs](Workshop& w) { return show(w.result(runs)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
