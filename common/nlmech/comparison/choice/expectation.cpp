#include "nlmech/comparison/choice/expectation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {
namespace {

constexpr double most_behind = 1.5;  // of a method that does not deliver, log10
constexpr double most_stiff = 3.5;   // beyond which it makes no difference
constexpr double floor_weight =
    0.003;  // so that a method which nothing alike has seen is judged by all others

/// By which a problem of the evidence counts.
double weight_of(const Features& a, const Features& b) {
  const double d = distance(a, b);
  return std::exp(-2 * d * d) + floor_weight;
}

/// A mean with weights.
class Mean {
 public:
  void add(double value, double weight) {
    sum_ += weight * value;
    squares_ += weight * value * value;
    weights_ += weight;
  }
  [[nodiscard]] double value(double otherwise) const { return weights_ > 0 ? sum_ / weights_ : otherwise; }
  /// The square root of the mean square of what differs from the mean.
  [[nodiscard]] double spread() const {
    if (!(weights_ > 0)) return 0;
    return std::sqrt(std::max(0.0, squares_ / weights_ - value(0) * value(0)));
  }

 private:
  double sum_ = 0, squares_ = 0, weights_ = 0;
};

/// The digits that stand for a level on a solved problem, within what was measured there.
double digits_on(const SolvedProblem& p, double level) {
  return std::clamp(level - std::log10(p.condition), 1.0, 13.0);
}

/// How far the method is behind the fastest of those that suit the problem that is asked about.
std::optional<double> behind_on(const SolvedProblem& p, const std::string& method,
                                const std::vector<std::string>& rivals, double level) {
  double digits = digits_on(p, level), best = std::numeric_limits<double>::infinity();
  // Where rounding leaves fewer digits than asked, those that there are decide.
  for (; digits >= 1; digits -= 0.5) {
    for (const std::string& rival : rivals) {
      if (const auto m = p.measured(rival, digits)) best = std::min(best, m->cost);
    }
    if (std::isfinite(best)) break;
  }
  if (!std::isfinite(best)) return {};
  const auto m = p.measured(method, digits);
  return m ? std::min(std::log10(m->cost / best), most_behind) : most_behind;
}

/// log10 of the tolerance over that of an error of one tolerance on the way: by how much a method may be
/// asked for less than the level, or must be asked for more, for the level to be delivered in all likelihood.
double offset_of(const Evidence& evidence, const Features& features, const std::string& method,
                 double level) {
  Mean mean;
  for (const SolvedProblem& p : evidence.problems) {
    const double digits = digits_on(p, level);
    const auto m = p.measured(method, digits);
    if (!m) continue;
    // At the loosest tolerance it may deliver more than it is asked for.
    if (m->tolerance > 0.5 * loosest_measured && m->digits > digits + 0.5) continue;
    mean.add(std::log10(m->tolerance) + digits + std::log10(p.condition), weight_of(features, p.features));
  }
  // Rather too tight than too loose: a decade less of tolerance costs a method of order ten a quarter more.
  constexpr double cautious = 1.5, most = 0.5;
  return std::min(mean.value(0) - cautious * mean.spread(), most);
}

/// The cost of a right-hand side in a method, by components and operations: straight in all three logarithms.
double unit_cost(const Evidence& evidence, const Features& features, const std::string& method) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const auto place = [](const Features& f) {
    return Eigen::Vector3d(1, std::log10(f.components),
                           std::log10(f.operations > 0 ? f.operations : 4.0 * f.components));
  };
  Mean switching;
  for (const SolvedProblem& p : evidence.problems) {
    const auto runs = p.runs.find(method);
    if (runs == p.runs.end() || p.features.switches) continue;
    Mean mean;
    for (const Measured& m : runs->second)
      mean.add(std::log10(m.cost / std::max(m.right_hand_sides, 1.0)), 1);
    const Eigen::Vector3d x = place(p.features);
    const double w = weight_of(features, p.features) + 0.05;
    a += w * x * x.transpose();
    b += w * mean.value(0) * x;
  }
  // A little of "in proportion to neither" where problems are too few to tell.
  a.diagonal() += Eigen::Vector3d(1e-9, 0.02, 0.02);
  const Eigen::Vector3d line = a.ldlt().solve(b);
  double cost = line.dot(place(features));
  if (features.switches) {
    // What the search for switches and new beginnings add.
    for (const SolvedProblem& p : evidence.problems) {
      const auto runs = p.runs.find(method);
      if (runs == p.runs.end() || !p.features.switches) continue;
      for (const Measured& m : runs->second)
        switching.add(std::log10(m.cost / std::max(m.right_hand_sides, 1.0)) - line.dot(place(p.features)),
                      1);
    }
    cost += switching.value(0);
  }
  return std::pow(10, cost);
}

/// Right-hand sides a step, in the runs that the level asks for.
double right_hand_sides_a_step(const Evidence& evidence, const Features& features, const std::string& method,
                               double level) {
  Mean mean;
  for (const SolvedProblem& p : evidence.problems) {
    const auto m = p.measured(method, digits_on(p, level));
    if (m) mean.add(std::log10(m->right_hand_sides / m->steps), weight_of(features, p.features));
  }
  return std::pow(10, mean.value(1));
}

}  // namespace

ivp::Limits Expectation::limits(double most_cost, double largest_step) const {
  constexpr double fewest = 16;
  return {.steps = static_cast<std::int64_t>(std::clamp(most_cost / step, fewest, 1e8)),
          .seconds = 2,
          .largest_step = largest_step};
}

double distance(const Features& a, const Features& b) {
  const auto stiff = [](const Features& f) { return std::clamp(f.stiffness, 0.0, most_stiff); };
  const auto decay = [&](const Features& f) { return f.decay * std::clamp(stiff(f) - 1, 0.0, 1.0); };
  const auto size = [](const Features& f) { return std::log10(f.components); };
  const std::array parts = {(stiff(a) - stiff(b)) / 0.7,
                            decay(a) - decay(b),
                            (std::min(a.variation, 1.5) - std::min(b.variation, 1.5)) / 0.6,
                            size(a) - size(b),
                            a.form == b.form ? 0.0 : 0.5,
                            a.switches == b.switches ? 0.0 : 1.5};
  double square = 0;
  for (const double part : parts) square += part * part;
  return std::sqrt(square);
}

bool suits(const std::string& method, const Features& features) {
  if (method == "series" && features.operations == 0) return false;
  if (features.depends_on_time && any_method(method).info.estimate_misses_time) return false;
  if (method == "rkn1210") return features.form == Form::conservative;
  return features.form != Form::first_order || !any_method(method).info.second_order_only;
}

std::vector<Expectation> expectations(const Evidence& evidence, const Features& features, double level) {
  std::vector<std::string> rivals;
  const std::vector<std::string> built = built_method_names();
  for (const std::string& name : evidence.methods()) {
    if (std::ranges::find(built, name) != built.end() && suits(name, features)) rivals.push_back(name);
  }
  std::vector<Expectation> all;
  for (const std::string& name : rivals) {
    Expectation& e = all.emplace_back(Expectation{.method = name});
    Mean behind;
    for (const SolvedProblem& p : evidence.problems) {
      if (!suits(name, p.features)) continue;
      if (const auto log = behind_on(p, name, rivals, level))
        behind.add(*log, weight_of(features, p.features));
    }
    e.behind = behind.value(most_behind);
    const double tolerance = std::pow(10, offset_of(evidence, features, name, level) - level);
    e.tolerance = std::clamp(tolerance, tightest_measured, loosest_measured);
    e.short_of = std::max(0.0, std::log10(tightest_measured / tolerance));
    e.cost = unit_cost(evidence, features, name);
    e.step = e.cost * right_hand_sides_a_step(evidence, features, name, level);
  }
  const auto place = [](const Expectation& e) {
    return std::pair(e.behind + e.short_of, any_method(e.method).peer);
  };
  std::ranges::stable_sort(all, {}, place);
  return all;
}

std::vector<std::string> most_alike(const Evidence& evidence, const Features& features, std::size_t count) {
  std::vector<std::pair<double, std::string>> all;
  for (const SolvedProblem& p : evidence.problems) all.emplace_back(distance(features, p.features), p.name);
  std::ranges::sort(all);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(count, all.size()); ++i) names.push_back(all[i].second);
  return names;
}

}  // namespace nlmech::comparison
