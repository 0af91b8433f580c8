#include "nlmech/spacecraft/residues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/sign_change.hpp"

namespace nlmech::spacecraft {
namespace {

Complex power(Complex p, int order) {
  Complex result = 1;
  for (int i = 0; i < order; ++i) result *= p;
  return result;
}

/// The largest modulus of a pole, which the sampling must resolve.
double fastest(const ExponentialSum& f) {
  double rate = 0;
  for (const Complex p : f.poles()) rate = std::max(rate, std::abs(p));
  return rate;
}

/// The root of f^(order) - @p offset between @p a and @p b, where it has opposite signs, by bracketing.
double halve(const ExponentialSum& f, int order, double offset, double a, double b) {
  return sign_change([&](double t) { return f.value(t, order) - offset; }, a, b);
}

/// The largest value of sign * f in [a, b], an interval short enough for four samples to resolve f.
Extreme local_maximum(const ExponentialSum& f, double sign, double a, double b) {
  constexpr int parts = 4;
  Extreme best{a, f.value(a)};
  const auto consider = [&](double t) {
    if (const double value = f.value(t); sign * value > sign * best.value) best = {t, value};
  };
  double before = sign * f.value(a, 1);
  for (int i = 1; i <= parts; ++i) {
    const double left = a + (b - a) * (i - 1) / parts, right = a + (b - a) * i / parts;
    const double slope = sign * f.value(right, 1);
    consider(right);
    if (before > 0 && slope <= 0) consider(halve(f, 1, 0, left, right));
    before = slope;
  }
  return best;
}

/// Samples of a sum without its smallest terms, a quarter of a radian of the fastest term apart.
struct Sampled {
  double from, step;
  std::vector<double> values;
  double slack;  ///< largest excess of f over an adjacent sample
};

Sampled sampled(const ExponentialSum& f, double remainder, double from, double until, double most) {
  const ExponentialSum main = f.without_small(remainder);
  const double rate = std::max(fastest(main), 1 / (until - from));
  const auto count = static_cast<std::size_t>(std::min(std::ceil((until - from) * rate * 4), most)) + 8;
  const double step = (until - from) / static_cast<double>(count);
  const double curvature = main.derivative().derivative().envelope(from);
  return {from, step, main.samples(from, step, count + 1), remainder + curvature * step * step / 8};
}

double largest_of(const std::vector<double>& values, double sign) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double v : values) largest = std::max(largest, sign * v);
  return largest;
}

/// The largest value of sign * f in an interval: samples of the dominant terms select candidates, samples
/// with all terms down to 1e-7 reduce them, and the complete sum refines them.
/// @param coarse samples of the dominant terms
Extreme maximum(const ExponentialSum& f, const Sampled& coarse, double sign, double from, double until) {
  const double size = f.envelope(from);
  const double enough = largest_of(coarse.values, sign) - 2 * coarse.slack;
  std::vector<Extreme> candidates = {{from, f.value(from)}, {until, f.value(until)}};
  double largest = std::max(sign * candidates[0].value, sign * candidates[1].value), slack = 0, width = 0;
  std::size_t samples = 0;
  const std::size_t count = coarse.values.size();
  for (std::size_t i = 0; i < count && samples < 2'000'000; ++i) {
    if (sign * coarse.values[i] < enough) continue;
    // Adjacent candidates form one interval.
    std::size_t last = i;
    while (last + 1 < count && sign * coarse.values[last + 1] >= enough) ++last;
    const double a = std::max(from, from + (static_cast<double>(i) - 0.5) * coarse.step);
    const double b = std::min(until, from + (static_cast<double>(last) + 0.5) * coarse.step);
    const Sampled fine = sampled(f, 1e-7 * size, a, b, 2e4);
    samples += fine.values.size();
    for (std::size_t k = 0; k < fine.values.size(); ++k)
      candidates.push_back({a + static_cast<double>(k) * fine.step, fine.values[k]});
    largest = std::max(largest, largest_of(fine.values, sign));
    slack = std::max(slack, fine.slack);
    width = std::max(width, fine.step);
    i = last;
  }
  // With terms down to 1e-7 the curvature bound overestimates by far.
  slack = std::min(slack, 1e-5 * size);
  Extreme best = sign * candidates[0].value >= sign * candidates[1].value ? candidates[0] : candidates[1];
  int refined = 0;
  for (const Extreme& c : candidates) {
    if (sign * c.value < largest - 2 * slack || ++refined > 5000) continue;
    const Extreme near =
        local_maximum(f, sign, std::max(from, c.time - width / 2), std::min(until, c.time + width / 2));
    if (sign * near.value > sign * best.value) best = near;
  }
  return best;
}

/// The last crossing of the edge of the band in [a, b] by the complete sum; negative if there is none.
double last_crossing(const ExponentialSum& f, double centre, double band, double a, double b) {
  constexpr int parts = 48;
  double right = b, slope = f.value(b, 1);
  for (int i = parts; i-- > 0;) {
    const double left = a + (b - a) * i / parts, before = f.value(left, 1);
    // The largest distance in this part is at its left end, or where the slope changes sign.
    double far = left;
    if (before * slope < 0) {
      const double top = halve(f, 1, 0, left, right);
      if (std::abs(f.value(top) - centre) > std::abs(f.value(left) - centre)) far = top;
    }
    if (std::abs(f.value(far) - centre) > band) {
      const double sign = f.value(far) > centre ? 1 : -1;
      return halve(f, 0, centre + sign * band, far, right);
    }
    right = left;
    slope = before;
  }
  return -1;
}

}  // namespace

ExponentialSum::ExponentialSum(const std::array<double, 3>& polynomial, std::vector<Complex> poles,
                               std::vector<Complex> weights)
    : polynomial_(polynomial), poles_(std::move(poles)), weights_(std::move(weights)) {
  if (poles_.size() != weights_.size())
    throw invalid_argument("ExponentialSum: {} poles and {} weights", poles_.size(), weights_.size());
  const bool all =
      std::all_of(poles_.begin(), poles_.end(), is_finite) &&
      std::all_of(weights_.begin(), weights_.end(), is_finite) &&
      std::all_of(polynomial_.begin(), polynomial_.end(), [](double c) { return std::isfinite(c); });
  if (!all) throw std::invalid_argument("ExponentialSum: a coefficient is not finite");
}

double ExponentialSum::value(double time, int order) const {
  double sum = 0;
  // Fast terms are mostly small; adding them first reduces rounding.
  for (std::size_t k = poles_.size(); k-- > 0;)
    sum += (weights_[k] * power(poles_[k], order) * std::exp(poles_[k] * time)).real();
  const auto [c0, c1, c2] = polynomial_;
  double smooth = c0 + time * (c1 + time * c2);
  if (order == 1) smooth = c1 + 2 * time * c2;
  if (order == 2) smooth = 2 * c2;
  return 2 * sum + (order > 2 ? 0 : smooth);
}

std::vector<double> ExponentialSum::samples(double first, double step, std::size_t count) const {
  constexpr std::size_t block = 64;  // limits the rounding of repeated multiplication
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = first + static_cast<double>(i) * step;
    values[i] = polynomial_[0] + t * (polynomial_[1] + t * polynomial_[2]);
  }
  for (std::size_t k = poles_.size(); k-- > 0;) {
    const Complex turn = std::exp(poles_[k] * step);
    for (std::size_t begin = 0; begin < count; begin += block) {
      const double t = first + static_cast<double>(begin) * step;
      const Complex term = 2. * weights_[k] * std::exp(poles_[k] * t);
      double re = term.real(), im = term.imag();
      for (std::size_t i = begin; i < std::min(begin + block, count); ++i) {
        values[i] += re;
        // Written out because std::complex's product checks for infinities.
        const double real = re * turn.real() - im * turn.imag();
        im = re * turn.imag() + im * turn.real();
        re = real;
      }
    }
  }
  return values;
}

ExponentialSum ExponentialSum::derivative() const {
  ExponentialSum d = *this;
  d.polynomial_ = {polynomial_[1], 2 * polynomial_[2], 0};
  for (std::size_t k = 0; k < poles_.size(); ++k) d.weights_[k] *= poles_[k];
  return d;
}

double ExponentialSum::envelope(double time) const {
  double sum = 0;
  for (std::size_t k = poles_.size(); k-- > 0;)
    sum += std::abs(weights_[k]) * std::exp(poles_[k].real() * time);
  return 2 * sum;
}

double ExponentialSum::uncertainty(double time) const {
  const double unit = 4 * std::numeric_limits<double>::epsilon() * time;
  double sum = 0;
  for (std::size_t k = poles_.size(); k-- > 0;)
    sum +=
        std::abs(weights_[k]) * std::exp(poles_[k].real() * time) * std::min(1., unit * std::abs(poles_[k]));
  return 2 * sum;
}

ExponentialSum ExponentialSum::without_small(double remainder) const {
  std::vector<std::size_t> order(poles_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    return std::abs(weights_[a]) < std::abs(weights_[b]);
  });
  double left_out = 0;
  std::vector<bool> remains(poles_.size(), true);
  for (const std::size_t k : order) {
    left_out += 2 * std::abs(weights_[k]);
    if (left_out > remainder) break;
    remains[k] = false;
  }
  ExponentialSum main;
  main.polynomial_ = polynomial_;
  for (std::size_t k = 0; k < poles_.size(); ++k) {
    if (!remains[k]) continue;
    main.poles_.push_back(poles_[k]);
    main.weights_.push_back(weights_[k]);
  }
  return main;
}

SquareIntegral square_integral(const ExponentialSum& f) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const std::vector<Complex>&p = f.poles(), &w = f.weights();
  SquareIntegral integral;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Complex sum = 0;
    for (std::size_t j = 0; j < p.size(); ++j)
      sum += w[j] / (p[i] + p[j]) + std::conj(w[j]) / (p[i] + std::conj(p[j]));
    integral.value -= 2 * (w[i] * sum).real();
    const double decay = std::abs(p[i].real()), error = rounding * std::abs(p[i]);
    integral.uncertainty += 2 * std::norm(w[i]) / std::max(decay, error) * std::min(1., error / decay);
  }
  return integral;
}

Extremes extremes(const ExponentialSum& f, double from, double until) {
  if (!(from >= 0 && until > from && std::isfinite(until)))
    throw invalid_argument("extremes: from {:g} until {:g} s is no interval of times", from, until);
  const Sampled coarse = sampled(f, 2e-4 * f.envelope(from), from, until, 4e6);
  return {maximum(f, coarse, -1, from, until), maximum(f, coarse, 1, from, until)};
}

Settling settling_time(const ExponentialSum& f, double final_value, double band, double latest) {
  if (!(band > 0 && latest > 0 && std::isfinite(band) && std::isfinite(latest)))
    throw invalid_argument("settling_time: band {:g} and latest time {:g} must be positive", band, latest);
  const double offset = std::abs(f.polynomial()[0] - final_value);
  const auto late = [&](double sought) {
    return Settling{0, failed_with(Outcome::not_converged,
                                   "settling_time: does not stay within {:g} of {:g} from any time before "
                                   "{:g} s; allow a later time or a wider band",
                                   band, final_value, sought)};
  };
  if (offset >= band || f.polynomial()[1] != 0 || f.polynomial()[2] != 0) return late(latest);
  // After `end` the sum of the moduli keeps f within the band.
  double begin = 0, end = latest;
  if (offset + f.envelope(end) > band) return late(latest);
  for (int i = 0; i < 100 && end - begin > 1e-3 * end; ++i) {
    const double middle = (begin + end) / 2;
    (offset + f.envelope(middle) > band ? begin : end) = middle;
  }
  const double remainder = 0.02 * band;
  const ExponentialSum main = f.without_small(remainder);
  const double step = 0.25 / std::max(fastest(main), 1 / end);
  if (end / step > 2e7) return late(end);
  constexpr std::size_t block = 4096;
  double right = end;
  while (right > 0) {
    const double left = std::max(0., right - static_cast<double>(block) * step);
    const std::size_t count = static_cast<std::size_t>(std::ceil((right - left) / step)) + 1;
    const double actual = (right - left) / static_cast<double>(count - 1);
    const std::vector<double> samples = main.samples(left, actual, count);
    for (std::size_t i = count; i-- > 0;) {
      const double time = left + static_cast<double>(i) * actual,
                   distance = std::abs(samples[i] - final_value);
      // Samples a quarter of a radian apart miss 1 % of a crest, and their sum truncates 2 % of the band. So
      // the complete sum is evaluated next to every sample above 96 % of the band.
      if (distance < 0.96 * band) continue;
      const double crossing = last_crossing(f, final_value, band, std::max(0., time - actual), time + actual);
      if (crossing >= 0) return {crossing, {}};
    }
    right = left;
  }
  return {};
}

}  // namespace nlmech::spacecraft
