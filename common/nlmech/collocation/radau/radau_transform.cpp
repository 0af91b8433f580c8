#include "nlmech/collocation/radau/radau_transform.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::collocation {
namespace {

/// Real vectors and the parts of complex ones as columns: the real eigenvalue first, then the pairs by
/// growing imaginary part.
template <int s>
RadauTransform<s> make_transform() {
  // Of dynamic size: one eigenvalue solver is compiled for all s.
  using Square = Matrix<long double>;
  const Square inverse = (integration_matrix(radau_right<long double>(s)) / 2).inverse();
  const Eigen::EigenSolver<Square> eigen(inverse);
  const auto& values = eigen.eigenvalues();
  const auto vectors = eigen.eigenvectors();
  std::vector<int> order;
  for (int i = 0; i < s; ++i) {
    if (values[i].imag() >= 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a].imag() < values[b].imag(); });
  RadauTransform<s> r;
  Square t(s, s);
  int column = 0;
  for (const int i : order) {
    for (int row = 0; row < s; ++row) t(row, column) = vectors(row, i).real();
    if (column == 0) {
      r.real = static_cast<double>(values[i].real());
      ++column;
      continue;
    }
    // For the vector u + iv of alpha + i beta, A^-1 (a u - b v) = (alpha a - beta b) u - (beta a + alpha b)
    // v: the pair (a, b) is multiplied as a + ib.
    for (int row = 0; row < s; ++row) t(row, column + 1) = -vectors(row, i).imag();
    r.complex[static_cast<std::size_t>((column - 1) / 2)] = {static_cast<double>(values[i].real()),
                                                             static_cast<double>(values[i].imag())};
    column += 2;
  }
  r.from = t.template cast<double>();
  r.to = t.inverse().eval().template cast<double>();
  return r;
}

}  // namespace

template <int s>
const RadauTransform<s>& radau_transform() {
  static const RadauTransform<s> tables = make_transform<s>();
  return tables;
}

template const RadauTransform<3>& radau_transform<3>();
template const RadauTransform<5>& radau_transform<5>();
template const RadauTransform<7>& radau_transform<7>();

}  // namespace nlmech::collocation
