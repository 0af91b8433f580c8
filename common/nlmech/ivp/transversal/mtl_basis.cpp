#include "nlmech/ivp/transversal/mtl_basis.hpp"

namespace nlmech::ivp {

std::string_view to_string(MtlBasis basis) { return basis == MtlBasis::lagrange ? "lagrange" : "interpolet"; }

int mtl_order(MtlBasis basis, int points) {
  if (basis == MtlBasis::interpolet) return 2;
  return points + (points % 2 == 1 ? 1 : 2);
}

std::vector<Eigen::MatrixXd> mtl_pieces(MtlBasis basis, int points) {
  std::vector<Eigen::MatrixXd> pieces;
  for (int j = 0; j < points; ++j) {
    if (basis == MtlBasis::interpolet) {
      Eigen::MatrixXd lines = Eigen::MatrixXd::Zero(points + 1, 2);
      lines.row(j) << 1, -1;
      lines.row(j + 1) << 0, 1;
      pieces.push_back(lines);
      continue;
    }
    // phi_k = product over i of (j + s - i)/(k - i), expanded about s = 0.
    Eigen::MatrixXd polynomials = Eigen::MatrixXd::Zero(points + 1, points + 1);
    for (int k = 0; k <= points; ++k) {
      Eigen::VectorXd c = Eigen::VectorXd::Unit(points + 1, 0);
      for (int i = 0; i <= points; ++i) {
        if (i == k) continue;
        Eigen::VectorXd next = (j - i) * c;
        next.tail(points) += c.head(points);
        c = next / (k - i);
      }
      polynomials.row(k) = c;
    }
    pieces.push_back(polynomials);
  }
  return pieces;
}

}  // namespace nlmech::ivp
