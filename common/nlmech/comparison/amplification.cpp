#include "nlmech/comparison/amplification.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

constexpr int rounding = 16;  // roundings of a state that steps leave, about the square root of some hundred

double weight(double t, double x, double f, double size, const Tolerance& tolerance) {
  return tolerance.absolute + tolerance.relative * std::abs(x) + rounding * eps * size +
         2 * eps * std::abs(t * f);
}

Eigen::VectorXd weights_at(const ivp::System& system, double t, const ivp::State& x,
                           const Eigen::VectorXd& size, const Tolerance& tolerance) {
  ivp::State f(x.size());
  system.rhs(t, x, f);
  Eigen::VectorXd w(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) w[i] = weight(t, x[i], f[i], size[i], tolerance);
  return w;
}

/// d x(t1) / d x(t0) along the reference, by moving each component by @p by to both sides: errors in these
/// matrices multiply in their products, and one-sided differences would not do.
Status derivative(const Candidate& run, const ExtendedState& x, double t0, double t1,
                  const Eigen::VectorXd& by, const std::function<double()>& seconds, Eigen::MatrixXd& d) {
  d.resize(x.size(), x.size());
  StatesAt ends[2];
  Way way{x, t0, {t1}};
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    long double begins[2];
    for (const int side : {0, 1}) {
      // A double, for methods that know no more.
      begins[side] = static_cast<double>(side == 0 ? x[j] - by[j] : x[j] + by[j]);
      way.x0[j] = begins[side];
      if (Status s = run.compute(way, seconds(), ends[side]); !s.ok()) return s;
    }
    way.x0[j] = x[j];
    d.col(j) = ((ends[1].col(0) - ends[0].col(0)) / (begins[1] - begins[0])).cast<double>();
  }
  return {};
}

}  // namespace

Eigen::MatrixXd weights(const ivp::System& system, const std::vector<double>& times, const StatesAt& states,
                        const Eigen::VectorXd& size, const Tolerance& tolerance) {
  Eigen::MatrixXd all(states.rows(), states.cols());
  for (Eigen::Index k = 0; k < states.cols(); ++k) {
    const ivp::State x = states.col(k).template cast<double>();
    const Eigen::VectorXd w = weights_at(system, times[static_cast<std::size_t>(k)], x, size, tolerance);
    for (Eigen::Index i = 0; i < w.size(); ++i) all(i, k) = w[i];
  }
  return all;
}

Status amplification(const Way& way, const Reference& reference, const Eigen::VectorXd& first_weight,
                     const Eigen::MatrixXd& weight, double seconds, Eigen::MatrixXd& moved) {
  const Stopwatch watch;
  const std::function<double()> left = [&] { return seconds - watch.seconds(); };
  // Far above the errors of the run that made the reference, and small against the solution.
  const double share = reference.first.extended ? 1e-7 : 1e-6;
  const Eigen::VectorXd size = reference.size.cwiseMax(way.x0.cwiseAbs().cast<double>());
  std::vector<Eigen::MatrixXd> made;  // what errors of all earlier times have become
  moved = weight;
  Eigen::VectorXd w = first_weight;
  ExtendedState x = way.x0;
  double t = way.t0;
  Eigen::MatrixXd d;
  for (std::size_t k = 0; k < way.times.size(); ++k) {
    Eigen::VectorXd by = share * x.cwiseAbs().cast<double>().cwiseMax(1e-3 * size);
    for (Eigen::Index i = 0; i < by.size(); ++i) {
      if (!(by[i] > 0)) by[i] = share;  // zero throughout
    }
    if (Status s = derivative(reference.first, x, t, way.times[k], by, left, d); !s.ok()) return s;
    for (Eigen::MatrixXd& error : made) error = (d * error).eval();
    made.emplace_back(d * w.asDiagonal());
    const auto column = static_cast<Eigen::Index>(k);
    for (const Eigen::MatrixXd& error : made)
      moved.col(column) = moved.col(column).cwiseMax(error.cwiseAbs().rowwise().sum());
    t = way.times[k];
    x = reference.states.col(column);
    w = weight.col(column);
  }
  return {};
}

}  // namespace nlmech::comparison
