/// Random runs of `integrate` for all problems that are not stiff, by all methods, tolerances and ends: what
/// is printed with exit code 0 is held to two methods that have no part in its verification, at tolerances of
/// 1e-13.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/scene/csv.hpp"
#include "nlmech/scene/process.hpp"
#include "tests/adversary/adversary.hpp"
#include "tests/places.hpp"

namespace nlmech::adversary {
namespace {

constexpr std::array oracles = {"odeint-bulirsch-stoer", "arkode-erk"};

/// What an independent pair of methods knows of an end.
struct Known {
  Eigen::VectorXd x, doubt;
  /// How far off a run may be: four times what the page says, because the condition is sampled at other times
  /// here.
  Eigen::VectorXd allowed;
};

/// From t0 to t1; nothing if the method does not arrive.
template <int n>
std::optional<Eigen::VectorXd> end_by(const char* method, const ivp::System<n>& system,
                                      const Eigen::VectorXd& x0, double t0, double t1) {
  const auto run = peers::peer_integrator<n>(method, 1e-13, 1e-15);
  const auto end = run(system, ivp::State<n>(x0), t0, t1, {}, {.steps = 2'000'000, .seconds = 5});
  if (!end.status.ok()) return {};
  return Eigen::VectorXd(end.x);
}

/// How far errors of one tolerance in all components, at eight times on the way, move the end.
template <int n>
std::optional<Eigen::VectorXd> moved(const ivp::System<n>& system, const Eigen::VectorXd& x0, double t1,
                                     double tolerance) {
  Eigen::VectorXd most = Eigen::VectorXd::Zero(x0.size()), x = x0;
  for (int k = 0; k < 8; ++k) {
    const double t = t1 * k / 8;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x0.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double step = 1e-6 * (std::abs(x[j]) + 1e-2 * x.cwiseAbs().maxCoeff() + 1e-6);
      Eigen::VectorXd low = x, high = x;
      low[j] -= step;
      high[j] += step;
      const auto a = end_by<n>(oracles[0], system, low, t, t1),
                 b = end_by<n>(oracles[0], system, high, t, t1);
      if (!a || !b) return {};
      sum += (*b - *a).cwiseAbs() / (high[j] - low[j]) * tolerance * (1 + std::abs(x[j]));
    }
    most = most.cwiseMax(sum);
    const auto next = end_by<n>(oracles[0], system, x, t, t1 * (k + 1) / 8);
    if (!next) return {};
    x = *next;
  }
  return most;
}

template <class Problem>
std::optional<Known> known(const Problem& problem, const Eigen::VectorXd& x0, double t1, double tolerance) {
  constexpr int n = ivp::compiled_dimension<Problem>;
  const ivp::System<n> system(problem);
  const auto a = end_by<n>(oracles[0], system, x0, 0, t1), b = end_by<n>(oracles[1], system, x0, 0, t1);
  if (!a || !b) return {};
  const auto by = moved<n>(system, x0, t1, tolerance);
  if (!by) return {};
  Known k{*a, (*a - *b).cwiseAbs(), {}};
  k.allowed = 4 * (100 * tolerance * (1 + a->array().abs())).max(10 * by->array());
  return k;
}

/// A command and what it should print.
struct Asked {
  std::string words;
  std::optional<Known> known;
};

/// A problem with each of its parameters times a factor, and a random initial state.
template <class Problem>
Asked ask(Draw& draw, const std::string& program, const std::string& name, double end, double tolerance,
          const std::string& method) {
  Problem problem;
  Asked asked;
  asked.words = fmt::format("{} integrate --problem {} --until {:.17g} --tolerance {:.17g}", program, name,
                            end, tolerance);
  if (!method.empty()) asked.words += " --method " + method;
  for (const auto& parameter : Problem::parameters) {
    if (!draw.chance(0.4)) continue;
    const double value =
        problem.*(parameter.member) * draw.log_uniform(0.1, 10) + (draw.chance(0.1) ? 0.5 : 0);
    problems::set_parameter(problem, parameter.name, value);
    asked.words += fmt::format(" --set {}={:.17g}", parameter.name, value);
  }
  Eigen::VectorXd x0(Problem::dimension);
  std::string initial;
  for (double& x : x0) {
    x = draw.chance(0.2) ? 0 : draw.signed_log(1e-3, 3);
    initial += fmt::format("{}{:.17g}", initial.empty() ? "" : ",", x);
  }
  asked.words += " --initial " + initial;
  asked.known = known(problem, x0, end, tolerance);
  return asked;
}

Asked ask_any(Draw& draw) {
  const double tolerance = draw.log_uniform(1e-10, 1e-3), end = draw.log_uniform(1e-2, 100);
  const std::string any = draw.one_of(comparison::built_method_names());
  const std::string row = draw.one_of({"laier", "argyris", "newmark", "hoff", "bazzi"});
  switch (draw.whole(0, 9)) {
    case 0: return ask<problems::Duffing>(draw, "rbf_ivp", "duffing", end, tolerance, any);
    case 1: return ask<problems::ImpactDuffing>(draw, "rbf_ivp", "impact", end, tolerance, any);
    case 2: return ask<problems::ThreeMassChain>(draw, "rbf_ivp", "three-dof", end, tolerance, any);
    case 3:
      return ask<problems::VanDerPol>(draw, "rbf_ivp", "van-der-pol", std::min(end, 20.), tolerance, any);
    case 4: return ask<problems::DrivenDuffing>(draw, "transversal", "duffing", end, tolerance, "");
    case 5: return ask<problems::TwoDof>(draw, "hermitian", "two-dof", end, tolerance, row);
    case 6: return ask<problems::LinearOscillator>(draw, "hermitian", "linear", end, tolerance, row);
    case 7: return ask<problems::LinearOscillator>(draw, "transversal", "linear", end, tolerance, "");
    case 8:
      return ask<problems::Lorenz>(draw, "algebraic_series", "lorenz", std::min(end, 30.), tolerance, "");
    default: return ask<problems::ForcedDuffing>(draw, "algebraic_series", "duffing", end, tolerance, "");
  }
}

std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    all.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  all.front() = NLMECH_BINARY_DIR "/bin/" + all.front();
  return all;
}

Case trial(Draw& draw) {
  const Asked asked = ask_any(draw);
  std::vector<std::string> words = split(asked.words);
  words.insert(words.end(), {"--limit", "5"});
  const scene::Finished f = scene::run_program(words, {});
  if (f.exit_code == 1 && f.output.empty() && !f.errors.empty()) return Case::refused(asked.words);
  if (f.exit_code != 0)
    return f.exit_code == 2 ? Case::refused(asked.words) : Case::wrong(asked.words + f.errors);
  const auto rows = scene::parse_csv(f.output, "output");
  if (rows.size() != 3) return Case::wrong(asked.words + ": rows");
  if (!asked.known || f.errors.find("not verified") != std::string::npos) return Case::undecided(asked.words);
  const Known& k = *asked.known;
  if ((k.doubt.array() > 0.1 * k.allowed.array()).any()) return Case::undecided(asked.words);
  double ratio = 0;
  for (Eigen::Index i = 0; i < k.x.size(); ++i) {
    const double x = std::stod(rows[2].cells.at(static_cast<std::size_t>(i) + 1));
    ratio = std::max(ratio, std::abs(x - k.x[i]) / k.allowed[i]);
  }
  return Case::judged(ratio, 1, asked.words);
}

TEST(AdversaryCommands, IntegratePrintsWhatIsRight) {
  for (const char* peer : oracles) {
    if (!peers::peer_available(peer)) GTEST_SKIP() << peers::absent_peer_sentence(peer);
  }
  for (const char* program : {"rbf_ivp", "hermitian", "transversal", "algebraic_series"}) {
    if (!std::filesystem::exists(std::string(NLMECH_BINARY_DIR "/bin/") + program))
      GTEST_SKIP() << program << " is not built";
  }
  hunt({.quick = 8, .full = 3'000}, trial);
}

}  // namespace
}  // namespace nlmech::adversary
