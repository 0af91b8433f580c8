#include "nlmech/collocation/radial/positive_kernel.hpp"

#include <utility>

namespace nlmech::collocation {
namespace {

/// Passes the lower bidiagonal matrix with diagonal b and the entries x below it, from column m on, through
/// the upper bidiagonal one with unit diagonal and superdiagonal w: lower upper = upper' lower'. Calls
/// changed(k, w') for each entry that changes; b becomes that of lower'. Indices from 0; x stays.
template <class Changed>
void pass(std::vector<Wide>& b, Wide x, std::size_t m, const std::vector<Wide>& w, Changed&& changed) {
  Wide rest = b.back();  // b'_k less x w_{k-1}
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
  std::vector<Wide> gamma = ratios_;  // quotients of neighbours in the diagonal matrix Gamma
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
  // lower Gamma lower^T = upper Gamma' upper^T, which gives the new factor of W.
  std::vector<Wide> quotients(terms());  // Gamma'_k/Gamma_{k-1}
  Wide rest = b[last] * b[last];         // (Gamma'_k less x^2 Gamma_{k-1})/Gamma_k
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
  // The point as node n + 1: what it changes in the leading n + 1 rows of W is the last entry of each factor.
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

}  // namespace nlmech::collocation
