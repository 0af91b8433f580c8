#include "nlmech/program/tape_expansion.hpp"

#include <utility>

#include "nlmech/program/tape_values.hpp"

namespace nlmech {

using tape::Instruction;
using tape::Operation;

namespace {

tape::Replay kernel(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set != InstructionSet::baseline) return tape::avx2_replay;
#endif
  return tape::baseline_replay;
}

}  // namespace

InstructionSet replay_instruction_set() {
  return available(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

TapeExpansion::TapeExpansion(InstructionSet set) : replay_(kernel(set)) {}

void TapeExpansion::load(Tape tape, int order, machine_code::SeriesCodes* codes) {
  if (replay_ == tape::baseline_replay)
    code_ = nullptr;
  else if (codes != nullptr)
    code_ = codes->of(tape, order, 1, repays_after);
  else if (code_ == nullptr || order != order_ || !(tape == tape_))  // otherwise equations with their code
    code_ = std::make_shared<const machine_code::SeriesCode>(repays_after);
  tape_ = std::move(tape);
  order_ = order;
  // An odd number of whole cache lines.
  stride_ = std::ptrdiff_t{8} * ((order + 8) / 8);
  if (stride_ % 16 == 0) stride_ += 8;
  memory_.assign(static_cast<std::size_t>(tape_.series() * stride_), 0.0);
  reciprocals_ = tape::reciprocals(order);
}

void TapeExpansion::expand(double t, const double* x, double scale) {
  memory_[0] = t;
  memory_[1] = scale;
  for (int i = 0; i < tape_.size(); ++i) memory_[static_cast<std::size_t>((i + 1) * stride_)] = x[i];
  if (code_ != nullptr) {
    const auto make = [this] { return machine_code::coefficients(tape_.program(), stride_, order_); };
    if (auto* const code = (*code_)(make)) return code(memory_.data(), nullptr, &scale);
  }
  first_pass(scale);
  replay_(tape_.program(), nullptr, memory_.data(), stride_, order_, &scale, reciprocals_.data());
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
      const auto [result, companion] = tape::first_coefficient(i, i.factor, at(i.a), at(i.b));
      at(i.r) = result;
      if (tape::has_companion(i.operation)) at(i.r + 1) = companion;
    }
  }
  for (int i = 0; i < program.size; ++i) {
    const tape::Output& output = program.outputs[i];
    (&at(i + 1))[1] = scale * (output.series < 0 ? output.constant : at(output.series));
  }
}

}  // namespace nlmech
