#include "nlmech/spacecraft/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

/// Weights of all signals for one exponential: theta, torque, then y at each place.
using Weights = std::vector<Complex>;

/// Exponentials common to all signals, for poles with Im >= 0.
struct ResidueTerms {
  /// Contribution of one pole, or of nearly coincident poles, to the signals at t = 0.
  struct Group {
    double frequency = 0;  ///< imaginary part, 1/s
    Weights value;         ///< contribution to each signal
    Weights rate;          ///< contribution to its time derivative
  };
  std::vector<Complex> poles;    ///< p of e^(pt)
  std::vector<Weights> weights;  ///< one per pole; half the residue for a real pole
  std::vector<Group> groups;     ///< rising in frequency
  double modes = 0;  ///< number of modes slower than the fastest decay: the residues of later modes decrease

  /// Adds a simple pole.
  void add(Complex pole, Weights weight) {
    Group group{pole.imag(), weight, weight};
    for (Complex& w : group.rate) w *= pole;
    groups.push_back(std::move(group));
    poles.push_back(pole);
    weights.push_back(std::move(weight));
  }
};

constexpr std::size_t most_together = 8;

/// One pole of the complex plane, or several that nearly coincide.
struct Cluster {
  std::vector<Complex> poles;
  [[nodiscard]] Complex centre() const {
    Complex sum = 0;
    for (const Complex p : poles) sum += p;
    return sum / static_cast<double>(poles.size());
  }
};

/// Distance within which another pole makes the residue inaccurate. High modes are 2 pi |beta|^(1/4) L apart,
/// in the inverse of the appendage's unit of time. At the relative distance d from a double pole, the residue
/// of a simple pole has a rounding error of about 10 eps/d^3: 2e-12 for d = 0.1.
double neighbourhood(const ClosedLoop& loop, Complex p) {
  const double unit = std::sqrt(loop.plant().appendage().beta_unit());
  const double modes = 2 * std::numbers::pi * std::sqrt(std::abs(p.imag()) / unit);
  return 0.1 * std::min(std::abs(p), std::max(modes, std::abs(p.real())));
}

/// Clusters of the poles and their conjugates; poles nearer to each other than neighbourhood() share a
/// cluster.
std::vector<Cluster> joined(const ClosedLoop& loop, const std::vector<Complex>& upper) {
  struct Member {
    Complex p;
    double near;
    std::size_t cluster;
  };
  std::vector<Member> all;
  for (const Complex p : upper) {
    all.push_back({p, neighbourhood(loop, p), 0});
    if (p.imag() > 0) all.push_back({std::conj(p), all.back().near, 0});
  }
  std::sort(all.begin(), all.end(), [](const Member& a, const Member& b) { return a.p.imag() < b.p.imag(); });
  double widest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].cluster = i;
    widest = std::max(widest, all[i].near);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i; j-- > 0 && all[i].p.imag() - all[j].p.imag() <= widest;) {
      if (all[i].cluster == all[j].cluster) continue;
      if (std::abs(all[i].p - all[j].p) > std::max(all[i].near, all[j].near)) continue;
      const std::size_t from = all[j].cluster, to = all[i].cluster;
      for (Member& m : all) {
        if (m.cluster == from) m.cluster = to;
      }
    }
  }
  std::vector<Cluster> clusters(all.size());
  for (const Member& m : all) clusters[m.cluster].poles.push_back(m.p);
  std::erase_if(clusters, [](const Cluster& c) { return c.poles.empty(); });
  return clusters;
}

/// Distances from the centre of a cluster to its farthest pole and to the nearest pole of another cluster.
struct Distances {
  double within = 0, outside = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
};

Distances distances(const std::vector<Cluster>& all, std::size_t k) {
  Distances d;
  const Complex centre = all[k].centre();
  for (const Complex p : all[k].poles) d.within = std::max(d.within, std::abs(p - centre));
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (j == k) continue;
    for (const Complex p : all[j].poles) {
      if (const double away = std::abs(p - centre); away < d.outside) {
        d.outside = away;
        d.nearest = j;
      }
    }
  }
  return d;
}

/// Joins clusters until the distance of each multiple cluster from the others is at least four times its
/// radius.
void separate(std::vector<Cluster>& all) {
  for (std::size_t k = 0; k < all.size();) {
    if (all[k].poles.size() > 1 && all[k].poles.size() <= most_together) {
      const Distances d = distances(all, k);
      if (d.outside < 4 * d.within) {
        all[k].poles.insert(all[k].poles.end(), all[d.nearest].poles.begin(), all[d.nearest].poles.end());
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(d.nearest));
        k = 0;
        continue;
      }
    }
    ++k;
  }
}

/// Residues of k1/(s P), k1 s (I_hub + 2B)/P, k1 g_3/(s P) at a simple pole.
Weights at_pole(const ClosedLoop& loop, Complex p, std::span<const double> places, double scale) {
  const LoopTerms t = loop.terms(p, places);
  const Complex factor = scale * loop.gains().k1 / t.characteristic.slope;
  Weights w = {factor * t.determinant / p, factor * p * t.open_loop};
  for (const Complex& shape : t.shapes) w.push_back(factor * p * shape);
  return w;
}

/// Transforms of all signals at s. With @p error, theta - theta_f in place of theta, which has no pole at 0
/// and the same residues elsewhere: for a circle that contains 0.
Weights transforms(const ClosedLoop& loop, Complex s, std::span<const double> places, double scale,
                   bool error) {
  const LoopTerms t = loop.terms(s, places);
  const Gains& g = loop.gains();
  const Complex factor = scale * g.k1 / t.characteristic.value;
  Weights f = {factor * t.determinant / s, factor * s * t.open_loop};
  if (error) f[0] = -scale * (s * t.inertia + g.k3 * t.determinant) / t.characteristic.value;
  for (const Complex& shape : t.shapes) f.push_back(factor * s * shape);
  return f;
}

Status not_separated(const Cluster& cluster, const std::string& why) {
  const Complex c = cluster.centre();
  return failed_with(
      Outcome::not_converged,
      "step response: {} poles near {:g}{:+g}i nearly coincide, and {}; change a gain slightly",
      cluster.poles.size(), c.real(), c.imag(), why);
}

/// Adds the terms of cluster @p k, whose poles nearly coincide.
Status add_cluster(const ClosedLoop& loop, const std::vector<Cluster>& all, std::size_t k,
                   std::span<const double> places, double scale, ResidueTerms& terms) {
  const Cluster& cluster = all[k];
  if (cluster.poles.size() > most_together) return not_separated(cluster, "at most eight can be separated");
  const Distances d = distances(all, k);
  Complex centre = cluster.centre();
  const bool own = std::abs(centre.imag()) <= d.within;
  if (own) centre = centre.real();
  const bool far_from_zero = std::abs(centre) >= 4 * d.within;
  const double outside = far_from_zero ? std::min(d.outside, std::abs(centre)) : d.outside;
  const double radius = std::min(outside / 2, std::max(2 * d.within, std::abs(centre) / 2));
  const ZeroCluster zeros =
      zeros_in_circle([&loop](Complex s) { return loop.characteristic(s); }, centre, radius);
  if (!zeros.status.ok()) return not_separated(cluster, zeros.status.sentence());
  const std::size_t m = zeros.zeros.size();
  if (m != cluster.poles.size())
    return not_separated(cluster, fmt::format("{} are counted within {:g} of it", m, radius));
  std::vector<Weights> moments(2 + places.size(), Weights(m, 0.));
  for (std::size_t i = 0; i < circle_points; ++i) {
    const Complex z = std::polar(radius, std::numbers::pi * static_cast<double>(2 * i + 1) / circle_points);
    const Weights f = transforms(loop, centre + z, places, scale, !far_from_zero);
    for (std::size_t signal = 0; signal < f.size(); ++signal) {
      Complex term = f[signal] * z / static_cast<double>(circle_points);
      for (std::size_t j = 0; j < m; ++j, term *= z) moments[signal][j] += own ? term.real() : term;
    }
  }
  const ClusterNodes nodes = cluster_nodes(zeros, moments, -centre.real(), own);
  ResidueTerms::Group group{own ? 0. : centre.imag(), Weights(moments.size(), 0.),
                            Weights(moments.size(), 0.)};
  for (std::size_t i = 0; i < nodes.nodes.size(); ++i) {
    const Complex p = centre + nodes.nodes[i];
    Weights w;
    for (std::size_t signal = 0; signal < moments.size(); ++signal) {
      w.push_back(nodes.weights[signal][i]);
      if (!is_finite(w.back())) return not_separated(cluster, "their residues are not finite");
      group.value[signal] += w.back();
      group.rate[signal] += p * w.back();
    }
    terms.poles.push_back(p);
    terms.weights.push_back(std::move(w));
  }
  terms.groups.push_back(std::move(group));
  return {};
}

/// Terms of the first @p pairs poles and of those that decay faster, for a step of the target angle to @p
/// scale.
///
/// The residues of poles nearer to each other than neighbourhood() cancel, and do not exist where the poles
/// coincide. They are replaced by exponentials at or near the poles with the same sum, from integrals over a
/// circle. The constant theta_f, from s = 0, is not included.
/// @param[out] status success; the status of the poles; or not_converged if poles of a cluster cannot be
/// separated, as for more than eight nearly coincident poles
ResidueTerms loop_residues(const ClosedLoop& loop, int pairs, double scale, std::span<const double> places,
                           Status& status) {
  const LoopPoles found = loop.poles(pairs, PoleOrder::frequency);
  status = found.status;
  ResidueTerms terms;
  std::vector<Cluster> clusters = joined(loop, found.s);
  separate(clusters);
  for (std::size_t k = 0; k < clusters.size() && status.ok(); ++k) {
    const Cluster& c = clusters[k];
    if (c.poles.size() > 1) {
      // Only the upper one of two conjugate clusters.
      double within = 0;
      for (const Complex p : c.poles) within = std::max(within, std::abs(p - c.centre()));
      if (c.centre().imag() >= -within) status = add_cluster(loop, clusters, k, places, scale, terms);
    } else if (const Complex p = c.poles[0]; p.imag() >= 0) {
      terms.add(p, at_pole(loop, p, places, p.imag() == 0 ? scale / 2 : scale));
    }
  }
  const double unit = std::sqrt(loop.plant().appendage().beta_unit());
  for (const Complex p : found.s)
    terms.modes = std::max(terms.modes, std::sqrt(-p.real() * unit) / std::numbers::pi);
  std::stable_sort(terms.groups.begin(), terms.groups.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return terms;
}

void require_options(const ResidueOptions& o) {
  if (o.pairs < 0 || o.pairs > 5000 || o.most < 1 || o.most > 5000)
    throw invalid_argument("residues: pairs = {}, most = {}; up to 5000 are possible", o.pairs, o.most);
  if (!(o.tolerance > 0)) throw invalid_argument("residues: tolerance = {:g}", o.tolerance);
}

void require_places(const Plant& plant, std::span<const double> places, double amplitude) {
  for (const double x : places) plant.appendage().require_place(x);
  if (!std::isfinite(amplitude))
    throw invalid_argument("residues: the amplitude {:g} is not finite", amplitude);
}

/// Truncation error bound, if the moduli fall like a power of their number between 1.5 and @p order. If they
/// do not fall yet, the bound assumes that they stay constant up to number @p modes.
double remainder(const std::vector<double>& moduli, double order, double modes) {
  const std::size_t n = moduli.size();
  if (n < 8) {
    double sum = 0;
    for (const double m : moduli) sum += m;
    return sum;
  }
  const auto largest = [&](std::size_t a, std::size_t b) {
    return *std::max_element(moduli.begin() + static_cast<std::ptrdiff_t>(a),
                             moduli.begin() + static_cast<std::ptrdiff_t>(b));
  };
  const double earlier = largest(n / 2, 3 * n / 4), later = largest(3 * n / 4, n);
  if (later == 0) return 0;
  // From the middle of the third quarter to that of the fourth the number grows by 7/5.
  const double seen = std::log(std::max(earlier, later) / later) / std::log(1.4);
  const double power = std::clamp(seen, 1.5, order);
  // later * (3n/4)^power is at least the constant of the power law.
  const double last = later * std::pow(0.75, power);
  const double falling = 2 * 2 * last * static_cast<double>(n) / (power - 1);
  return seen < 1.5 ? falling + 2 * 2 * later * modes : falling;
}

/// Moduli of the contributions of all groups of poles to one signal at t = 0, or to its time derivative.
std::vector<double> moduli(const ResidueTerms& terms, std::size_t signal, bool rate = false) {
  std::vector<double> m;
  for (const ResidueTerms::Group& g : terms.groups) m.push_back(std::abs((rate ? g.rate : g.value)[signal]));
  return m;
}

ResidueBounds bounds_of(const ResidueTerms& terms, std::size_t places) {
  ResidueBounds b;
  b.theta = remainder(moduli(terms, 0), 6, terms.modes);
  b.theta_dot = remainder(moduli(terms, 0, true), 4, terms.modes);
  b.torque = remainder(moduli(terms, 1), 4, terms.modes);
  for (std::size_t i = 0; i < places; ++i) {
    b.deflection.push_back(remainder(moduli(terms, 2 + i), 5, terms.modes));
    b.deflection_dot.push_back(remainder(moduli(terms, 2 + i, true), 3, terms.modes));
  }
  return b;
}

ExponentialSum sum_of(const ResidueTerms& terms, std::size_t signal,
                      const std::array<double, 3>& polynomial) {
  std::vector<Complex> weights;
  weights.reserve(terms.poles.size());
  for (const Weights& w : terms.weights) weights.push_back(w[signal]);
  return {polynomial, terms.poles, std::move(weights)};
}

/// Whether the truncation errors of theta, every y and their time derivatives are within the tolerances.
bool enough(const ResidueBounds& bounds, const ResidueTerms& terms, double tolerance, double of_rates) {
  const auto small = [&](double bound, std::size_t signal, bool rate) {
    const std::vector<double> m = moduli(terms, signal, rate);
    return m.empty() || bound <= (rate ? of_rates : tolerance) * *std::max_element(m.begin(), m.end());
  };
  bool all = small(bounds.theta, 0, false) && small(bounds.theta_dot, 0, true);
  for (std::size_t i = 0; i < bounds.deflection.size(); ++i)
    all = all && small(bounds.deflection[i], 2 + i, false) && small(bounds.deflection_dot[i], 2 + i, true);
  return all;
}

/// Whether the rates at t = 0 are 0 to a hundredth of their largest term. Their values at t = 0 are their
/// truncation errors. The bounds of theta and y do not cover these: fast modes with small theta may
/// contribute much to theta'.
bool starts_at_rest(const ResidueTerms& terms, std::size_t places) {
  const auto small = [&](std::size_t signal) {
    double start = 0, largest = 0;
    for (const ResidueTerms::Group& g : terms.groups) {
      start += 2 * g.rate[signal].real();
      largest = std::max(largest, std::abs(g.rate[signal]));
    }
    return std::abs(start) <= 1e-2 * largest;
  };
  bool all = small(0);
  for (std::size_t i = 0; i < places; ++i) all = all && small(2 + i);
  return all;
}

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Status of sums with the largest number of terms: success if they meet a reduced accuracy.
Status few_digits(const ResidueTerms& terms, const TimeResponse& response, double tolerance) {
  if (enough(response.bounds, terms, std::max(tolerance, 1e-6), 1e-2)) return {};
  return failed_with(Outcome::not_converged,
                     "residues: the terms beyond {} poles are up to {:g} of theta and {:g} of theta'; the "
                     "hub is too light, or k2 or k3 too large, for a sum over modes",
                     terms.groups.size(), response.bounds.theta, response.bounds.theta_dot);
}

/// Doubles the number of pairs until the bounds are met.
template <class Make>
ResidueTerms enough_terms(const ResidueOptions& options, std::size_t places, TimeResponse& response,
                          const Make& make) {
  for (int pairs = options.pairs > 0 ? options.pairs : std::min(16, options.most);;
       pairs = std::min(2 * pairs, options.most)) {
    ResidueTerms terms = make(pairs, response.status);
    response.bounds = bounds_of(terms, places);
    if (options.pairs > 0 || !response.status.ok() ||
        (enough(response.bounds, terms, options.tolerance, infinite) && starts_at_rest(terms, places)))
      return terms;
    if (pairs >= options.most) {
      response.status = few_digits(terms, response, options.tolerance);
      return terms;
    }
  }
}

ResidueTerms plant_terms(const Plant& plant, int pairs, double torque, std::span<const double> places,
                         Input input, Status& status) {
  const Frequencies f = poles(plant, pairs);
  status = f.status;
  ResidueTerms terms;
  for (const double omega : f.omega) {
    const Complex p(0, omega);
    const Motion<Jet> motion = plant.appendage().motion_with_slope(p);
    const Complex factor = torque / plant.effective_inertia(motion).slope;
    // At a pole I_hub D_0 = -2 B D_0; the form with the smaller rounding error.
    const double hub = plant.parameters().hub_inertia;
    const Complex determinant = hub > plant.parameters().appendage_inertia()
                                    ? -2 / hub * plant.appendage().inertia(motion).value
                                    : motion.determinant.value;
    // The mode's rotation where the torque acts, times D_0.
    const Complex turn =
        input == Input::hub ? determinant : 2. * plant.appendage().tip_rotation(motion).value;
    Weights w = {factor * turn / (p * p * p), 0.};
    for (const double x : places)
      w.push_back(factor * (turn / determinant) * plant.appendage().deflection(motion, x).value / p);
    terms.add(p, std::move(w));
  }
  return terms;
}

/// Checks a signal with initial value 0: its sum at t = 0 must vanish to within the truncation bound and
/// rounding. A missing or twice counted pole violates this.
Status closes(const char* what, const ExponentialSum& sum, double bound) {
  const double start = sum.value(0), allowed = bound + 1e-9 * sum.envelope(0);
  if (std::abs(start) <= allowed) return {};
  return failed_with(Outcome::not_converged,
                     "step response: {} starts at {:g} instead of 0 (error bound {:g}); poles are missing, "
                     "or so close to each other that rounding decides; change a gain slightly",
                     what, start, allowed);
}

/// Checks the initial values of theta, y and their time derivatives.
Status closed_at_start(const TimeResponse& r) {
  Status status = closes("theta", r.theta, r.bounds.theta);
  if (status.ok()) status = closes("theta'", r.theta_dot, r.bounds.theta_dot);
  for (std::size_t i = 0; i < r.deflection.size() && status.ok(); ++i) {
    status = closes("y", r.deflection[i], r.bounds.deflection[i]);
    if (status.ok()) status = closes("y'", r.deflection_dot[i], r.bounds.deflection_dot[i]);
  }
  return status;
}

void finish(TimeResponse& response, std::span<const double> places) {
  response.theta_dot = response.theta.derivative();
  response.places.assign(places.begin(), places.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    response.deflection_dot.push_back(response.deflection[i].derivative());
  if (response.status.ok()) response.status = closed_at_start(response);
}

}  // namespace

TimeResponse step_response(const ClosedLoop& loop, double final_angle, std::span<const double> places,
                           const ResidueOptions& options) {
  require_options(options);
  require_places(loop.plant(), places, final_angle);
  require_restored(loop.parameters(), "step response");
  TimeResponse response;
  const bool moves = loop.gains().k1 > 0;
  const ResidueTerms terms =
      moves ? enough_terms(options, places.size(), response,
                           [&](int pairs, Status& status) {
                             return loop_residues(loop, pairs, final_angle, places, status);
                           })
            : ResidueTerms{};
  if (!moves) response.bounds = bounds_of(terms, places.size());
  response.theta = sum_of(terms, 0, {moves ? final_angle : 0, 0, 0});
  response.torque = sum_of(terms, 1, {});
  for (std::size_t i = 0; i < places.size(); ++i) response.deflection.push_back(sum_of(terms, 2 + i, {}));
  finish(response, places);
  return response;
}

TimeResponse torque_response(const Plant& plant, double torque, std::span<const double> places,
                             const ResidueOptions& options, Input input) {
  require_options(options);
  require_places(plant, places, torque);
  require_restored(plant.parameters(), "step response");
  TimeResponse response;
  const ResidueTerms terms = enough_terms(options, places.size(), response, [&](int pairs, Status& status) {
    return plant_terms(plant, pairs, torque, places, input, status);
  });
  if (!response.status.ok() && input == Input::tips && plant.parameters().tip_inertia == 0)
    response.status =
        failed_with(Outcome::not_converged,
                    "step response: a torque on tips without inertia gives the appendages rates whose "
                    "sum over the modes does not converge; give a tip_inertia, or ask for no deflection");
  // theta/u = gain/s^2 with gain = 1/(I_hub + 2B), on the tips 2 w'(L)/(I_hub + 2B), expanded in s^2.
  const Appendage& appendage = plant.appendage();
  const Motion<Jet> slow = motion_by_series(appendage.ratios(), Jet::variable(0));
  const Jet turn = input == Input::hub ? slow.determinant : 2 * appendage.tip_rotation(slow);
  const Jet gain = turn / plant.effective_inertia(slow);
  const double constant = gain.slope.real() * appendage.beta_unit();
  response.theta = sum_of(terms, 0, {torque * constant, 0, torque * gain.value.real() / 2});
  response.torque = ExponentialSum({torque, 0, 0}, {}, {});
  std::vector<Complex> still(places.size());
  Complex theta;
  static_cast<void>(plant.tip_torque_response(0, places, theta, still));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double y = input == Input::hub ? plant.static_deflection(places[i]) : still[i].real();
    response.deflection.push_back(sum_of(terms, 2 + i, {torque * y, 0, 0}));
  }
  finish(response, places);
  return response;
}

Status certain_at(const TimeResponse& response, double time) {
  if (!(time >= 0) || !std::isfinite(time))
    throw invalid_argument("certain_at: time {:g}; it must be at least 0", time);
  const auto judged = [time](const std::string& what, const ExponentialSum& f) -> Status {
    const auto [c0, c1, c2] = f.polynomial();
    const double smooth = std::abs(c0 + time * (c1 + time * c2));
    double largest = smooth, fastest = 0;
    for (std::size_t k = 0; k < f.poles().size(); ++k) {
      largest = std::max(largest, 2 * std::abs(f.weights()[k]));
      fastest = std::max(fastest, std::abs(f.poles()[k]));
    }
    if (!std::isfinite(smooth))
      return failed_with(Outcome::non_finite, "step: {} is not finite at t = {:g} s; ask for an earlier time",
                         what, time);
    // Below a phase of 1e10 rad no sum has an error of a thousandth.
    if (fastest * time < 1e10 || f.uncertainty(time) <= 1e-3 * largest) return {};
    return failed_with(Outcome::outside_validity,
                       "step: at t = {:g} s rounding leaves the phase of the oscillations of {} undetermined "
                       "({:g} of {:g}); ask for an earlier time",
                       time, what, f.uncertainty(time), largest);
  };
  Status status = judged("theta", response.theta);
  if (status.ok()) status = judged("theta'", response.theta_dot);
  for (std::size_t i = 0; i < response.deflection.size() && status.ok(); ++i) {
    status = judged(fmt::format("y at {:g}", response.places[i]), response.deflection[i]);
    if (status.ok())
      status = judged(fmt::format("y' at {:g}", response.places[i]), response.deflection_dot[i]);
  }
  return status;
}

Statics statics(const Parameters& p, double x) {
  require_physical(p);
  require_cantilever(p, "statics");
  if (!(x >= 0 && x <= p.length))
    throw invalid_argument("statics: x = {:g} is outside 0 to {:g}", x, p.length);
  using Rule =
      boost::math::quadrature::gauss<double, 7>;  // exact for the polynomials here, of degree at most 6
  const double ei = p.bending_stiffness();
  const auto moment = [&](double at) {
    const double load = Rule::integrate(
        [&](double xi) { return p.mass_per_length * (p.hub_radius + xi) * (xi - at); }, at, p.length);
    return load + p.tip_mass * (p.hub_radius + p.length) * (p.length - at) + p.tip_inertia;
  };
  const auto green = [&](double xi) {
    const double near = std::min(x, xi), far = std::max(x, xi);
    return near * near * (3 * far - near) / (6 * ei);
  };
  const auto square = [&](double xi) { return green(xi) * green(xi); };
  const double slope = x * x / (2 * ei), tip = green(p.length);
  Statics s{};
  s.strain = Rule::integrate([&](double at) { return moment(at) * moment(at) / ei; }, 0., p.length);
  s.green = x * x * x / (3 * ei);
  s.square = (p.mass_per_length * (Rule::integrate(square, 0., x) + Rule::integrate(square, x, p.length)) +
              p.tip_mass * tip * tip + p.tip_inertia * slope * slope) /
             2;
  return s;
}

}  // namespace nlmech::spacecraft
