#include "nlmech/comparison/reference/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

/// Two computations that differ by more than this share know nothing.
constexpr double worthless = 1e-2;

/// A computation that arrived.
struct Arrived {
  Candidate by;
  StatesAt states;
};

Eigen::VectorXd size_of(const StatesAt& states) {
  return states.cwiseAbs().rowwise().maxCoeff().cast<double>();
}

/// |x|, or a thousandth of the component's size where that is greater; 1 for what is zero throughout.
double magnitude(double x, double size) {
  const double most = std::max(std::abs(x), 1e-3 * size);
  return most > 0 ? most : 1;
}

struct Distance {
  double in_needs = 0;  ///< greatest difference in units of what is needed
  double relative = 0;  ///< greatest difference relative to the size of its component
};

Distance distance(const StatesAt& a, const StatesAt& b, const Needed& needed) {
  const Eigen::VectorXd size = size_of(a);
  Distance most;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const auto difference = static_cast<double>(std::abs(a(i, k) - b(i, k)));
      const double scale = magnitude(static_cast<double>(a(i, k)), size[i]);
      most.in_needs = std::max(most.in_needs, difference / (needed.absolute + needed.relative * scale));
      most.relative = std::max(most.relative, difference / std::max(size[i], needed.absolute));
    }
  }
  return most;
}

Reference made_of(const Arrived& a, const Arrived& b) {
  Reference r;
  r.first = a.by;
  r.second = b.by;
  r.states = a.states;
  r.doubt = (a.states - b.states).cwiseAbs().cast<double>();
  r.size = size_of(a.states);
  return r;
}

/// A computation that did not arrive.
struct Failed {
  std::string name;
  bool extended;
  Outcome outcome;
};

/// Steps shrink to nothing at a singularity, and in extended precision not for rounding.
bool meets_an_end(const std::vector<Failed>& failed) {
  const auto shrinks = [](const Failed& f) { return f.outcome == Outcome::step_underflow; };
  return std::any_of(failed.begin(), failed.end(),
                     [&](const Failed& f) { return f.extended && shrinks(f); }) &&
         std::count_if(failed.begin(), failed.end(), shrinks) >= 2;
}

/// No two agree.
Reference none_of(const std::vector<Arrived>& arrived, const Arrived* a, const Arrived* b, double apart,
                  const std::vector<Failed>& failed) {
  std::string why = "no two methods arrived within the work allowed";
  if (a != nullptr)
    why = fmt::format("the two methods nearest to each other, {} and {}, differ by {:.2g} of the solution",
                      a->by.name, b->by.name, apart);
  std::string separator = "; not there: ";
  for (const Failed& f : failed) {
    why += fmt::format("{}{} ({})", separator, f.name, to_string(f.outcome));
    separator = ", ";
  }
  Reference none;
  none.status = Status::failure(Outcome::not_converged, why);
  none.undetermined =
      std::count_if(arrived.begin(), arrived.end(), [](const Arrived& x) { return x.by.extended; }) >= 2;
  none.ends = meets_an_end(failed);
  return none;
}

/// The two that agree best so far.
class Best {
 public:
  void see(const std::vector<Arrived>& arrived, const Needed& needed) {
    for (std::size_t i = 0; i + 1 < arrived.size(); ++i) {
      const Distance d = distance(arrived[i].states, arrived.back().states, needed);
      if (!(d.in_needs < distance_.in_needs)) continue;
      distance_ = d;
      first_ = i;
      second_ = arrived.size() - 1;
    }
  }
  [[nodiscard]] const Distance& apart() const { return distance_; }
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t second() const { return second_; }

 private:
  Distance distance_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::size_t first_ = 0, second_ = 0;
};

}  // namespace

double Reference::uncertainty() const {
  double worst = 0;
  const Eigen::Index last = states.cols() - 1;
  for (Eigen::Index i = 0; i < states.rows(); ++i)
    worst = std::max(worst, doubt(i, last) / magnitude(static_cast<double>(states(i, last)), size[i]));
  return worst;
}

std::string Reference::text() const {
  if (!status.ok()) return status.sentence();
  const double digits = std::min(18.0, -std::log10(std::max(uncertainty(), 1e-19)));
  return fmt::format("{} and {} agree to {:.1f} digits", first.name, second.name, digits);
}

Reference agree(const std::vector<Candidate>& candidates, const Way& way, const Needed& needed,
                double seconds) {
  const Stopwatch watch;
  std::vector<Arrived> arrived;
  std::vector<Failed> failed;
  std::vector<std::string> failed_families;
  Best best;
  for (const Candidate& c : candidates) {
    const bool hopeless = !c.family.empty() && std::find(failed_families.begin(), failed_families.end(),
                                                         c.family) != failed_families.end();
    if (hopeless) continue;
    if (watch.seconds() >= seconds) break;
    StatesAt states;
    const Status status = c.compute(way, seconds - watch.seconds(), states);
    if (!status.ok()) {
      failed_families.push_back(c.family);
      failed.push_back({c.name, c.extended, status.outcome()});
      continue;
    }
    arrived.push_back({c, std::move(states)});
    best.see(arrived, needed);
    if (best.apart().in_needs <= 1) break;
    // Two that work in extended precision and part: no method in double precision knows better.
    if (c.extended && arrived.size() >= 2 && best.apart().relative > worthless) break;
  }
  const bool some = std::isfinite(best.apart().in_needs);
  if (some && best.apart().relative <= worthless)
    return made_of(arrived[best.first()], arrived[best.second()]);
  return none_of(arrived, some ? &arrived[best.first()] : nullptr, some ? &arrived[best.second()] : nullptr,
                 best.apart().relative, failed);
}

std::vector<double> look_at(double t0, double t1, int count) {
  std::vector<double> times;
  for (int k = 1; k < count; ++k) {
    const double t = t0 + (t1 - t0) * (static_cast<double>(k) / count);
    const bool is_new = t != t0 && t != t1 && (times.empty() || t != times.back());
    if (is_new && std::isfinite(t)) times.push_back(t);
  }
  times.push_back(t1);
  return times;
}

}  // namespace nlmech::comparison
