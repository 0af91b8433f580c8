#include "nlmech/program/tape_lanes.hpp"

#include <algorithm>
#include <utility>

#include "nlmech/program/tape_values.hpp"

namespace nlmech {

using tape::Instruction;
using tape::Operation;

namespace {

const tape::LaneKernel& lane_kernel(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return tape::avx512_lanes;
  if (set == InstructionSet::avx2) return tape::avx2_lanes;
#endif
  return tape::baseline_lanes;
}

// Numbers of 1 and -1 are omitted in machine code, so both or none must be one.
bool alike(double a, double b) { return (a == 1) == (b == 1) && (a == -1) == (b == -1); }
bool alike(const tape::Term& a, const tape::Term& b) {
  return a.series == b.series && alike(a.factor, b.factor);
}
// Do both have the same operation and series?
bool alike(const Instruction& a, const Instruction& b) {
  return a.operation == b.operation && a.line == b.line && a.r == b.r && a.a == b.a && a.b == b.b &&
         a.extra == b.extra && a.first == b.first && a.count == b.count && alike(a.factor, b.factor) &&
         alike(a.divisor, b.divisor);
}

}  // namespace

TapeLanes::TapeLanes(InstructionSet set) : kernel_(&lane_kernel(set)), lanes_(kernel_->lanes), set_(set) {}

TapeLanes::Numbers TapeLanes::zeros(std::ptrdiff_t count) {
  const auto size = static_cast<std::size_t>(count);
  Numbers numbers(static_cast<double*>(::operator new[](size * sizeof(double), std::align_val_t{64})));
  std::fill_n(numbers.get(), size, 0.0);
  return numbers;
}

void TapeLanes::load(Tape tape, int order, machine_code::SeriesCodes* codes) {
  if (set_ != InstructionSet::baseline)
    code_ = codes != nullptr ? codes->of(tape, order, lanes(), repays_after)
                             : std::make_shared<const machine_code::SeriesCode>(repays_after);
  tape_ = std::move(tape);
  order_ = order;
  const tape::Program program = tape_.program();
  const auto rows = [this](int count) { return zeros(std::ptrdiff_t{count} * lanes_); };
  memory_ = zeros(std::ptrdiff_t{tape_.series()} * (order + 1) * lanes_);
  constants_ = rows(tape::output_of(program, program.size));
  scales_ = rows(1);
  arguments_ = rows(1);
  tails_ = rows(3);
  for (Numbers* each : {&carries_, &ends_, &end_carries_}) *each = rows(program.size);
  reciprocals_ = tape::reciprocals(order);
  for (int lane = 0; lane < lanes_; ++lane) put(lane, tape_);
}

bool TapeLanes::fits(const Tape& tape) const {
  const tape::Program a = tape_.program(), b = tape.program();
  if (a.size != b.size || a.instruction_count != b.instruction_count || a.term_count != b.term_count)
    return false;
  const auto same = [](const auto& x, const auto& y) { return alike(x, y); };
  return std::equal(a.instructions, a.instructions + a.instruction_count, b.instructions, same) &&
         std::equal(a.terms, a.terms + a.term_count, b.terms, same) &&
         std::equal(a.outputs, a.outputs + a.size, b.outputs,
                    [](const tape::Output& x, const tape::Output& y) { return x.series == y.series; });
}

void TapeLanes::put(int lane, const Tape& tape) {
  const tape::Program program = tape.program();
  for (int j = 0; j < program.instruction_count; ++j) {
    const Instruction& i = program.instructions[j];
    constant(tape::factor_of(j))[lane] = i.factor;
    constant(tape::divisor_of(j))[lane] = i.divisor;
    constant(tape::shift_of(j))[lane] = i.shift;
  }
  for (int m = 0; m < program.term_count; ++m)
    constant(tape::term_of(program, m))[lane] = program.terms[m].factor;
  for (int i = 0; i < program.size; ++i)
    constant(tape::output_of(program, i))[lane] = program.outputs[i].constant;
}

void TapeLanes::set(int lane, double t, const double* x, double scale) {
  set_time(lane, t, scale);
  for (int i = 0; i < tape_.size(); ++i) {
    at(i + 1, 0)[lane] = x[i];
    carries_.get()[i * lanes_ + lane] = 0;
  }
}

void TapeLanes::set_time(int lane, double t, double scale) {
  at(0, 0)[lane] = t;
  at(0, 1)[lane] = scales_.get()[lane] = scale;
}

void TapeLanes::expand() {
  const std::ptrdiff_t stride = (order_ + 1) * lanes_;
  if (code_ != nullptr) {
    const auto make = [&] { return machine_code::lane_coefficients(tape_.program(), stride, order_, set_); };
    if (auto* const code = (*code_)(make)) return code(memory_.get(), constants_.get(), scales_.get());
  }
  first_pass();
  kernel_->replay(tape_.program(), constants_.get(), memory_.get(), stride, order_, scales_.get(),
                  reciprocals_.data());
}

void TapeLanes::measure(double absolute_tolerance, double relative_tolerance) {
  kernel_->measure(memory_.get(), std::ptrdiff_t{order_ + 1} * lanes_, tape_.size(), order_,
                   absolute_tolerance, relative_tolerance, tails_.get());
}

void TapeLanes::advance() {
  kernel_->advance(memory_.get(), std::ptrdiff_t{order_ + 1} * lanes_, tape_.size(), order_, arguments_.get(),
                   carries_.get(), ends_.get(), end_carries_.get());
}

void TapeLanes::accept(int lane) {
  for (int i = 0; i < tape_.size(); ++i) {
    at(i + 1, 0)[lane] = ends_.get()[i * lanes_ + lane];
    carries_.get()[i * lanes_ + lane] = end_carries_.get()[i * lanes_ + lane];
  }
}

void TapeLanes::first_pass() {
  const tape::Program program = tape_.program();
  for (int j = 0; j < program.instruction_count; ++j) {
    const Instruction& i = program.instructions[j];
    if (i.operation == Operation::linear) {
      first_linear(program, j);
      continue;
    }
    const double *const a = at(i.a, 0), *const b = at(i.b, 0), *const factor = constant(tape::factor_of(j));
    double* const r = at(i.r, 0);
    double* const companion = tape::has_companion(i.operation) ? at(i.r + 1, 0) : nullptr;
    for (int lane = 0; lane < lanes_; ++lane) {
      const auto [result, second] = tape::first_coefficient(i, factor[lane], a[lane], b[lane]);
      r[lane] = result;
      if (companion != nullptr) companion[lane] = second;
    }
  }
  for (int i = 0; i < program.size; ++i) {
    const tape::Output& output = program.outputs[i];
    const double* const slope =
        output.series < 0 ? constant(tape::output_of(program, i)) : at(output.series, 0);
    double* const next = at(i + 1, 1);
    for (int lane = 0; lane < lanes_; ++lane) next[lane] = scales_.get()[lane] * slope[lane];
  }
}

void TapeLanes::first_linear(const tape::Program& program, int j) {
  const Instruction& i = program.instructions[j];
  double* const r = at(i.r, 0);
  for (int m = i.first; m < i.first + i.count; ++m) {
    const double *const factor = constant(tape::term_of(program, m)), *const a =
                                                                          at(program.terms[m].series, 0);
    for (int lane = 0; lane < lanes_; ++lane) {
      const double term = factor[lane] * a[lane];
      r[lane] = m == i.first ? term : r[lane] + term;
    }
  }
  const double *const factor = constant(tape::factor_of(j)), *const shift = constant(tape::shift_of(j)),
                      *const divisor = constant(tape::divisor_of(j));
  for (int lane = 0; lane < lanes_; ++lane) r[lane] = factor[lane] * (r[lane] + shift[lane]) / divisor[lane];
}

}  // namespace nlmech
