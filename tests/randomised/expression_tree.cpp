#include "tests/randomised/expression_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "nlmech/program/power_series.hpp"
#include "nlmech/program/series_functions.hpp"

namespace nlmech::randomised {
namespace {

using Series = PowerSeries<Real>;

// In rare cases a rounding error is amplified more than in these runs: hence the factor.
constexpr int runs = 4;
constexpr double margin = 200;

Real lead(const Real& x) { return x; }
Real lead(const Series& x) { return x[0]; }

// 1 + a rounding error of random sign, determined by node and run.
Real disturbance(std::size_t node, int run) {
  if (run == 0) return 1;
  std::uint64_t h = (node + 1) * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(run) * 0xbf58476d1ce4e5b9U;
  h = (h ^ (h >> 31U)) * 0x94d049bb133111ebU;
  const double part = static_cast<double>(h >> 11U) * 0x1p-53;
  return 1 + Real((part < 0.5 ? -1 : 1) * (0.5 + part / 2)) * 0x1p-53;
}

Real disturbed(const Real& x, std::size_t node, int run) { return x * disturbance(64 * node, run); }
// Each coefficient has its own rounding error.
Series disturbed(const Series& x, std::size_t node, int run) {
  if (x.is_constant()) return Series(disturbed(x[0], node, run));
  std::vector<Real> all;
  for (std::size_t k = 0; k < x.size(); ++k) all.push_back(x[k] * disturbance(64 * node + k, run));
  return Series(std::move(all));
}

// A power of a library has one rounding error.
Real power(const Real& a, const Real& b, std::size_t /*node*/, int /*run*/) { return exp(b * log(a)); }
// The power of a series consists of logarithm, product and exponential, with rounding errors in each
// coefficient.
Series power(const Series& a, const Series& b, std::size_t node, int run) {
  constexpr std::size_t unused = 1000;  // trees have fewer nodes
  return exp(disturbed(b * disturbed(log(a), node + unused, run), node + 2 * unused, run));
}

// Estimate from the exact value and the disturbed ones. @param scale size of terms that cancel whatever the
// disturbances: the derivative of y^4/y^4 is 0 for each of them, but not with rounding.
std::optional<Estimate> estimate(const std::vector<Real>& values, const Real& scale = 0) {
  Real spread = 0;
  for (const Real& v : values) spread = std::max(spread, Real(abs(v - values[0])));
  // A value that no disturbance changes may still have an error in the last place, or be a sum of subnormal
  // products.
  spread = margin * spread + 4 * abs(values[0]) * 0x1p-53 + margin * scale * 0x1p-53 + Real(1e-250);
  if (!isfinite(spread) || spread > 1e-6 * (1 + abs(values[0])))
    return std::nullopt;  // too uncertain for a comparison
  return Estimate{values[0], spread};
}

const std::vector<std::string> unary = {"sqrt", "exp",   "log",   "sin",   "cos",  "tan",      "asin",
                                        "acos", "atan",  "sinh",  "cosh",  "tanh", "erf",      "abs",
                                        "sign", "-",     "ln",    "log10", "log2", "sec",      "csc",
                                        "cot",  "asinh", "acosh", "atanh", "step", "heaviside"};
const std::vector<std::string> binary = {"+", "-", "*", "*", "/", "+", "^", "atan2", "min", "max"};
const std::vector<std::string> comparisons = {"<", "<=", ">", ">="};
const std::vector<std::string> of_time = {"floor", "ceil", "frac",
                                          "mod"};  // functions of time alone, with jumps

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

Tree::Tree(Draw& draw) { grow(draw, draw.whole(1, 5)); }

int Tree::grow(Draw& draw, int depth) {
  Node n;
  if (depth == 0 || draw.chance(0.1)) {
    n.what = draw.one_of({"t", "x", "y", "x", "y", "pi", "number", "number"});
    if (n.what == "number") {
      n.number = draw.chance(0.5) ? draw.whole(0, 12) : draw.whole(1, 800) / 64.0;
      n.digits = draw.chance(0.8) ? fmt::format("{:.17g}", n.number) : fmt::format("{:.16e}", n.number);
    }
  } else if (draw.chance(0.35)) {
    n.what = draw.one_of(unary);
    n.a = grow(draw, depth - 1);
  } else if (draw.chance(0.04)) {
    n.what = draw.one_of(of_time);
    n.rate = draw.one_of({-1.0, 1.0}) * draw.whole(1, 800) / 64.0;
    n.start = draw.whole(0, 200) / 16.0;
    n.number = draw.one_of({-1.0, 1.0}) * draw.whole(1, 80) / 16.0;
  } else if (draw.chance(0.06)) {
    n.what = draw.one_of(comparisons);
    n.a = grow(draw, depth - 1);
    n.b = grow(draw, depth - 1);
    n.c = grow(draw, depth - 1);
    n.d = grow(draw, depth - 1);
    n.blank = draw.chance(0.3);
  } else {
    n.what = draw.chance(0.15) ? "^n" : std::string(draw.one_of(binary));
    n.a = grow(draw, depth - 1);
    n.b = n.what == "^n" ? -1 : grow(draw, depth - 1);
    if (n.what == "^n") n.number = draw.chance(0.7) ? draw.whole(-4, 9) : draw.whole(-8, 9) / 4.0;
    n.blank = draw.chance(0.6);
  }
  n.named = depth > 0 && draw.chance(0.1);
  nodes_.push_back(n);
  return static_cast<int>(nodes_.size()) - 1;
}

// Ranks: 0 a sum, 1 a product, 2 with a sign, 3 a power, 4 a name, number, call or parenthesis.
std::string Tree::written(int node, int rank, const std::string& prefix) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  if (n.named && node + 1 < static_cast<int>(nodes_.size())) return prefix + std::to_string(node);
  int own = 4;
  const std::string here = written_here(n, own, prefix);
  return own < rank ? "(" + here + ")" : here;
}
std::string Tree::written_here(const Node& n, int& rank, const std::string& prefix) const {
  const auto part = [&](int node, int least) { return written(node, least, prefix); };
  if (n.what == "number") return n.digits;
  if (is_in(of_time, n.what))
    return fmt::format("{}({} t + {}{})", n.what, n.rate, n.start,
                       n.what == "mod" ? fmt::format(", {}", n.number) : "");
  if (n.a < 0) return n.what;
  if (is_in(comparisons, n.what))  // blank: the negated comparison
    return fmt::format("if({}({} {} {}), {}, {})", n.blank ? "not " : "", part(n.c, 0), n.what, part(n.d, 0),
                       part(n.blank ? n.b : n.a, 0), part(n.blank ? n.a : n.b, 0));
  if (n.what == "^n") {
    rank = 3;
    const std::string exponent = fmt::format("{}", n.number);
    return part(n.a, 4) + "^" + (n.blank ? exponent : "(" + exponent + ")");
  }
  if (n.what == "^") {
    rank = 3;
    return part(n.a, 4) + "^" + part(n.b, 2);
  }
  if (n.b < 0 && n.what == "-") {
    rank = 2;
    return "-" + part(n.a, 2);
  }
  if (n.what == "+" || n.what == "-") {
    rank = 0;
    return part(n.a, 0) + " " + n.what + " " + part(n.b, 1);
  }
  if (n.what == "*" || n.what == "/") {
    rank = 1;
    const std::string left = part(n.a, 1), right = part(n.b, n.blank && n.what == "*" ? 3 : 2);
    const bool number = right[0] == '.' || (right[0] >= '0' && right[0] <= '9');
    const bool divided = nodes_[static_cast<std::size_t>(n.a)].what == "/";
    return left + (n.what == "/" ? "/" : n.blank && !number && !divided ? " " : "*") + right;
  }
  return n.what + "(" + part(n.a, 0) + (n.b < 0 ? "" : ", " + part(n.b, 0)) + ")";
}
std::string Tree::text(const std::string& left, const std::string& prefix) const {
  std::string all = left + " = " + written(static_cast<int>(nodes_.size()) - 1, 0, prefix);
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    int rank = 0;
    if (nodes_[i].named)
      all += "; " + prefix + std::to_string(i) + " = " + written_here(nodes_[i], rank, prefix);
  }
  return all;
}

template <class T>
T Tree::jumping(std::size_t node, const T& time, int run, bool& edge) const {
  constexpr std::size_t unused = 1000;  // trees have fewer nodes
  const Node& n = nodes_[node];
  const T product = disturbed(T(Real(n.rate) * time), node + unused, run);
  const T of = disturbed(T(product + T(Real(n.start))), node + 3 * unused, run);  // frac keeps its rounding
  const Real parts = n.what == "mod" ? Real(lead(of) / n.number) : lead(of);
  edge = edge || abs(parts - round(parts)) < 1e-6;
  if (n.what == "floor") return T(Real(floor(parts)));
  if (n.what == "ceil") return T(Real(ceil(parts)));
  if (n.what == "frac") return of - T(Real(floor(parts)));
  return of - disturbed(T(Real(n.number * floor(parts))), node + 2 * unused, run);
}

template <class T>
T Tree::apply(std::size_t node, const std::vector<T>& known, int run, bool& edge) const {
  const Node& n = nodes_[node];
  const T& a = known[static_cast<std::size_t>(n.a)];
  const T& b = n.b < 0 ? a : known[static_cast<std::size_t>(n.b)];
  const Real x = lead(a), y = lead(b), near = 1e-6;
  const T one(Real(1));
  if (n.b < 0 && n.what == "-") return -a;
  if (n.c >= 0) {
    const Real left = lead(known[static_cast<std::size_t>(n.c)]),
               right = lead(known[static_cast<std::size_t>(n.d)]);
    edge = edge || abs(left - right) < near * (1 + abs(left));
    return (left < right) == n.what.starts_with("<") ? a : b;
  }
  if (n.what == "+") return a + b;
  if (n.what == "-") return a - b;
  if (n.what == "*") return a * b;
  edge =
      edge || (n.what == "/" && abs(y) < near) || (n.what == "^" && x < near) ||
      ((n.what == "sqrt" || n.what == "ln" || n.what.starts_with("log")) && x < near) ||
      ((n.what == "tan" || n.what == "sec") && abs(cos(x)) < near) ||
      ((n.what == "csc" || n.what == "cot") && abs(sin(x)) < near) || (n.what == "acosh" && x < 1 + near) ||
      (n.what == "atanh" && abs(x) > 1 - near) ||
      ((n.what == "step" || n.what == "heaviside") && abs(x) < near) ||
      ((n.what == "asin" || n.what == "acos") && abs(x) > 1 - near) ||
      ((n.what == "abs" || n.what == "sign") && abs(x) < near) ||
      ((n.what == "min" || n.what == "max") && abs(x - y) < near) ||
      (n.what == "atan2" && (abs(x) < near || abs(y) < near)) ||
      (n.what == "^n" && ((n.number < 0 && abs(x) < near) || (n.number != std::floor(n.number) && x < near)));
  if (edge) return a;
  if (n.what == "/") return a / b;
  if (n.what == "sqrt") return sqrt(a);
  if (n.what == "exp") return exp(a);
  if (n.what == "log" || n.what == "ln") return log(a);
  if (n.what == "log10") return log(a) / T(log(Real(10)));
  if (n.what == "log2") return log(a) / T(log(Real(2)));
  if (n.what == "sec") return one / cos(a);
  if (n.what == "csc") return one / sin(a);
  if (n.what == "cot") return cos(a) / sin(a);
  if (n.what == "asinh" && x < 0) return -log(sqrt(a * a + one) - a);
  if (n.what == "asinh") return log(sqrt(a * a + one) + a);
  if (n.what == "acosh") return log(sqrt(a * a - one) + a);
  if (n.what == "atanh") return log((one + a) / (one - a)) / T(Real(2));
  if (n.what == "step" || n.what == "heaviside") return x < 0 ? T(Real(0)) : one;
  if (n.what == "sin") return sin(a);
  if (n.what == "cos") return cos(a);
  if (n.what == "tan") return tan(a);
  if (n.what == "asin") return asin(a);
  if (n.what == "acos") return acos(a);
  if (n.what == "atan") return atan(a);
  if (n.what == "sinh") return sinh(a);
  if (n.what == "cosh") return cosh(a);
  if (n.what == "tanh") return tanh(a);
  if (n.what == "erf") return erf(a);
  if (n.what == "abs") return x < 0 ? T(-a) : a;
  if (n.what == "sign") return T(Real(x < 0 ? -1 : 1));
  if (n.what == "min") return x < y ? a : b;
  if (n.what == "max") return x < y ? b : a;
  if (n.what == "atan2") return atan2(a, b);
  if (n.what == "^") return power(a, b, node, run);
  if (n.number != std::floor(n.number)) return exp(Real(n.number) * log(a));
  T power = one;
  for (int k = 0; k < std::abs(n.number); ++k) power = power * a;
  return n.number < 0 ? T(one / power) : power;
}

template <class T>
T Tree::evaluate(const std::array<T, 3>& at, int run, bool& edge) const {
  std::vector<T> known;
  for (std::size_t i = 0; i < nodes_.size() && !edge; ++i) {
    const Node& n = nodes_[i];
    if (is_in(of_time, n.what)) {
      known.push_back(disturbed(jumping(i, at[0], run, edge), i, run));
      continue;
    }
    if (n.a < 0) {
      known.push_back(n.what == "t"    ? at[0]
                      : n.what == "x"  ? at[1]
                      : n.what == "y"  ? at[2]
                      : n.what == "pi" ? T(disturbed(boost::math::constants::pi<Real>(), i, run))
                                       : T(Real(n.number)));
      continue;
    }
    known.push_back(disturbed(apply(i, known, run, edge), i, run));
    const Real size = abs(lead(known.back()));
    edge = edge || !isfinite(size) || size > 1e60 || (size != 0 && size < 1e-60);
  }
  return edge ? at[0] : known.back();
}

std::optional<Estimate> Tree::value(const std::array<double, 3>& point) const {
  bool edge = false;
  std::vector<Real> values;
  for (int run = 0; run <= runs; ++run)
    values.push_back(evaluate<Real>({Real(point[0]), Real(point[1]), Real(point[2])}, run, edge));
  return edge ? std::nullopt : estimate(values);
}

std::optional<Estimate> Tree::derivative(const std::array<double, 3>& point, int by) const {
  bool edge = false;
  std::vector<Real> values;
  const auto difference = [&](const Real& h, int run) {
    std::array<Real, 3> at{Real(point[0]), Real(point[1]), Real(point[2])}, before = at;
    at[static_cast<std::size_t>(by)] += h;
    before[static_cast<std::size_t>(by)] -= h;
    return Real((evaluate(at, run, edge) - evaluate(before, run, edge)) / (2 * h));
  };
  const Real h = 1e-22;  // 38 of the 60 digits remain
  for (int run = 0; run <= runs; ++run) values.push_back(difference(h, run));
  // The error, h^2/6 times the third derivative, is a third of the change for the doubled step. The third
  // derivative of x^p is p^2 times the first.
  const Real change = abs(difference(2 * h, 0) - values[0]);
  if (edge || change > 1e-18 * (1 + abs(values[0]))) return std::nullopt;
  const auto whole = value(point);
  if (!whole) return std::nullopt;
  const double variable = std::abs(point[static_cast<std::size_t>(by)]);  // terms of size f/x may cancel
  return estimate(values, (1 + abs(whole->value)) * (variable > 0 ? 1 + 1 / variable : 1));
}

std::optional<std::array<std::vector<Estimate>, 2>> solution(const std::array<Tree, 2>& trees,
                                                             const std::array<double, 3>& point, int order) {
  const auto size = static_cast<std::size_t>(order) + 1;
  std::array<std::vector<std::vector<Real>>, 2> values;  // by component, order and run
  for (auto& v : values) v.resize(size);
  bool edge = false;
  for (int run = 0; run <= runs; ++run) {
    std::array<std::vector<Real>, 2> c = {std::vector<Real>(size), std::vector<Real>(size)};
    for (std::size_t i = 0; i < 2; ++i) c[i][0] = Real(point[i + 1]);
    std::vector<Real> time(size);
    time[0] = Real(point[0]);
    time[1] = 1;
    for (std::size_t k = 0; k + 1 < size && !edge; ++k) {
      const std::array<Series, 3> at{Series(time), Series(c[0]), Series(c[1])};
      for (std::size_t i = 0; i < 2 && !edge; ++i) {
        const Series slope = trees[i].evaluate(at, run, edge);
        if (!edge)
          c[i][k + 1] = (slope.is_constant() && k > 0 ? Real(0) : Real(slope[k])) / static_cast<int>(k + 1);
      }
    }
    if (edge) return std::nullopt;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < size; ++k) values[i][k].push_back(c[i][k]);
    }
  }
  std::array<std::vector<Estimate>, 2> all;
  for (std::size_t i = 0; i < 2; ++i) {
    Real scale = 1;
    for (const std::vector<Real>& v : values[i]) {
      scale = std::max(scale, Real(abs(v[0])));
      const auto e = estimate(v, scale);
      if (!e) return std::nullopt;
      all[i].push_back(*e);
    }
  }
  return all;
}

}  // namespace nlmech::randomised
