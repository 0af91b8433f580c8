#include <algorithm>
#include <array>
#include <optional>

#include "nlmech/series/tape.hpp"

namespace nlmech {

using Node = TapeRecorder::Node;
using Step = TapeRecorder::Step;
using tape::Instruction;
using tape::Operation;

namespace {

bool is_sum(Step step) { return step == Step::sum || step == Step::difference; }
bool is_linear(Step step) {
  return is_sum(step) || step == Step::scaled || step == Step::divided || step == Step::shifted;
}
bool has_two_operands(Step step) {
  return is_sum(step) || step == Step::product || step == Step::quotient || step >= Step::arc_sine;
}

}  // namespace

/// Makes the instructions of a tape from recorded operations.
class TapeCompiler {
 public:
  TapeCompiler(const std::vector<Node>& nodes, int size)
      : nodes_(nodes), size_(size), uses_(nodes.size()), absorbed_(nodes.size()), series_(nodes.size(), -1) {}

  Tape compile(const std::vector<tape::Output>& outputs) {
    count_uses(outputs);
    absorb();
    for (int i = 0; i <= size_; ++i) series_[at(i)] = i;
    tape_.series_ = size_ + 1;
    for (int i = size_ + 1; i < static_cast<int>(nodes_.size()); ++i) {
      if (uses_[at(i)] > 0 && !absorbed_[at(i)] && series_[at(i)] < 0) emit(i);
    }
    for (tape::Output output : outputs) {
      if (output.series >= 0) output.series = series_[at(output.series)];
      tape_.outputs_.push_back(output);
    }
    return std::move(tape_);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] const Node& node(int i) const { return nodes_[at(i)]; }

  // An output counts twice: its series must exist.
  void count_uses(const std::vector<tape::Output>& outputs) {
    for (const tape::Output& output : outputs) {
      if (output.series >= 0) uses_[at(output.series)] += 2;
    }
    for (int i = static_cast<int>(nodes_.size()) - 1; i > size_; --i) {
      if (uses_[at(i)] == 0) continue;
      ++uses_[at(node(i).a)];
      if (has_two_operands(node(i).step)) ++uses_[at(node(i).b)];
    }
  }

  // Which sums and multiples are parts of a greater linear combination and need no series of their own. The
  // second operand of a sum stays whole if it is a sum itself: a - (b - c) is not a - b + c in rounding.
  void absorb() {
    for (int i = static_cast<int>(nodes_.size()) - 1; i > size_; --i) {
      const Step step = node(i).step;
      if (uses_[at(i)] == 0 || !is_linear(step)) continue;
      const bool is_term = absorbed_[at(i)] && !is_sum(step);
      if (is_term) continue;
      take(node(i).a, true);
      if (is_sum(step)) take(node(i).b, false);
    }
  }
  void take(int i, bool sums_too) {
    const Step step = node(i).step;
    if (i > size_ && uses_[at(i)] == 1 && (step == Step::scaled || (sums_too && is_sum(step))))
      absorbed_[at(i)] = true;
  }

  void add_terms(int i, double sign) {
    const Node& n = node(i);
    if (!absorbed_[at(i)]) {
      tape_.terms_.push_back({sign, series_[at(i)]});
    } else if (n.step == Step::scaled) {
      tape_.terms_.push_back({sign * n.constant, series_[at(n.a)]});
    } else {
      add_sum(n, sign);
    }
  }
  void add_sum(const Node& n, double sign) {
    add_terms(n.a, sign);
    add_terms(n.b, n.step == Step::sum ? sign : -sign);
  }

  int new_series(int count = 1) {
    const int first = tape_.series_;
    tape_.series_ += count;
    return first;
  }
  Instruction instruction(Operation operation, int a, int b, int count = 1) {
    return {operation, false, new_series(count), a, b, a, 0, 0, 1, 1, 0};
  }

  // The series t a'(t) of the argument of a function, once for all functions of it.
  int slope_of(int i) {
    const int a = series_[at(i)];
    for (const Instruction& known : tape_.instructions_) {
      if (known.operation == Operation::slope && known.a == a) return known.r;
    }
    const Instruction slope = instruction(Operation::slope, a, a);
    tape_.instructions_.push_back(slope);
    return slope.r;
  }

  void emit(int i) {
    const Node& n = node(i);
    Instruction made = is_linear(n.step) ? linear(n) : has_two_operands(n.step) ? of_two(n) : of_one(n);
    tape_.instructions_.push_back(made);
    series_[at(i)] = made.r;
    if (made.operation != Operation::circular && made.operation != Operation::hyperbolic) return;
    // Sine and cosine of one argument are computed together; either may be met first.
    const bool cosine = n.step == Step::cosine || n.step == Step::hyperbolic_cosine;
    series_[at(i)] = cosine ? made.r + 1 : made.r;
    const Step partner = n.step == Step::sine                ? Step::cosine
                         : n.step == Step::cosine            ? Step::sine
                         : n.step == Step::hyperbolic_cosine ? Step::hyperbolic_sine
                                                             : Step::hyperbolic_cosine;
    for (std::size_t j = at(i) + 1; j < nodes_.size(); ++j) {
      if (nodes_[j].step == partner && nodes_[j].a == n.a) series_[j] = cosine ? made.r : made.r + 1;
    }
  }

  Instruction linear(const Node& n) {
    const auto first = static_cast<int>(tape_.terms_.size());
    Instruction made{Operation::linear, false, 0, 0, 0, 0, first, 0, 1, 1, 0};
    if (is_sum(n.step)) {
      add_sum(n, 1);
    } else if (n.step == Step::scaled && !absorbed_[at(n.a)]) {
      tape_.terms_.push_back({n.constant, series_[at(n.a)]});
    } else {
      add_terms(n.a, 1);
      if (n.step == Step::scaled) made.factor = n.constant;
      if (n.step == Step::divided) made.divisor = n.constant;
      if (n.step == Step::shifted) made.shift = n.constant;
    }
    made.count = static_cast<int>(tape_.terms_.size()) - first;
    made.r = new_series();
    return made;
  }

  Instruction of_two(const Node& n) {
    int a = n.a, b = n.b;
    if (n.step == Step::quotient) return instruction(Operation::quotient, series_[at(a)], series_[at(b)]);
    if (n.step >= Step::arc_sine) return of_slope(n);
    if (node(b).degree == 1) std::swap(a, b);
    const Operation operation = node(a).degree == 1 ? Operation::product_by_line
                                : a == b            ? Operation::square
                                                    : Operation::product;
    return instruction(operation, series_[at(a)], series_[at(b)]);
  }

  // A function made of its slope.
  Instruction of_slope(const Node& n) {
    const int a = series_[at(n.a)], b = series_[at(n.b)];
    const int slope =
        n.step == Step::angle ? slope_of_angle(n) : emitted(Operation::product, slope_of(n.a), b);
    Instruction made = instruction(function(n.step), a, b);
    made.extra = slope;
    return made;
  }
  // Of atan2(y, x): (x y' - y x')/(x^2 + y^2).
  int slope_of_angle(const Node& n) {
    const int y = series_[at(n.a)], x = series_[at(n.b)];
    const int up = emitted(Operation::product, x, slope_of(n.a)),
              down = emitted(Operation::product, y, slope_of(n.b));
    const int squares = combined(emitted(Operation::square, x, x), 1, emitted(Operation::square, y, y));
    return emitted(Operation::quotient, combined(up, -1, down), squares);
  }
  int emitted(Operation operation, int a, int b) {
    tape_.instructions_.push_back(instruction(operation, a, b));
    return tape_.instructions_.back().r;
  }
  int combined(int a, double factor, int b) {
    const auto first = static_cast<int>(tape_.terms_.size());
    tape_.terms_.push_back({1, a});
    tape_.terms_.push_back({factor, b});
    tape_.instructions_.push_back({Operation::linear, false, new_series(), 0, 0, 0, first, 2, 1, 1, 0});
    return tape_.instructions_.back().r;
  }

  Instruction of_one(const Node& n) {
    const int a = series_[at(n.a)];
    if (n.step == Step::root) return instruction(Operation::root, a, a);
    if (n.step == Step::logarithm) return instruction(Operation::logarithm, a, a, 2);
    if (n.step == Step::reciprocal) {
      Instruction made = instruction(Operation::reciprocal, a, a);
      made.factor = n.constant;
      return made;
    }
    const int slope = slope_of(n.a);
    Instruction made = instruction(function(n.step), a, a, n.step == Step::exponential ? 1 : 2);
    made.extra = slope;
    made.factor = n.constant;
    made.line = node(n.a).degree == 1;
    return made;
  }
  static Operation function(Step step) {
    switch (step) {
      case Step::exponential: return Operation::exponential;
      case Step::sine:
      case Step::cosine: return Operation::circular;
      case Step::hyperbolic_sine:
      case Step::hyperbolic_cosine: return Operation::hyperbolic;
      case Step::tangent: return Operation::tangent;
      case Step::hyperbolic_tangent: return Operation::hyperbolic_tangent;
      case Step::arc_sine: return Operation::arc_sine;
      case Step::arc_cosine: return Operation::arc_cosine;
      case Step::arc_tangent: return Operation::arc_tangent;
      case Step::error_function: return Operation::error_function;
      case Step::angle: return Operation::angle;
      default: return Operation::power;
    }
  }

  const std::vector<Node>& nodes_;
  int size_;
  std::vector<int> uses_;
  std::vector<bool> absorbed_;
  std::vector<int> series_;  // of each node; -1: none yet
  Tape tape_;
};

Tape TapeRecorder::finish(const std::vector<tape::Output>& outputs) const {
  return TapeCompiler(nodes_, size_).compile(outputs);
}

int Tape::products() const {
  int count = 0;
  for (const Instruction& i : instructions_) {
    const bool linear = i.operation == Operation::linear || i.operation == Operation::slope ||
                        i.operation == Operation::product_by_line || i.line || tape::has_slope(i.operation);
    if (!linear) ++count;
  }
  return count;
}

bool Tape::depends_on_time() const {
  // Series 0 is the time, 1 to size() the state.
  std::vector<bool> is_time(outputs_.size() + 1);
  is_time[0] = true;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    is_time[i + 1] = outputs_[i].series < 0 && outputs_[i].constant != 0;
  const auto timed = [&](int series) {
    const auto at = static_cast<std::size_t>(series);
    return series >= 0 && at < is_time.size() && is_time[at];
  };
  // A linear combination has terms for operands.
  return std::ranges::any_of(instructions_,
                             [&](const Instruction& i) {
                               return i.operation != Operation::linear && (timed(i.a) || timed(i.b));
                             }) ||
         std::ranges::any_of(terms_, [&](const tape::Term& t) { return timed(t.series); }) ||
         std::ranges::any_of(outputs_, [&](const tape::Output& o) { return timed(o.series); });
}

tape::Program Tape::program() const {
  return {instructions_.data(), static_cast<int>(instructions_.size()),
          terms_.data(),        static_cast<int>(terms_.size()),
          outputs_.data(),      size()};
}

}  // namespace nlmech
