#include "nlmech/orbit/covariance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/transition.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::two_body_series::covariance {
namespace {

using orbit::State;
using orbit::Vector3;
using Plane = Vector<double, 2>;

/// Standard deviations at the start, of each component.
constexpr double place = 1e3, speed = 1;  // m, m/s

/// The cloud and the covariance after some orbits, along the velocity and outwards across it, in km.
struct Cloud {
  int orbits;
  std::vector<Plane> points;
  Matrix<double, 2> linear;    ///< covariance by the transition matrix
  Matrix<double, 2> second;    ///< to second order
  Plane axis = {}, bend = {};  ///< a sigma of the longest axis goes to axis + bend/2 to second order
  Plane second_mean = Plane::Zero(), mean = Plane::Zero();
  Matrix<double, 2> sampled = Matrix<double, 2>::Zero();

  /// Points within @p sigmas of the linear ellipse, as a share.
  [[nodiscard]] double share_within(double sigmas) const {
    double count = 0;
    const double a = linear(0, 0), b = linear(0, 1), c = linear(1, 1), determinant = a * c - b * b;
    for (const Plane& p : points)
      if ((c * p[0] * p[0] - 2 * b * p[0] * p[1] + a * p[1] * p[1]) / determinant <= sigmas * sigmas) ++count;
    return count / static_cast<double>(points.size());
  }
};

/// Adds the terms of second order, by the derivatives D_j of the transition matrix along the columns l_j of
/// the root of the covariance: a normal distribution's mean moves by the sum of D_j l_j/2 and its covariance
/// grows by that of (D_j l_k)(D_j l_k)^T/2. Central differences of the closed form, of 1 % of a standard
/// deviation.
void add_second_order(const State& start, double time, const Matrix<double, 6>& root,
                      const Matrix<double, 2, 3>& axes, const Matrix<double, 2, 6>& seen, Cloud& cloud) {
  constexpr double part = 0.01;
  const Vector<double, 6> longest = seen.row(0).normalized();
  cloud.second = cloud.linear;
  cloud.axis = seen * longest;
  cloud.bend.setZero();
  for (Eigen::Index j = 0; j < 6; ++j) {
    const auto matrix_at = [&](double change) {
      const Vector<double, 6> l = change * root.col(j);
      return orbit::kepler_transition({start.position + l.head<3>(), start.velocity + l.tail<3>()}, time,
                                      earth_mu)
          .transition;
    };
    const Matrix<double, 6> derivative = (matrix_at(part) - matrix_at(-part)) / (2 * part);
    const Matrix<double, 2, 6> d = axes * derivative.topRows<3>() * root;
    cloud.second_mean += d.col(j) / 2;
    cloud.second += d * d.transpose() / 2;
    cloud.bend += longest[j] * (d * longest);
  }
}

std::vector<Cloud> measure(bool quick) {
  const State start = low_orbit().start;
  const double period = orbit::elements_of(start, earth_mu).period(earth_mu);
  Matrix<double, 6> initial = Matrix<double, 6>::Zero(), root;
  initial.diagonal() << Vector3<double>::Constant(place * place), Vector3<double>::Constant(speed * speed);
  (void)orbit::root_of_covariance(initial, root);
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::vector<orbit::PropagationRequest> starts(quick ? 500 : 2000);
  for (auto& s : starts) {
    Vector<double, 6> x;
    for (double& component : x) component = normal(engine);
    x = root * x;
    s = {{start.position + x.head<3>(), start.velocity + x.tail<3>()}, 0, {.mu = earth_mu}};
  }
  std::vector<Cloud> all;
  for (const int orbits : {1, 3, 10}) {
    const double time = orbits * period;
    const auto k = orbit::kepler_transition(start, time, earth_mu);
    const Vector3<double> forwards = k.state.velocity.normalized(),
                          normal_way = orbit::cross(k.state.position, k.state.velocity).normalized(),
                          outwards = orbit::cross(forwards, normal_way);
    Matrix<double, 2, 3> axes;
    axes << forwards.transpose() / 1e3, outwards.transpose() / 1e3;
    const Matrix<double, 6> moved = k.transition * root;
    const Matrix<double, 2, 6> seen = axes * moved.topRows<3>();
    Cloud cloud{orbits, {}, seen * seen.transpose(), {}};
    add_second_order(start, time, root, axes, seen, cloud);
    for (auto& s : starts) s.until = time;
    for (const auto& end : orbit::propagate_all(starts)) {
      if (!end.status.ok()) throw Failure(end.status);
      cloud.points.push_back(axes * (end.x.position - k.state.position));
      cloud.mean += cloud.points.back();
    }
    const auto count = static_cast<double>(starts.size());
    cloud.mean /= count;
    for (const Plane& p : cloud.points)
      cloud.sampled += (p - cloud.mean) * (p - cloud.mean).transpose() / (count - 1);
    all.push_back(std::move(cloud));
  }
  return all;
}

void draw(const std::vector<Cloud>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Covariance over ten orbits: the cloud bends out of the linear ellipse");
  plot.size(1000, 430).columns({"panel", "curve", "along", "outwards"});
  for (const Cloud& c : all) {
    scene::Panel& panel = plot.panel("along the velocity (km)", c.orbits == 1 ? "outwards (km)" : "");
    panel.caption(fmt::format("after {} orbit{}", c.orbits, c.orbits == 1 ? "" : "s"));
    panel.key(c.orbits == 10 ? "bottom center font 'sans-serif,11'" : "off");
    if (c.orbits == 10) panel.y_range(-150, 20);
    panel.set(fmt::format("xtics {}", c.orbits == 1 ? 100 : c.orbits == 3 ? 200 : 1000));
    std::vector<double> x, y, ellipse_x, ellipse_y, axis_x, axis_y;
    for (std::size_t i = 0; i < c.points.size(); i += c.points.size() / 500) {
      x.push_back(c.points[i][0]);
      y.push_back(c.points[i][1]);
    }
    // Three standard deviations: 3 L (cos, sin) with Cholesky's factor L.
    const double a = std::sqrt(c.linear(0, 0)), b = c.linear(0, 1) / a, d = std::sqrt(c.linear(1, 1) - b * b);
    for (int i = 0; i <= 180; ++i) {
      const double angle = i * 0.034906585039886591;  // 2 degrees
      ellipse_x.push_back(3 * a * std::cos(angle));
      ellipse_y.push_back(3 * (b * std::cos(angle) + d * std::sin(angle)));
    }
    for (int i = -30; i <= 30; ++i) {
      const Plane at = i / 10. * c.axis + i * i / 200. * c.bend;
      axis_x.push_back(at[0]);
      axis_y.push_back(at[1]);
    }
    panel.curve("Monte Carlo", x, y, {"points pointtype 7 pointsize 0.3", 2});
    panel.curve("3 sigma, linear", ellipse_x, ellipse_y, scene::lines(1));
    panel.curve("its axis to second order", axis_x, axis_y, scene::lines(3));
  }
}

void put(const std::vector<Cloud>& all, scene::Show& show) {
  draw(all, show);
  const auto sigma = [](const Matrix<double, 2>& m, int axis) { return std::sqrt(m(axis, axis)); };
  show.table(all, {{"orbits", &Cloud::orbits},
                   {"sigma along, linear (km)", [=](const Cloud& c) { return sigma(c.linear, 0); }},
                   {"sigma along, sampled (km)", [=](const Cloud& c) { return sigma(c.sampled, 0); }},
                   {"sigma outwards, linear (km)", [=](const Cloud& c) { return sigma(c.linear, 1); }},
                   {"sigma outwards, second order (km)", [=](const Cloud& c) { return sigma(c.second, 1); }},
                   {"sigma outwards, sampled (km)", [=](const Cloud& c) { return sigma(c.sampled, 1); }},
                   {"mean outwards, second order (km)", [](const Cloud& c) { return c.second_mean[1]; }},
                   {"mean outwards, sampled (km)", [](const Cloud& c) { return c.mean[1]; }},
                   {"share within 3 sigma", [](const Cloud& c) { return c.share_within(3); }}});
  const double count = static_cast<double>(all.front().points.size()), scatter = 4 / std::sqrt(2 * count);
  for (const Cloud& c : all)
    show.near(fmt::format("sigma along after {} orbits, sampled over linear", c.orbits),
              sigma(c.sampled, 0) / sigma(c.linear, 0), 1, scatter,
              "four standard deviations of a sampled one, 1/sqrt(2 n)");
  const Cloud& last = all.back();
  // The place outwards is that of a square: a chi-squared distribution of one degree of freedom, whose
  // variance scatters by (14/n)^(1/2).
  show.near(
      "sigma outwards after 10 orbits, sampled over second order",
      sigma(last.sampled, 1) / sigma(last.second, 1), 1, 2 * std::sqrt(14 / count),
      "four standard deviations of a sampled one of squares of normal numbers, and terms of fourth order");
  show.near("mean outwards after 10 orbits", {-last.mean[1], "km"}, -last.second_mean[1],
            4 * std::sqrt(2 / count), "to second order; four standard deviations of a mean of such squares");
  const double circle = last.linear(0, 0) / 2 * 1e3 / low_orbit().start.position.norm();
  show.near(
      "mean outwards after 10 orbits, to second order", {-last.second_mean[1], "km"}, circle, 0.25,
      "a point at the distance s along a circle of the periapsis' radius r lies s^2/(2 r) inside of its "
      "tangent; the ellipse is flatter, by its eccentricity of 0.1");
  show.between(
      "share within 3 sigma after 1 orbit", all.front().share_within(3), 0.96, 0.997,
      "1 - exp(-9/2) = 0.989 of a normal distribution in the plane; already slightly bent, and scatter");
  show.between("share within 3 sigma after 10 orbits", all.back().share_within(3), 0.2, 0.95,
               "regression value: the cloud is bent by more than the width of the ellipse");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result all(
      "covariance",
      "low orbit from its periapsis; standard deviations of 1 km and 1 m/s of each component; 2000 "
      "starts, 500 with --quick, propagated by Taylor series in lanes",
      measure);
  return {{.name = "covariance",
           .title = "Covariance over ten orbits: linear ellipses and a Monte Carlo cloud",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::two_body_series::covariance
