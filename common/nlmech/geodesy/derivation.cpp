#include "nlmech/geodesy/derivation.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace nlmech::geodesy {
namespace {

using Integer = std::int64_t;

Integer times(Integer a, Integer b) {
  Integer product = 0;
  if (__builtin_mul_overflow(a, b, &product))
    throw std::overflow_error("derive_series: a fraction grew beyond 64 bits");
  return product;
}

Integer plus(Integer a, Integer b) {
  Integer sum = 0;
  if (__builtin_add_overflow(a, b, &sum))
    throw std::overflow_error("derive_series: a fraction grew beyond 64 bits");
  return sum;
}

/// A fraction in lowest terms, denominator positive.
class Rational {
 public:
  Rational(Integer numerator = 0, Integer denominator = 1)
      : n_(numerator), d_(denominator) {  // NOLINT: numbers are rational
    const Integer divisor = std::gcd(n_, d_) * (d_ < 0 ? -1 : 1);
    n_ /= divisor;
    d_ /= divisor;
  }
  [[nodiscard]] Integer numerator() const { return n_; }
  [[nodiscard]] Integer denominator() const { return d_; }
  friend Rational operator+(Rational a, Rational b) {
    return {plus(times(a.n_, b.d_), times(b.n_, a.d_)), times(a.d_, b.d_)};
  }
  friend Rational operator*(Rational a, Rational b) { return {times(a.n_, b.n_), times(a.d_, b.d_)}; }

 private:
  Integer n_, d_;
};

/// Powers of q = b/R, of w = cos(phi_0)^2 and of S = sin(2 phi_0), the last 0 or 1.
struct Monomial {
  int q, w, S;
  auto operator<=>(const Monomial&) const = default;
};

/// Polynomial in q, w, S modulo S^2 = 4 w (1 - w). Zero coefficients are not stored.
class Polynomial {
 public:
  Polynomial() = default;
  Polynomial(Monomial m, Rational c) { add(m, c); }

  void add(Monomial m, Rational c) {
    Rational& entry = terms_[m];
    entry = entry + c;
    if (entry.numerator() == 0) terms_.erase(m);
  }
  [[nodiscard]] const std::map<Monomial, Rational>& terms() const { return terms_; }

  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product;
    for (const auto& [m, x] : a.terms_) {
      for (const auto& [n, y] : b.terms_) {
        const int q = m.q + n.q, w = m.w + n.w, S = m.S + n.S;
        if (S < 2) {
          product.add({q, w, S}, x * y);
        } else {
          product.add({q, w + 1, 0}, Rational(4) * x * y);
          product.add({q, w + 2, 0}, Rational(-4) * x * y);
        }
      }
    }
    return product;
  }

 private:
  std::map<Monomial, Rational> terms_;
};

/// Power series in p, truncated after the highest tabulated order.
class Series {
 public:
  Series() = default;
  Series(Rational c) { k[0].add({0, 0, 0}, c); }  // NOLINT: numbers are series
  explicit Series(Monomial m) { k[0].add(m, 1); }
  static Series p() {
    Series s;
    s.k[1].add({0, 0, 0}, 1);
    return s;
  }
  friend Series operator+(Series a, const Series& b) {
    for (std::size_t i = 0; i < a.k.size(); ++i) {
      for (const auto& [m, c] : b.k[i].terms()) a.k[i].add(m, c);
    }
    return a;
  }
  friend Series operator*(const Series& a, const Series& b) {
    Series product;
    for (std::size_t i = 0; i < a.k.size(); ++i) {
      for (std::size_t j = 0; i + j < a.k.size(); ++j) {
        const Polynomial term = a.k[i] * b.k[j];
        for (const auto& [m, c] : term.terms()) product.k[i + j].add(m, c);
      }
    }
    return product;
  }
  friend Series operator-(const Series& a, const Series& b) { return a + Series(Rational(-1)) * b; }

  std::array<Polynomial, highest_order + 1> k;  // by the power of p
};

/// Sum of c_n x^n for a series x without constant term.
Series compose(const std::vector<Rational>& c, const Series& x) {
  Series sum;
  for (std::size_t n = c.size(); n-- > 0;) sum = sum * x + Series(c[n]);
  return sum;
}

// Taylor coefficients up to x^6 of the functions that occur.
const std::vector<Rational> sine_series = {0, 1, 0, {-1, 6}, 0, {1, 120}, 0};
const std::vector<Rational> cosine_series = {1, 0, {-1, 2}, 0, {1, 24}, 0, {-1, 720}};
const std::vector<Rational> arcsine = {0, 1, 0, {1, 6}, 0, {3, 40}, 0};
const std::vector<Rational> inverse_root = {1,         {-1, 2},    {3, 8},     {-5, 16},
                                            {35, 128}, {-63, 256}, {231, 1024}};  // (1+x)^(-1/2)

struct Expansions {
  Series d;         // phi - phi_0
  Series height_R;  // h/R
};

Expansions expand() {
  const Series p = Series::p(), q({1, 0, 0}), w({0, 1, 0}), S({0, 0, 1}), half(Rational(1, 2));
  const Series cos_2phi0 = Series(2) * w - Series(1);

  //! [order by order]
  Series d;
  for (int order = 1; order <= highest_order; ++order) {
    const Series s = compose(sine_series, d), c = compose(cosine_series, d);
    const Series sin_2d = Series(2) * s * c, cos_2d = Series(1) - Series(2) * s * s;
    const Series sin_2phi = S * cos_2d + cos_2phi0 * sin_2d;  // sin(2 phi_0 + 2 d)
    const Series cos_phi0_sin_phi = half * S * c + w * s;     // cos(phi_0) sin(phi_0 + d)
    d = compose(arcsine, p * (half * q * (Series(2) + p) * sin_2phi - cos_phi0_sin_phi));
  }
  //! [order by order]

  // h = [ r cos(phi) + (1+p) z sin(phi) - (1+p) b ] / sqrt(cos^2 + (1+p)^2 sin^2), over R
  const Series s = compose(sine_series, d), c = compose(cosine_series, d), sin2_phi0 = Series(1) - w;
  const Series sin_phi0_sin_phi = sin2_phi0 * c + half * S * s;
  const Series sin2_phi = sin2_phi0 * c * c + S * c * s + w * s * s;
  const Series numerator = c + p * sin_phi0_sin_phi - (Series(1) + p) * q;
  return {d, numerator * compose(inverse_root, p * (Series(2) + p) * sin2_phi)};
}

Integer binomial(int n, int k) {
  Integer value = 1;
  for (int i = 1; i <= k; ++i) value = times(value, n - k + i) / i;
  return value;
}

/// Polynomial in q and w as a homogeneous one in b and h_0: q^m = b^m (b + h_0)^(degree - m) / R^degree.
SeriesTerm homogeneous(const std::map<std::pair<int, int>, Rational>& terms, int degree) {
  std::map<std::pair<int, int>, Rational> by_power;  // (power of w, power of h_0)
  Integer divisor = 1;
  for (const auto& [power, c] : terms) {
    const auto [q, w] = power;
    for (int i = 0; i <= degree - q; ++i) {
      Rational& sum = by_power[{w, i}];
      sum = sum + c * Rational(binomial(degree - q, i));
    }
  }
  for (const auto& [power, c] : by_power) divisor = std::lcm(divisor, c.denominator());
  SeriesTerm term{degree, static_cast<int>(divisor), {}};
  for (const auto& [power, c] : by_power) {
    term.coefficient.at(static_cast<std::size_t>(power.first)).at(static_cast<std::size_t>(power.second)) =
        static_cast<int>(c.numerator() * (divisor / c.denominator()));
  }
  return term;
}

/// phi_k is S times a polynomial in q and w.
SeriesTerm latitude_term(const Polynomial& phi, int k) {
  std::map<std::pair<int, int>, Rational> terms;
  for (const auto& [m, c] : phi.terms()) terms[{m.q, m.w}] = c;
  return homogeneous(terms, k);
}

/// h_k/R is q S^2 = 4 q w (1 - w) times a polynomial: divides by that, lowest power of w first.
SeriesTerm height_term(const Polynomial& h, int k) {
  std::map<std::pair<int, int>, Rational> terms;
  for (int q = 1; q <= k; ++q) {
    Rational quotient = 0;  // of the power below: out[w-1] = in[w]/4 + out[w-2]
    for (int w = 1; w <= highest_order; ++w) {
      const auto found = h.terms().find({q, w, 0});
      quotient = quotient + (found == h.terms().end() ? Rational(0) : found->second * Rational(1, 4));
      if (quotient.numerator() != 0) terms[{q - 1, w - 1}] = quotient;
    }
  }
  return homogeneous(terms, k - 1);
}

}  // namespace

SeriesTable derive_series() {
  const Expansions e = expand();
  SeriesTable table;
  for (int k = 1; k <= highest_order; ++k) {
    const auto i = static_cast<std::size_t>(k);
    table.latitude[i - 1] = latitude_term(e.d.k[i], k);
    table.height[i - 1] = k == 1 ? SeriesTerm{0, 1, {}} : height_term(e.height_R.k[i], k);
  }
  return table;
}

}  // namespace nlmech::geodesy
