#include "chapters/integrators/problem_set.hpp"

#include <cstdlib>
#include <map>
#include <sstream>
#include <type_traits>
#include <utility>

#include "nlmech/program/problem.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::integrators {
namespace {

/// What the tables say of a problem.
struct Known {
  std::map<double, std::vector<long double>> states;  // by time
  double condition = 1, tolerance_condition = 1;
  std::vector<double> scales;
};

class References {
 public:
  References() {
    for (const auto& row : rows("problem_set.csv", 4)) {
      auto& state = known_[row[0]].states[number(row[1])];
      state.push_back(std::strtold(row[3].c_str(), nullptr));
    }
    for (const auto& row : rows("problem_set_conditions.csv", 7)) {
      Known& k = known_[row[0]];
      k.condition = number(row[2]);
      k.tolerance_condition = number(row[3]);
      std::istringstream scales(row[6]);
      for (double scale = 0; scales >> scale;) k.scales.push_back(scale);
    }
  }

  /// Completes a problem that has a solution.
  void complete(SetProblem& p) const {
    const auto found = known_.find(p.name);
    if (found == known_.end()) misfit(p.name);
    const Known& k = found->second;
    const Eigen::Index size = p.x0.size();
    if (k.states.size() != p.times.size() || std::ssize(k.scales) != size) misfit(p.name);
    for (std::size_t i = 0; const auto& [t, x] : k.states) {
      if (t != p.times[i++] || std::ssize(x) != size) misfit(p.name);
      p.truth.emplace_back(Eigen::Map<const Vector<long double, Eigen::Dynamic>>(x.data(), size));
    }
    p.flagged = Eigen::Map<const Eigen::VectorXd>(k.scales.data(), size);
    p.condition = k.condition;
    p.tolerance_condition = k.tolerance_condition;
  }

 private:
  static std::vector<std::vector<std::string>> rows(const std::string& file, std::size_t cells) {
    const auto path = scene::data_folder() / "tables" / "reference" / file;
    std::vector<std::vector<std::string>> all;
    for (scene::CsvRecord& record : scene::parse_csv(scene::read_whole(path), file)) {
      if (record.cells.size() != cells) misfit(file);
      all.push_back(std::move(record.cells));
    }
    all.erase(all.begin());  // headings
    return all;
  }
  static double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }
  [[noreturn]] static void misfit(const std::string& what) {
    throw Failure(Status::failure(
        Outcome::outside_validity,
        "problem set: " + what + " does not fit tables/reference; run problem_set_references again"));
  }

  std::map<std::string, Known> known_;
};

SetProblem made(std::string_view name, Kind kind, double absolute, std::int64_t length, ivp::System system,
                const ivp::State& x0, double t0, double t1) {
  SetProblem p{std::string(name), kind, absolute, length, std::move(system), x0, t0, t1, {}};
  for (int k = 0; k < judged_times; ++k) p.times.push_back(judged_time(t0, t1, k));
  return p;
}

}  // namespace

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::smooth: return "smooth";
    case Kind::stiff: return "stiff";
    case Kind::extreme: break;
  }
  return "extreme";
}

std::vector<SetProblem> problem_set() {
  const References references;
  std::vector<SetProblem> all;
  for (const Case& c : all_cases()) {
    auto p = made(c.name, c.kind, c.absolute, c.length, ivp::System(c.problem), c.problem.initial_state(),
                  c.problem.initial_time, c.end);
    if (c.by != By::nothing) references.complete(p);
    all.emplace_back(std::move(p));
  }
  const program::Equations equations(program::SourceText(std::string(Friction::name), Friction::equation));
  auto p = made(Friction::name, Kind::extreme, 1, 1, ivp::System(program::Problem(equations)),
                {Friction::position, 0}, 0, Friction::end);
  references.complete(p);
  all.emplace_back(std::move(p));
  return all;
}

std::vector<std::string> problem_names(bool solved) {
  std::vector<std::string> names;
  for (const Case& c : all_cases()) {
    if (c.by != By::nothing || !solved) names.emplace_back(c.name);
  }
  names.emplace_back(Friction::name);
  return names;
}

}  // namespace nlmech::chapters::integrators
