#include "nlmech/program/linear_terms.hpp"

#include <cmath>
#include <complex>
#include <map>
#include <utility>

namespace nlmech::program {
namespace {

/// constant + drift t + linear x + harmonics; `more` if there are other terms, which are dropped.
struct Form {
  double constant = 0, drift = 0;
  std::map<int, double> linear;                      // coefficients by component
  std::map<double, std::complex<double>> harmonics;  // cosine + i sine, by frequency
  bool more = false;

  void add(double factor, const Form& other) {
    more = more || other.more;
    if (factor == 0) return;
    constant += factor * other.constant;
    drift += factor * other.drift;
    for (const auto& [i, c] : other.linear) linear[i] += factor * c;
    for (const auto& [w, c] : other.harmonics) harmonics[w] += factor * c;
  }
  [[nodiscard]] bool is_constant() const {
    return !more && drift == 0 && linear.empty() && harmonics.empty();
  }
  [[nodiscard]] bool is_phase() const { return !more && linear.empty() && harmonics.empty(); }
};

Form sum(double of_a, const Form& a, double of_b, const Form& b) {
  Form made;
  made.add(of_a, a);
  made.add(of_b, b);
  return made;
}

// Products of two terms that are not constant are dropped.
Form product(const Form& a, const Form& b) {
  Form made = sum(b.constant, a, a.constant, b);
  made.constant = a.constant * b.constant;
  made.more = made.more || (!a.is_constant() && !b.is_constant());
  return made;
}

// cos(w t + p) = cos p cos wt - sin p sin wt
Form harmonic(const Form& phase, bool is_sine) {
  Form made;
  const double c = std::cos(phase.constant), s = std::sin(phase.constant);
  const std::complex<double> amplitude = is_sine ? std::complex(s, c) : std::complex(c, -s);
  if (phase.drift == 0) {
    made.constant = amplitude.real();
  } else {
    made.harmonics[phase.drift] = amplitude;
  }
  return made;
}

Form form_of(const Node& n, const Form& a, const Form& b) {
  Form made;
  switch (n.operation) {
    case Operation::number: made.constant = n.c; return made;
    case Operation::variable: (n.a == 0 ? made.drift : made.linear[n.a - 1]) = 1; return made;
    case Operation::sum: return sum(1, a, 1, b);
    case Operation::difference: return sum(1, a, -1, b);
    case Operation::scaled: made.add(n.c, a); return made;
    case Operation::divided: made.add(1 / n.c, a); return made;
    case Operation::shifted:
      made = a;
      made.constant += n.c;
      return made;
    case Operation::product: return product(a, b);
    case Operation::function:
      if (a.is_phase() && (n.function == Function::sin || n.function == Function::cos))
        return harmonic(a, n.function == Function::sin);
      [[fallthrough]];
    default: made.more = true; return made;
  }
}

}  // namespace

LinearTerms linear_terms(const Graph& graph, const std::vector<NodeId>& slopes) {
  const std::vector<bool> part = parts_of(graph, slopes);
  std::vector<Form> forms(part.size());
  for (NodeId i = 0; i < static_cast<NodeId>(part.size()); ++i) {
    if (part[index(i)])
      forms[index(i)] = form_of(graph[i], forms[index(graph[i].a)], forms[index(graph[i].b)]);
  }
  LinearTerms found{Eigen::MatrixXd::Zero(graph.size(), graph.size()), {}};
  for (std::size_t row = 0; row < slopes.size(); ++row) {
    const Form& form = forms[index(slopes[row])];
    const int i = static_cast<int>(row);
    for (const auto& [j, c] : form.linear) {
      if (std::isfinite(c)) found.a(i, j) = c;
    }
    if (form.constant != 0 && std::isfinite(form.constant)) found.load.push_back({i, 0, form.constant, 0});
    for (const auto& [w, c] : form.harmonics) {
      if (std::isfinite(w) && std::isfinite(std::abs(c))) found.load.push_back({i, w, c.real(), c.imag()});
    }
  }
  return found;
}

}  // namespace nlmech::program
