#include "chapters/integrators/course.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::integrators {
namespace {

using ivp::State;

}  // namespace

const std::vector<double>& Course::operator[](const std::string& name) const {
  const auto place = std::find(names.begin(), names.end(), name) - names.begin();
  return columns.at(static_cast<std::size_t>(place));
}

program::Equations example(const std::string& name) {
  const std::string file = name + ".ode";
  const auto path = scene::data_folder() / "chapters" / "integrators" / "examples" / file;
  return program::Equations(program::SourceText(file, scene::read_whole(path)));
}

std::vector<double> equidistant(double begin, double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(begin + (end - begin) * i / count);
  return times;
}

Course course(const program::Equations& equations, const std::vector<double>& times,
              const std::string& method, const std::string& other) {
  const ivp::System system{program::Problem(equations)};
  const std::vector<double> x0 = program::Equations(equations).initial_state("initial state", "");
  const State begin = Eigen::Map<const Eigen::VectorXd>(x0.data(), static_cast<Eigen::Index>(x0.size()));
  const ivp::Settings settings{.tolerance = 1e-13};
  Course made{equations.state_names(), {}, std::vector<std::vector<double>>(x0.size()), 0};
  State size = begin.cwiseAbs();
  const auto go = [&](const std::string& name, bool keep) {
    const auto run = comparison::any_method(name).with(settings);
    State x = begin;
    double t = equations.initial_time().value_or(0);
    for (const double next : times) {
      const auto end = run(system, x, t, next, {}, {});
      if (!end.status.ok()) throw Failure(end.status);
      x = end.x;
      t = next;
      size = size.cwiseMax(x.cwiseAbs());
      if (!keep) continue;
      made.t.push_back(t);
      for (Eigen::Index i = 0; i < x.size(); ++i) made.columns[static_cast<std::size_t>(i)].push_back(x[i]);
    }
    return x;
  };
  const State one = go(method, true);
  if (!other.empty()) made.difference = ((one - go(other, false)).array().abs() / size.array()).maxCoeff();
  return made;
}

}  // namespace nlmech::chapters::integrators
