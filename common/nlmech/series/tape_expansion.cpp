#include "nlmech/series/tape_expansion.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace nlmech {

using tape::Instruction;
using tape::Operation;

namespace {

tape::Replay kernel(InstructionSet set) {
  if (!available(set)) {
    throw std::invalid_argument("TapeExpansion: this processor has no " + std::string(to_string(set)));
  }
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return tape::avx512_replay;
  if (set == InstructionSet::avx2) return tape::avx2_replay;
#endif
  return tape::baseline_replay;
}

/// Coefficient 0 of an instruction; @p x is that of its argument, @p other of the second one. The result and
/// that of its companion.
std::pair<double, double> value(const Instruction& i, double x, double other) {
  switch (i.operation) {
    case Operation::product:
    case Operation::product_by_line:
    case Operation::square: return {x * other, 0};
    case Operation::quotient: return {x / other, 0};
    case Operation::reciprocal: return {i.factor / x, 0};
    case Operation::root: return {std::sqrt(x), 0};
    case Operation::exponential: return {std::exp(x), 0};
    case Operation::circular: return {std::sin(x), std::cos(x)};
    case Operation::hyperbolic: return {std::sinh(x), std::cosh(x)};
    case Operation::tangent: return {std::tan(x), 1 + std::tan(x) * std::tan(x)};
    case Operation::hyperbolic_tangent: return {std::tanh(x), 1 / (std::cosh(x) * std::cosh(x))};
    case Operation::logarithm: return {std::log(x), 0};
    case Operation::power: return {std::pow(x, i.factor), 0};
    case Operation::arc_sine: return {std::asin(x), 0};
    case Operation::arc_cosine: return {std::acos(x), 0};
    case Operation::arc_tangent: return {std::atan(x), 0};
    case Operation::angle: return {std::atan2(x, other), 0};
    case Operation::error_function: return {std::erf(x), 0};
    default: return {0, 0};
  }
}

bool has_companion(Operation operation) { return operation >= Operation::circular; }

}  // namespace

InstructionSet replay_instruction_set() noexcept {
  return available(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

TapeExpansion::TapeExpansion(InstructionSet set) : replay_(kernel(set)) {}

void TapeExpansion::load(Tape tape, int order) {
  tape_ = std::move(tape);
  order_ = order;
  // Whole lines of memory, an odd number of them.
  stride_ = std::ptrdiff_t{8} * ((order + 8) / 8);
  if (stride_ % 16 == 0) stride_ += 8;
  memory_.assign(static_cast<std::size_t>(tape_.series() * stride_), 0.0);
  factor_.assign(static_cast<std::size_t>(order) + 1, 0.0);
  scale_ = 0;
}

void TapeExpansion::expand(double t, const double* x, double scale) {
  if (scale != scale_) {
    scale_ = scale;
    for (std::size_t k = 0; k < factor_.size(); ++k) factor_[k] = scale * (1 / static_cast<double>(k + 1));
  }
  memory_[0] = t;
  memory_[1] = scale;
  for (int i = 0; i < tape_.size(); ++i) memory_[static_cast<std::size_t>((i + 1) * stride_)] = x[i];
  first_pass(scale);
  replay_(tape_.program(), memory_.data(), stride_, order_, scale, factor_.data());
}

void TapeExpansion::first_pass(double scale) {
  const tape::Program program = tape_.program();
  const auto at = [&](int series) -> double& { return memory_[static_cast<std::size_t>(series * stride_)]; };
  for (int j = 0; j < program.instruction_count; ++j) {
    const Instruction& i = program.instructions[j];
    if (i.operation == Operation::linear) {
      double sum = 0;
      for (int m = i.first; m < i.first + i.count; ++m) {
        const double term = program.terms[m].factor * at(program.terms[m].series);
        sum = m == i.first ? term : sum + term;
      }
      at(i.r) = i.factor * (sum + i.shift) / i.divisor;
    } else {
      const auto [result, companion] = value(i, at(i.a), at(i.b));
      at(i.r) = result;
      if (has_companion(i.operation)) at(i.r + 1) = companion;
    }
  }
  for (int i = 0; i < program.size; ++i) {
    const tape::Output& output = program.outputs[i];
    (&at(i + 1))[1] = scale * (output.series < 0 ? output.constant : at(output.series));
  }
}

}  // namespace nlmech
