#include "chapters/hermitian/peak_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "chapters/printed_values.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::chapters::hermitian {
namespace {

constexpr double unit = 1e-4, latest = 20;

/// A step of two operators whose iteration may be cut short, which the library's may not.
class Steps {
 public:
  Steps(const ivp::System& system, const Program& program, const ivp::HermitianPair& pair, double h)
      : system_(system), program_(program), weights_(ivp::solved_for_end(pair)), h_(h), x_(program.x0) {
    static_cast<void>(system_.second_derivative(clock(0), x_, f_, g_));
    if (!program.no_first) return;
    f_[1] = 0;
    g_.setZero();
  }

  [[nodiscard]] const ivp::State& state() const { return x_; }

  void advance() {
    const auto& w = weights_;
    const double h = h_, t = clock(program_.old_load ? number_ : number_ + 1);
    const ivp::State known{x_[0] + h * x_[1] + h * h * (w.qa0 * f_[1] + h * w.qj0 * g_[1]),
                           x_[1] + h * (w.va0 * f_[1] + h * w.vj0 * g_[1])};
    const Eigen::Vector2d a(h * h * w.qa1, h * w.va1), j(h * h * h * w.qj1, h * h * w.vj1);
    ivp::Jacobian fx, gx;
    for (int k = 0; k < program_.updates; ++k) {
      static_cast<void>(system_.second_derivative(t, x_, f_, g_, fx, gx));
      const Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity() - a * fx.row(1) - j * gx.row(1);
      const Eigen::Vector2d update = matrix.inverse() * (x_ - known - f_[1] * a - g_[1] * j);
      x_ -= update;
      if (!(update.cwiseAbs().maxCoeff() > 1e-13)) break;
    }
    static_cast<void>(system_.second_derivative(t, x_, f_, g_));
    ++number_;
  }

 private:
  [[nodiscard]] double clock(int number) const { return program_.begin + (program_.ahead + number) * h_; }

  const ivp::System& system_;
  const Program& program_;
  ivp::HermitianStep weights_;
  double h_;
  ivp::State x_, f_, g_;
  int number_ = 0;
};

// Where the velocity of the cubic between x0 and x1 vanishes, which has the sign's sense at x0 only.
double top_of_cubic(const ivp::State& x0, const ivp::State& x1, double h, double sign) {
  const double rise = sign * (x1[0] - x0[0]), v0 = sign * h * x0[1], v1 = sign * h * x1[1];
  const double b = 3 * rise - 2 * v0 - v1, c = v0 + v1 - 2 * rise;
  const double s = v0 / (-b + std::sqrt(b * b - 3 * c * v0));
  return x0[0] + sign * (s * (v0 + s * (b + s * c)));
}

double vertex(double y0, double y1, double y2) {
  const double difference = y2 - y0;
  return y1 - difference * difference / (8 * (y2 - 2 * y1 + y0));
}

Nine peaks_of(const std::array<Turn, 9>& turns, Reading reading, double sign) {
  Nine peaks{};
  for (std::size_t i = 0; i < peaks.size(); ++i) peaks.at(i) = peak_of(turns.at(i), reading, sign);
  return peaks;
}

// All readings of one program.
void add(std::vector<Combination>& all, const ivp::System& system, const Program& program, double sign) {
  std::array<Turn, 9> turns{};
  for (std::size_t i = 0; i < turns.size(); ++i)
    turns.at(i) = turn_of(system, program, peak_operators.at(i % 3), peak_steps.at(i / 3), sign);
  for (const Reading reading : readings) all.push_back({program, reading, peaks_of(turns, reading, sign)});
}

double miss(double ours, double printed) {
  const double d = std::abs(ours - printed) / unit;
  // A number that ends on the edge of a unit is within, as in verdicts.
  return std::isnan(d) ? HUGE_VAL : d * (1 - 1e-9);
}

}  // namespace

std::string PeakTable::name(std::size_t row, std::size_t column) const {
  return fmt::format("laier/{}/dt = {} {}/first peak of the {} oscillator", place, peak_steps.at(row),
                     peak_columns.at(column), oscillator);
}

Nine PeakTable::printed() const {
  const auto values = printed_values(place);
  Nine all{};
  for (std::size_t i = 0; i < 9; ++i) all.at(i) = values.at(name(i / 3, i % 3)).value;
  return all;
}

// oracle: transversal_motions Laier's Duffing peak
PeakTable table_4() { return {"Table 4", "table-4", "Duffing", duffing_case(), 0.53826530480162931}; }

// oracle: transversal_motions Laier's van der Pol peak
PeakTable table_5() {
  return {"Table 5", "table-5", "van der Pol", van_der_pol_case(), -0.31932967523380421};
}

Turn turn_of(const ivp::System& system, const Program& program, const ivp::HermitianPair& pair, double step,
             double sign) {
  const ivp::State none{nan, nan};
  Steps steps(system, program, pair, step);
  ivp::State earlier = none, before = steps.state();
  const auto last = static_cast<int>(std::lround(latest / step));
  for (int i = 0; i < last; ++i) {
    steps.advance();
    const ivp::State after = steps.state();
    if (!after.allFinite()) break;
    if (sign * before[1] > 0 && sign * after[1] <= 0) {
      steps.advance();
      return {{earlier, before, after, steps.state()}, step};
    }
    earlier = before;
    before = after;
  }
  return {{none, none, none, none}, step};
}

std::string_view to_string(Reading reading) {
  switch (reading) {
    case Reading::furthest: return "furthest end of a step";
    case Reading::before: return "last end before the turn";
    case Reading::after: return "first end after the turn";
    case Reading::parabola: return "parabola through three ends";
    case Reading::cubic: return "cubic between two ends";
  }
  return "";
}

double peak_of(const Turn& turn, Reading reading, double sign) {
  const auto& x = turn.x;
  const bool early = sign * x[1][0] >= sign * x[2][0];
  switch (reading) {
    case Reading::furthest: return early ? x[1][0] : x[2][0];
    case Reading::before: return x[1][0];
    case Reading::after: return x[2][0];
    case Reading::parabola:
      return early ? vertex(x[0][0], x[1][0], x[2][0]) : vertex(x[1][0], x[2][0], x[3][0]);
    case Reading::cubic: return top_of_cubic(x[1], x[2], turn.step, sign);
  }
  return nan;
}

std::vector<ivp::State> searched_starts() {
  std::vector<ivp::State> starts = {{0, 0}};
  for (const double size : {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) {
    for (const double value : {size, -size}) {
      starts.push_back({value, 0});
      starts.push_back({0, value});
    }
  }
  return starts;
}

std::vector<Combination> duffing_combinations() {
  const problems::TextProblem problem("laier-duffing");
  const ivp::System system(problem);
  std::vector<Combination> all;
  for (const ivp::State& x0 : searched_starts()) {
    // Cosine, minus sine, minus cosine, sine: quarters of the load's period.
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double begin = quarter * std::numbers::pi / 2 / problem.parameter("frequency");
      for (int halves = -4; halves <= 4; ++halves) {
        for (const bool first : {false, true}) {
          for (const int updates : {1, 2, 50}) add(all, system, {x0, begin, halves / 2.0, first, updates}, 1);
          add(all, system, {x0, begin, halves / 2.0, first, 1, true}, 1);
        }
      }
    }
  }
  return all;
}

std::vector<Combination> van_der_pol_combinations() {
  const ivp::System system(problems::TextProblem("laier-van-der-pol"));
  std::vector<Combination> all;
  for (const ivp::State& x0 : searched_starts()) {
    if (x0.isZero()) continue;
    for (const bool first : {false, true}) {
      for (const int updates : {1, 2, 50}) add(all, system, {x0, 0, 0, first, updates}, -1);
    }
  }
  return all;
}

int rows_met(const Nine& ours, const Nine& printed) {
  int met = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) met += miss(ours[i], printed[i]) <= 1 ? 1 : 0;
  return met;
}

double Fit::by_columns() const {
  double worst = 0;
  for (const Best& column : columns) worst = std::max(worst, column.miss);
  return worst;
}

Fit best_fit(std::span<const Nine> all, const Nine& printed) {
  Fit fit;
  const auto take = [](Best& best, double miss, std::size_t number) {
    if (miss < best.miss) best = {miss, number};
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    int met = 0;
    std::array<double, 3> worst{};
    for (std::size_t k = 0; k < 9; ++k) {
      const double m = miss(all[i][k], printed[k]);
      worst[k % 3] = std::max(worst[k % 3], m);
      met += m <= 1 ? 1 : 0;
    }
    for (std::size_t k = 0; k < 3; ++k) take(fit.columns[k], worst[k], i);
    take(fit.all, std::max({worst[0], worst[1], worst[2]}), i);
    fit.most = std::max(fit.most, met);
  }
  return fit;
}

std::vector<Nine> surrogates(const Nine& printed, double peak, Surrogates kind, int count,
                             std::uint64_t seed) {
  // mt19937_64 is defined bit for bit; the distributions of the standard library are not.
  std::mt19937_64 engine(seed);
  const auto factor = [&engine] { return 0.5 + std::ldexp(static_cast<double>(engine() >> 11), -53); };
  std::vector<Nine> all(static_cast<std::size_t>(count));
  for (Nine& table : all) {
    const double moved = kind == Surrogates::any_peak ? factor() * peak : peak;
    std::array<double, 3> scale{};
    for (double& s : scale) s = factor();
    for (std::size_t i = 0; i < 9; ++i)
      table.at(i) = std::round((moved + scale.at(i % 3) * (printed.at(i) - peak)) / unit) * unit;
  }
  return all;
}

double chance_of(std::span<const double> others, double ours) {
  const auto as_good = std::count_if(others.begin(), others.end(), [ours](double x) { return x <= ours; });
  return (1 + static_cast<double>(as_good)) / (1 + static_cast<double>(others.size()));
}

}  // namespace nlmech::chapters::hermitian
