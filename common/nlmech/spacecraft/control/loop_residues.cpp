#include "nlmech/spacecraft/control/loop_residues.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/plant/zero_cluster.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

constexpr std::size_t most_together = 8;

/// A pole of the whole plane, or several that nearly coincide.
struct Cluster {
  std::vector<Complex> poles;
  [[nodiscard]] Complex centre() const {
    Complex sum = 0;
    for (const Complex p : poles) sum += p;
    return sum / static_cast<double>(poles.size());
  }
};

/// How near another pole disturbs. Between high modes lie 2 pi |beta|^(1/4) L of the appendage's unit of
/// time. Next to a double pole in a distance d, as a share of its size, the residue of a simple one has some
/// ten eps/d^3 of rounding: 2e-12 for a tenth.
double neighbourhood(const ClosedLoop& loop, Complex p) {
  const double unit = std::sqrt(loop.plant().appendage().beta_unit());
  const double modes = 2 * std::numbers::pi * std::sqrt(std::abs(p.imag()) / unit);
  return 0.1 * std::min(std::abs(p), std::max(modes, std::abs(p.real())));
}

/// Poles nearer to each other than their neighbourhoods, and conjugates, joined.
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

/// Distances from a cluster's centre: of its farthest pole, and of the nearest other cluster's nearest.
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

/// Joins clusters until each of more than one pole is four times as far from others as it is wide.
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

/// The transforms of all signals at s. Of theta - theta_f instead of theta if 0 is in the circle: the same
/// residues elsewhere.
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
      "step response: {} poles near {:g}{:+g}i nearly coincide, and {}; change a gain a little",
      cluster.poles.size(), c.real(), c.imag(), why);
}

/// Several poles that nearly coincide.
Status add_cluster(const ClosedLoop& loop, const std::vector<Cluster>& all, std::size_t k,
                   std::span<const double> places, double scale, ResidueTerms& terms) {
  const Cluster& cluster = all[k];
  if (cluster.poles.size() > most_together)
    return not_separated(cluster, "no more than eight can be told apart");
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

}  // namespace

void ResidueTerms::add(Complex pole, Weights weight) {
  Group group{pole.imag(), weight, weight};
  for (Complex& w : group.rate) w *= pole;
  groups.push_back(std::move(group));
  poles.push_back(pole);
  weights.push_back(std::move(weight));
}

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
      // Of two mirror images the upper one.
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

}  // namespace nlmech::spacecraft
