#include "nlmech/collocation/radial/stable_gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "nlmech/collocation/barycentric.hpp"

namespace nlmech::collocation {
namespace {

/// Passes the lower bidiagonal matrix with diagonal b and subdiagonal entries x, from column m on, through
/// the upper bidiagonal matrix with unit diagonal and superdiagonal w: lower upper = upper' lower'. Calls
/// changed(k, w') for each modified entry of w; replaces b by the diagonal of lower'. Indices from 0; x does
/// not change.
template <class Changed>
void pass(std::vector<Wide>& b, Wide x, std::size_t m, const std::vector<Wide>& w, Changed&& changed) {
  Wide rest = b.back();  // b'_k - x w_{k-1}
  for (std::size_t k = b.size() - 1; k > 0 && k >= m; --k) {
    const Wide next = k > m ? rest + x * w[k - 1] : rest;  // b'_k
    const Wide share = b[k - 1] / next;
    b[k] = next;
    changed(k - 1, share * w[k - 1]);
    rest = share * rest;
  }
  if (m == 0) b[0] = rest;
}

}  // namespace

PositiveKernel::PositiveKernel(std::vector<Wide> nodes, std::vector<Wide> ratios)
    : nodes_(std::move(nodes)), ratios_(std::move(ratios)) {
  factors_.assign(nodes_.size(), std::vector<Wide>(terms()));
  std::vector<Wide> gamma = ratios_;  // ratios of adjacent entries of the diagonal matrix Gamma
  for (std::size_t m = 0; m < nodes_.size(); ++m) absorb(m, gamma);
}

void PositiveKernel::absorb(std::size_t m, std::vector<Wide>& gamma) {
  const Wide x = nodes_[m];
  const std::size_t last = terms() - 1;
  std::vector<Wide> b(terms(), 1.0);
  for (std::size_t f = 0; f < m; ++f) {
    std::vector<Wide>& w = factors_[f];
    pass(b, x, m, w, [&w](std::size_t k, Wide changed) { w[k] = changed; });
  }
  // lower Gamma lower^T = upper Gamma' upper^T, and upper is the new factor of W.
  std::vector<Wide> quotients(terms());  // Gamma'_k/Gamma_{k-1}
  Wide rest = b[last] * b[last];         // (Gamma'_k - x^2 Gamma_{k-1})/Gamma_k
  for (std::size_t k = last; k > m; --k) {
    const Wide part = gamma[k - 1] * rest;
    quotients[k] = x * x + part;
    const Wide share = b[k - 1] / quotients[k];
    factors_[m][k - 1] = share * x;
    rest = share * b[k - 1] * part;
  }
  for (std::size_t k = last - 1; k > m; --k) gamma[k] = gamma[k - 1] * (quotients[k + 1] / quotients[k]);
  last_gamma_ = last_gamma_ * rest;
  if (m > 0) gamma[m - 1] = gamma[m - 1] * rest;
  if (m + 1 < nodes_.size()) last_gamma_ = last_gamma_ * (quotients[m + 1] / rest);
  gamma[m] = quotients[m + 1] / rest;
}

std::vector<Wide> PositiveKernel::excess(Wide x) const {
  const std::size_t n = nodes_.size();
  // The point is treated as node n + 1: in the leading n + 1 rows of W it changes only the last entry of each
  // factor.
  std::vector<Wide> b(terms(), 1.0), ends(n);
  for (std::size_t f = 0; f < n; ++f) {
    pass(b, x, n, factors_[f], [&ends, f, n](std::size_t k, Wide changed) {
      if (k == n - 1) ends[f] = changed;
    });
  }
  std::vector<Wide> v(n + 1);
  v.back() = 1.0;
  for (std::size_t f = n; f-- > 0;) {
    for (std::size_t k = f; k < n; ++k) v[k] = v[k] + v[k + 1] * (k == n - 1 ? ends[f] : factors_[f][k]);
  }
  v.pop_back();
  return v;
}

namespace {

using Index = Eigen::Index;
constexpr double pi = std::numbers::pi, ln10 = std::numbers::ln10;

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

/// Number of powers of the exponential series needed for n functions, with c times the interval = @p width.
Index powers(Index n, double width) {
  // Squares of the complete symmetric polynomials of n numbers up to 1 grow by ((n + j)/j)^2 per degree, and
  // the coefficients a^k/k!, a = 2 width^2, decrease: the terms beyond n + j are below exp(-40) times the
  // first one.
  const double a = 2 * width * width, N = static_cast<double>(n);
  double exponent = 0, j = 0, growth = 0;
  do {
    j += 1;
    growth = a * (N + j) / (j * j);
    exponent += std::log(growth);
  } while (exponent > -40 || growth > 0.5);
  return n + 1 + static_cast<Index>(j);
}

}  // namespace

GaussianCardinals::Series GaussianCardinals::choose(Index n, double width, double digits) {
  // Step of the trapezoidal rule and its extent beyond the ends, in units of 1/c, for a relative error of
  // 10^-digits. Multiples of 2^-12 make the exponents below exact.
  const auto grid = [](double x) { return std::ldexp(std::floor(std::ldexp(x, 12)), -12); };
  const double exponent = digits * ln10;
  const double step = grid(pi / 2 / std::sqrt(exponent)),
               reach = grid(std::sqrt(exponent) / 2 + width) + step;
  const auto points = std::max(n + 2, static_cast<Index>((reach + std::sqrt(exponent) / 2) / step) + 2);
  const Index terms = powers(n, width);
  Series series;
  series.ratios.resize(at(std::min(terms, points) - 1));
  if (terms <= points) {
    for (Index k = 0; k < terms - 1; ++k) series.ratios[at(k)] = static_cast<double>(k + 1) / 2;
    return series;
  }
  series.rate = 4 * step;
  series.offset = reach - width;
  for (Index k = 0; k < points - 1; ++k)
    series.ratios[at(k)] = Wide::exp(4 * step * (step * static_cast<double>(2 * k + 1) - 2 * reach));
  return series;
}

GaussianCardinals::GaussianCardinals(Eigen::VectorXd times, double shape)
    : times_(std::move(times)), shape_(shape), kernel_(factorised()) {
  const Index n = times_.size();
  gaps_.resize(at(n * n));
  products_.assign(at(n), 1.0);
  for (Index m = 0; m < n; ++m) {
    for (Index j = 0; j < n; ++j) {
      if (j == m) continue;
      gaps_[at(n * m + j)] = gap(times_[m], times_[j]);
      products_[at(m)] = products_[at(m)] * gaps_[at(n * m + j)];
    }
  }
}

PositiveKernel GaussianCardinals::factorised() {
  constexpr double margin = 25;  // digits of the smallest pivot, and allowance for other orders
  const Index n = times_.size();
  const double width = shape_ * (times_[n - 1] - times_[0]);
  for (double digits = 60;;) {
    series_ = choose(n, width, digits);
    std::vector<Wide> x;
    for (const double t : times_) x.push_back(coordinate(t));
    PositiveKernel kernel(std::move(x), series_.ratios);
    const double needed = margin - last_pivot(kernel, n - 1).log10();
    if (series_.rate == 0 || needed <= digits) return kernel;
    digits = std::max(1.5 * digits, needed + 5);
  }
}

/// Last pivot of a kernel whose last node is @p last, relative to the diagonal entry, which is 1 in Phi.
Wide GaussianCardinals::last_pivot(const PositiveKernel& kernel, Index last) const {
  const Wide x = coordinate(times_[last]);
  Wide diagonal = 1.0, term = 1.0, product = 1.0;
  for (const Wide& ratio : series_.ratios) {
    term = term * x / ratio * x;
    diagonal = diagonal + term;
  }
  for (const double t : times_)
    if (t != times_[last]) product = product * gap(times_[last], t);
  return product / kernel.last_gamma() * product / diagonal;
}

std::vector<Wide> GaussianCardinals::last_pivots() const {
  std::vector<Wide> pivots;
  for (Index i = 0; i < times_.size(); ++i) {
    std::vector<Wide> x;
    for (const double t : times_) x.push_back(coordinate(t));
    std::rotate(x.begin() + i, x.begin() + i + 1, x.end());
    pivots.push_back(last_pivot(PositiveKernel(std::move(x), series_.ratios), i));
  }
  return pivots;
}

Wide GaussianCardinals::coordinate(double t) const {
  if (series_.rate == 0) return shape_ * (t - times_[0]);
  return Wide::exp(series_.rate * shape_ * (t - times_[times_.size() - 1]));
}

Wide GaussianCardinals::gap(double t, double u) const {
  const double distance = shape_ * std::abs(t - u);
  if (series_.rate == 0) return distance;
  return coordinate(std::max(t, u)) * Wide(-std::expm1(-series_.rate * distance));
}

Eigen::VectorXd GaussianCardinals::derivatives(Index i) const {
  const Index n = times_.size();
  const double t = times_[i], squares = series_.rate > 0 ? 2 : 1;
  const Wide slope = series_.rate > 0 ? coordinate(t) * series_.rate : 1.0;  // dx/d(c t)
  const Wide product = products_[at(i)] * slope * shape_;
  const std::vector<Wide> v = kernel_.excess(coordinate(t));
  Eigen::VectorXd result(i);
  for (Index j = 0; j < i; ++j) {
    Wide g = v[at(j)];
    for (Index m = j + 1; m < n; ++m) g = g * gaps_[at(n * m + j)] + v[at(m)];
    const Wide distance = gap(t, times_[j]);
    const double later = shape_ * (t - times_[j]);
    const double sum = shape_ * ((t - times_[0]) + (times_[j] - times_[0])) + 2 * series_.offset;
    const Wide size =
        product / distance / products_[at(j)] * (distance * g + 1.0) * Wide::exp(-squares * later * sum);
    result[j] = (i + j) % 2 == 0 ? size.value() : -size.value();
  }
  return result;
}

namespace {

void require_width(double shape, double length) {
  const double width = shape * length;
  if (shape >= 0 && width <= StableGaussian::largest_shape) return;
  std::ostringstream text;
  text << "StableGaussian: the shape times the interval must be between 0 and "
       << StableGaussian::largest_shape << ", is " << shape << " * " << length;
  throw std::invalid_argument(text.str());
}

}  // namespace

StableGaussian::StableGaussian(const Eigen::VectorXd& times, double shape) : times_(times) {
  require_node_count("StableGaussian", times.size(), 2);
  static_cast<void>(barycentric_weights(times));  // throws if nodes are too close to each other
  const double length = times[times.size() - 1] - times[0];
  require_width(shape, length);
  constexpr double negligible = 1e-10;  // D differs from that of polynomials by its square
  if (shape * length < negligible) {
    derivative_ = polynomial_differentiation_matrix(times);
    return;
  }
  sides_.reserve(2);
  sides_.emplace_back(times, shape);
  sides_.emplace_back(-times.reverse(), shape);
  differentiate(shape);
}

void StableGaussian::differentiate(double shape) {
  const Eigen::Index n = times_.size();
  derivative_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    derivative_.row(i).head(i) = sides_[0].derivatives(i).transpose();
    // In reversed time the derivative changes sign.
    derivative_.row(i).tail(n - 1 - i) = -sides_[1].derivatives(n - 1 - i).reverse().transpose();
    const Eigen::ArrayXd u = shape * (times_.array() - times_[i]);
    derivative_(i, i) = 0;
    derivative_(i, i) = -(derivative_.row(i) * (-u.square()).exp().matrix()).value();
  }
}

}  // namespace nlmech::collocation
