#include "nlmech/spacecraft/plant/roots.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// For one region: more than a hundred times the evaluations that a dozen zeros of a closed loop need.
constexpr std::size_t most_evaluations = 400'000;

void require_region(const Rectangle& r) {
  const bool finite =
      std::isfinite(r.left) && std::isfinite(r.right) && std::isfinite(r.bottom) && std::isfinite(r.top);
  if (!finite || !(r.left < r.right) || !(r.bottom < r.top))
    throw invalid_argument("roots: the rectangle {} to {}, {} to {} i is empty or not finite", r.left,
                           r.right, r.bottom, r.top);
}

Status on_boundary(Complex s) {
  return failed_with(Outcome::not_converged,
                     "argument principle: a zero lies on the boundary near {} + {} i, or the function is not "
                     "analytic there; choose another region",
                     s.real(), s.imag());
}

Status too_many(const Rectangle& r) {
  return failed_with(Outcome::step_limit,
                     "find_roots: more than {} values of the function were needed from {} to {}, {} to {} i; "
                     "choose a smaller region",
                     most_evaluations, r.left, r.right, r.bottom, r.top);
}

/// Adds the change of the phase of F along a line to @p phase. False if a zero of F prevents it.
bool follow(const AnalyticFunction& f, Complex from, Complex to, double& phase, Complex& at) {
  const double length = std::abs(to - from);
  const Complex direction = (to - from) / length;
  double done = 0;
  at = from;
  Jet here = f(from);
  for (int steps = 0; done < length; ++steps) {
    const double rate = std::abs(here.slope / here.value);
    double step = std::min(length - done, 0.6 / rate);
    for (;; step /= 2) {
      // Also true for a NaN, from F = 0 or a value that is not finite.
      if (!(step > 1e-13 * length) || steps > 200'000) return false;
      const Complex next = from + std::min(done + step, length) * direction;
      const Jet there = f(next);
      const Complex growth = here.slope / here.value, after = there.slope / there.value;
      const double turn = std::arg(there.value / here.value);
      const double predicted = (direction * (growth + after)).imag() * step / 2;
      if (std::abs(turn) <= 0.7 && std::abs(after) * step <= 1.2 && std::abs(turn - predicted) <= 0.4) {
        phase += turn;
        done = step >= length - done ? length : done + step;
        here = there;
        at = next;
        break;
      }
    }
  }
  return true;
}

/// A rectangle still to be searched.
struct Task {
  Rectangle region;
  int count;
};

double diagonal(const Rectangle& r) { return std::hypot(r.right - r.left, r.top - r.bottom); }

/// The largest modulus of the corners.
double reach(const Rectangle& r) {
  return std::hypot(std::max(std::abs(r.left), std::abs(r.right)),
                    std::max(std::abs(r.bottom), std::abs(r.top)));
}

Complex centre(const Rectangle& r) { return {(r.left + r.right) / 2, (r.bottom + r.top) / 2}; }

/// Splits the longer side at the fraction @p part.
std::pair<Rectangle, Rectangle> split(const Rectangle& r, double part) {
  Rectangle first = r, second = r;
  if (r.right - r.left >= r.top - r.bottom)
    first.right = second.left = r.left + part * (r.right - r.left);
  else
    first.top = second.bottom = r.bottom + part * (r.top - r.bottom);
  return {first, second};
}

/// Splits a rectangle where no zero lies on the cut. False if every cut meets a zero.
bool divide(const AnalyticFunction& f, const Task& task, std::vector<Task>& tasks) {
  static constexpr std::array<double, 6> parts = {0.51373, 0.46189, 0.55717, 0.42331, 0.6189, 0.37171};
  for (const double part : parts) {
    const auto [first, second] = split(task.region, part);
    const RootCount count = count_roots(f, first);
    if (!count.status.ok() || count.count < 0 || count.count > task.count) continue;
    if (task.count > count.count) tasks.push_back({second, task.count - count.count});
    if (count.count > 0) tasks.push_back({first, count.count});
    return true;
  }
  return false;
}

}  // namespace

RootCount count_roots(const AnalyticFunction& f, const Rectangle& region) {
  require_region(region);
  const std::array<Complex, 5> corners = {Complex(region.left, region.bottom),
                                          Complex(region.right, region.bottom),
                                          Complex(region.right, region.top), Complex(region.left, region.top),
                                          Complex(region.left, region.bottom)};
  double phase = 0;
  Complex at;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!follow(f, corners[i], corners[i + 1], phase, at)) return {0, on_boundary(at)};
  }
  return {static_cast<int>(std::lround(phase / (2 * std::numbers::pi))), {}};
}

Roots find_roots(const AnalyticFunction& function, const Rectangle& region) {
  Roots found;
  std::size_t evaluations = 0;
  // Beyond the limit F is NaN, which ends the search.
  const AnalyticFunction f = [&](Complex s) {
    return ++evaluations > most_evaluations ? Jet(Complex(std::nan(""))) : function(s);
  };
  const RootCount all = count_roots(f, region);
  found.count = all.count;
  found.status = all.status;
  std::vector<Task> tasks;
  if (all.status.ok() && all.count > 0) tasks.push_back({region, all.count});
  // Sizes are relative to the modulus, with an absolute limit for zeros at 0.
  const double whole = diagonal(region), least = 1e-250 * whole;
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const double size = diagonal(task.region);
    const bool point = size < std::max(1e-10 * std::min(whole, reach(task.region)), least);
    if (task.count == 1 || point) {
      const Root root = refine_root(f, centre(task.region));
      const bool near = std::abs(root.s - centre(task.region)) < 2 * size;
      if (root.status.ok() && (task.region.contains(root.s) || (point && near))) {
        found.roots.insert(found.roots.end(), static_cast<std::size_t>(task.count), root.s);
        continue;
      }
      if (point) {
        // A multiple zero, accurate to the size of its rectangle.
        found.roots.insert(found.roots.end(), static_cast<std::size_t>(task.count), centre(task.region));
        continue;
      }
    } else if (size < 1e-3 * reach(task.region)) {
      // Several close zeros: power sums give them even if they coincide.
      const ZeroCluster cluster = zeros_in_circle(f, centre(task.region), size);
      if (cluster.status.ok() && static_cast<int>(cluster.zeros.size()) == task.count) {
        for (const Complex& z : cluster.zeros) found.roots.push_back(cluster.centre + z);
        continue;
      }
    }
    if (!divide(f, task, tasks)) {
      found.status = on_boundary(centre(task.region));
      break;
    }
  }
  found.evaluations = evaluations;
  if (evaluations > most_evaluations) found.status = too_many(region);
  std::sort(found.roots.begin(), found.roots.end(), [](const Complex& a, const Complex& b) {
    return a.imag() != b.imag() ? a.imag() < b.imag() : a.real() < b.real();
  });
  return found;
}

Root refine_root(const AnalyticFunction& f, Complex start) {
  Complex s = start;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i) {
    const Jet here = f(s);
    if (here.value == Complex(0)) return {s, {}};
    const Complex step = here.value / here.slope;
    const double size = std::abs(step), scale = std::max(std::abs(s - step), 1e-6 * std::abs(start));
    if (!std::isfinite(size)) {
      return {s, failed_with(Outcome::non_finite,
                             "Newton's method for zeros: no step from {} + {} i; start elsewhere", s.real(),
                             s.imag())};
    }
    s -= step;
    // Small steps that no longer decrease are due to rounding of F.
    if (size <= 4 * eps * std::abs(s) || (size <= 1e-10 * scale && size >= before / 2)) return {s, {}};
    before = size;
  }
  return {s, failed_with(Outcome::not_converged,
                         "Newton's method for zeros: 50 steps from {} + {} i; start nearer", start.real(),
                         start.imag())};
}

namespace {

constexpr std::size_t most_zeros = 8;

Status no_cluster(Outcome outcome, Complex centre, double radius, const char* what) {
  return failed_with(outcome, "zeros in a circle about {:g}{:+g}i of radius {:g}: {}; choose another circle",
                     centre.real(), centre.imag(), radius, what);
}

/// Newton's identities: coefficients, from z^0 on, of the monic polynomial with the given power sums of
/// zeros.
std::vector<Complex> polynomial_of(const std::vector<Complex>& power_sums, std::size_t m) {
  std::vector<Complex> elementary(m + 1, 0.);
  elementary[0] = 1;
  for (std::size_t k = 1; k <= m; ++k) {
    Complex sum = 0;
    for (std::size_t i = 1; i <= k; ++i) sum += (i % 2 == 1 ? 1. : -1.) * elementary[k - i] * power_sums[i];
    elementary[k] = sum / static_cast<double>(k);
  }
  std::vector<Complex> a(m);
  for (std::size_t k = 1; k <= m; ++k) a[m - k] = (k % 2 == 1 ? -1. : 1.) * elementary[k];
  return a;
}

/// Weights at the zeros for given moments: w_i = sum_j l_ij mu_j with the coefficients l_ij of the Lagrange
/// polynomials.
std::vector<Complex> at_zeros(const std::vector<Complex>& zeros, const std::vector<Complex>& moments) {
  std::vector<Complex> weights;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    std::vector<Complex> l = {1.};
    for (std::size_t k = 0; k < zeros.size(); ++k) {
      if (k == i) continue;
      const Complex scale = 1. / (zeros[i] - zeros[k]);
      l.push_back(0.);
      for (std::size_t j = l.size(); j-- > 0;)
        l[j] = scale * ((j > 0 ? l[j - 1] : Complex(0)) - zeros[k] * l[j]);
    }
    Complex w = 0;
    for (std::size_t j = 0; j < l.size(); ++j) w += l[j] * moments[j];
    weights.push_back(w);
  }
  return weights;
}

/// Weights at points of a circle for given moments; higher moments follow from the recurrence of the
/// polynomial.
std::vector<Complex> on_circle(const std::vector<Complex>& nodes, const std::vector<Complex>& polynomial,
                               std::vector<Complex> moments) {
  const std::size_t m = polynomial.size(), count = nodes.size();
  for (std::size_t j = m; j < count; ++j) {
    Complex next = 0;
    for (std::size_t i = 0; i < m; ++i) next -= polynomial[i] * moments[j - m + i];
    moments.push_back(next);
  }
  std::vector<Complex> weights;
  for (const Complex& z : nodes) {
    Complex w = 0;
    for (std::size_t j = count; j-- > 0;) w = w / z + moments[j];
    weights.push_back(w / static_cast<double>(count));
  }
  return weights;
}

}  // namespace

std::vector<Complex> polynomial_zeros(const std::vector<Complex>& a) {
  const auto m = static_cast<Eigen::Index>(a.size());
  if (m == 1) return {-a[0]};
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(m, m);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index i = 0; i < m; ++i) companion(i, m - 1) = -a[static_cast<std::size_t>(i)];
  const bool real = std::all_of(a.begin(), a.end(), [](Complex c) { return c.imag() == 0; });
  const Eigen::VectorXcd values =
      real ? Eigen::VectorXcd(
                 Eigen::EigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(companion.real()), false).eigenvalues())
           : Eigen::VectorXcd(Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues());
  return {values.begin(), values.end()};
}

ZeroCluster zeros_in_circle(const std::function<Jet(Complex)>& f, Complex centre, double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw invalid_argument("zeros in a circle: the radius is {:g}", radius);
  ZeroCluster cluster{centre, radius, {}, {}, {}};
  std::vector<Complex> sums(most_zeros + 1, 0.);
  for (std::size_t k = 0; k < circle_points; ++k) {
    const Complex turn = std::polar(1., std::numbers::pi * static_cast<double>(2 * k + 1) / circle_points);
    const Jet value = f(centre + radius * turn);
    // In units of the radius, to avoid overflow of its powers.
    Complex term = turn * (radius * (value.slope / value.value)) / static_cast<double>(circle_points);
    for (Complex& s : sums) {
      s += term;
      term *= turn;
    }
  }
  if (!is_finite(sums[0])) {
    cluster.status = no_cluster(Outcome::non_finite, centre, radius, "the function is 0 or not finite on it");
    return cluster;
  }
  const double count = std::round(sums[0].real());
  if (!(std::abs(sums[0] - count) < 1e-7) || count < 0 || count > most_zeros) {
    cluster.status =
        no_cluster(Outcome::not_converged, centre, radius, "zeros lie near it, or too many in it");
    return cluster;
  }
  const auto m = static_cast<std::size_t>(count);
  if (centre.imag() == 0) {
    for (Complex& s : sums) s = s.real();
  }
  std::vector<Complex> unit = polynomial_of(sums, m);
  cluster.zeros = m == 0 ? std::vector<Complex>{} : polynomial_zeros(unit);
  for (const Complex& z : cluster.zeros) {
    // Power sums are not accurate for a zero so near the circle.
    if (std::abs(z) > 0.75) {
      cluster.status = no_cluster(Outcome::not_converged, centre, radius, "zeros lie near it");
      return cluster;
    }
  }
  for (Complex& z : cluster.zeros) z *= radius;
  double power = radius;
  for (std::size_t j = m; j-- > 0; power *= radius) unit[j] *= power;
  cluster.polynomial = std::move(unit);
  return cluster;
}

ClusterNodes cluster_nodes(const ZeroCluster& cluster, const std::vector<std::vector<Complex>>& moments,
                           double decay, bool own) {
  constexpr std::size_t count = 24;
  double spread = 0;
  for (const Complex& z : cluster.zeros) spread = std::max(spread, std::abs(z));
  ClusterNodes result;
  if (spread >= 0.1 * decay) {
    result.nodes = cluster.zeros;
    for (const std::vector<Complex>& mu : moments) result.weights.push_back(at_zeros(result.nodes, mu));
  } else {
    const double radius = std::max(3 * spread, 0.1 * decay);
    for (std::size_t k = 0; k < count; ++k)
      result.nodes.push_back(std::polar(radius, std::numbers::pi * static_cast<double>(2 * k + 1) / count));
    for (const std::vector<Complex>& mu : moments)
      result.weights.push_back(on_circle(result.nodes, cluster.polynomial, mu));
  }
  if (!own) return result;
  // One node represents a conjugate pair; a real node has half its weight, as in an ExponentialSum.
  ClusterNodes half;
  half.weights.resize(moments.size());
  for (std::size_t k = 0; k < result.nodes.size(); ++k) {
    const Complex z = result.nodes[k];
    if (z.imag() < 0) continue;
    half.nodes.push_back(z);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const Complex w = result.weights[i][k];
      half.weights[i].push_back(z.imag() == 0 ? Complex(w.real() / 2) : w);
    }
  }
  return half;
}

}  // namespace nlmech::spacecraft
