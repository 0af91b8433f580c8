#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "nlmech/program/machine_code/assembler.hpp"
#include "nlmech/program/machine_code/machine_code.hpp"
#include "nlmech/program/tape_values.hpp"

namespace nlmech::machine_code {

using tape::Instruction;
using tape::Operation;

namespace {

// Sums of products in a pass.
int sums(const tape::Program& program) {
  return static_cast<int>(std::count_if(
      program.instructions, program.instructions + program.instruction_count, [](const Instruction& i) {
        return i.operation != Operation::linear && i.operation != Operation::product_by_line &&
               i.operation != Operation::slope;
      }));
}

}  // namespace

/// Makes the code of a tape: one pass after another for coefficients k = 0, 1, ..., with all sums unrolled.
/// Coefficients are stored at once; the newest stay in registers as well, as far as these suffice.
class SeriesAssembler : private Assembler {
 public:
  /// @param lanes of a register: 1 for one solution, otherwise 4 or 8
  /// @param parts registers of a number: 1 for one solution, otherwise 2
  SeriesAssembler(const tape::Program& program, std::int64_t stride, int order, int lanes, int parts)
      : Assembler(lanes),
        program_(program),
        stride_(stride),
        order_(order),
        lanes_(lanes),
        parts_(parts),
        registers_(lanes == 8 ? 32 : 16),
        first_register_(lanes == 1 ? 7 : 11),
        gathers_(sums(program) <= most_gathering_sums),
        partners_(index(program.instruction_count), none) {
    if (lanes > 1) find_partners();
  }

  [[nodiscard]] std::shared_ptr<Coefficients> make() {
    for (const auto& saved : {rbx, r12, r13}) push(saved);
    mov(rbx, rdi);
    mov(r12, rsi);
    mov(r13, rdx);
    first_pass();
    for (k_ = 1; k_ < order_; ++k_) pass();
    vzeroupper();
    for (const auto& saved : {r13, r12, rbx}) pop(saved);
    return finish<Coefficients>();
  }

 private:
  using Register = Xbyak::Xmm;  // of any width
  using Operand = Xbyak::Operand;
  using Address = Xbyak::Address;
  static constexpr int none = -1;
  // Passes of more sums take so long that their loads do not wait for the stores of the pass before.
  static constexpr int most_gathering_sums = 6;

  [[nodiscard]] bool is_single() const { return lanes_ == 1; }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // --- operations on all lanes of a register ---

  [[nodiscard]] Register at(int i) const {
    return Register(is_single() ? Operand::XMM : lanes_ == 4 ? Operand::YMM : Operand::ZMM, i);
  }
  void load(const Register& to, const Address& from) { is_single() ? vmovsd(to, from) : vmovupd(to, from); }
  void store(const Address& to, const Register& from) { is_single() ? vmovsd(to, from) : vmovupd(to, from); }
  void copy(const Register& to, const Register& from) { vmovapd(to, from); }
  void zero(const Register& r) { vxorpd(r, r, r); }
  void add(const Register& r, const Register& a, const Operand& b) {
    is_single() ? vaddsd(r, a, b) : vaddpd(r, a, b);
  }
  void subtract(const Register& r, const Register& a, const Operand& b) {
    is_single() ? vsubsd(r, a, b) : vsubpd(r, a, b);
  }
  void multiply(const Register& r, const Register& a, const Operand& b) {
    is_single() ? vmulsd(r, a, b) : vmulpd(r, a, b);
  }
  void divide(const Register& r, const Register& a, const Operand& b) {
    is_single() ? vdivsd(r, a, b) : vdivpd(r, a, b);
  }
  void multiply_add(const Register& sum, const Register& a, const Operand& b) {
    is_single() ? vfmadd231sd(sum, a, b) : vfmadd231pd(sum, a, b);
  }
  // By a product if it has the same bits.
  void divide_by_number(const Register& r, double c) {
    int exponent = 0;
    if (c == 1) return;
    if (std::frexp(c, &exponent) == 0.5 && std::abs(exponent) < 1000)
      multiply(r, r, constant(1 / c));
    else
      divide(r, r, constant(c));
  }
  void negate(const Register& r) {
    load(at(1), constant(-0.0));
    subtract(r, at(1), r);
  }

  // --- memory ---

  [[nodiscard]] int width() const { return lanes_ * parts_; }
  [[nodiscard]] Address coefficient(int series, int k) const {
    return ptr[rbx + static_cast<std::size_t>(series * stride_ + (k * width() + part_ * lanes_)) * 8];
  }
  [[nodiscard]] Address of_lanes(const Xbyak::Reg64& first, int i) const {
    return ptr[first + index((i * width() + part_ * lanes_) * 8)];
  }
  [[nodiscard]] Address scale() const { return of_lanes(r13, 0); }

  // A coefficient in a register.
  struct Held {
    int series = none, part = 0, k = 0, used = 0;
  };
  // The register that was used longest ago.
  [[nodiscard]] int oldest() const {
    const auto end = held_.begin() + registers_;
    return static_cast<int>(std::min_element(held_.begin() + first_register_, end,
                                             [](const Held& a, const Held& b) { return a.used < b.used; }) -
                            held_.begin());
  }
  // Coefficient k in a register, which other coefficients may take later.
  Register newest(int series) {
    for (int r = first_register_; r < registers_; ++r) {
      Held& held = held_[index(r)];
      if (held.series != series || held.part != part_ || held.k != k_) continue;
      held.used = ++now_;
      return at(r);
    }
    const int r = oldest();
    load(at(r), coefficient(series, k_));
    held_[index(r)] = {series, part_, k_, ++now_};
    return at(r);
  }
  void set(int series, int k, const Register& value) {
    store(coefficient(series, k), value);
    const int r = oldest();
    copy(at(r), value);
    held_[index(r)] = {series, part_, k, ++now_};
  }
  // The function may have changed all registers.
  template <class Function>
  void call_and_forget(Function* function) {
    call_function(function);
    held_.fill({});
  }

  // --- sums, in the order of tape::avx2_replay ---

  // sum = a_first b_last + a_(first + 1) b_(last - 1) + ..., n products. Uses registers 1 to 5.
  void add_products(const Register& sum, int a, int first, int b, int last, int n) {
    if (!is_single()) return add_lanes({{{{a, b}, {a, b}}}, 1, true, first, last}, sum.getIdx(), n);
    zero(sum);
    const int fours = n / 4;
    for (int i = 4 * fours; i < n; ++i) {
      load(at(4), coefficient(a, first + i));
      multiply_add(sum, at(4), coefficient(b, last - i));
    }
    if (fours > 0) {
      // Lanes are partial sums; every other four products are summed in a second register.
      zero(ymm3);
      for (int j = 0; j < fours; ++j) add_four(j, a, first + 4 * j, b, last - 4 * j);
      vaddpd(ymm2, ymm2, ymm3);
      vextractf128(xmm3, ymm2, 1);
      vaddpd(xmm2, xmm2, xmm3);
      vunpckhpd(xmm3, xmm2, xmm2);
      vaddsd(xmm2, xmm2, xmm3);
      add(sum, at(2), sum);
    }
  }

  // One or two sums as of add_products(); two have the first or the second factor in common, which is loaded
  // once.
  struct LaneSums {
    std::array<std::array<int, 2>, 2> factors;
    int count;
    bool first_in_common;
    int first, last;
  };
  // Registers of both sums.
  using Both = std::array<int, 2>;
  // The sums in @p sum and register 6. Uses registers 1 to 5, and 7 to 10 for two.
  void add_lanes(const LaneSums& s, int sum, int n) {
    const Both rest{sum, 6}, even{3, 7}, one{1, 8}, other{2, 9};
    const auto add_all = [&](const Both& r, const Both& a, const Both& b) {
      for (std::size_t i = 0; i < index(s.count); ++i) add(at(r[i]), at(a[i]), at(b[i]));
    };
    const int fours = n / 4;
    for (std::size_t i = 0; i < index(s.count); ++i) zero(at(rest[i]));
    for (int i = 4 * fours; i < n; ++i) add_terms(s, i, rest, false);
    if (fours == 0) return;
    partial_sums(s, 0, fours, even);
    partial_sums(s, 2, fours, other);
    add_all(even, even, other);
    partial_sums(s, 1, fours, one);
    partial_sums(s, 3, fours, other);
    add_all(other, one, other);
    add_all(other, even, other);
    add_all(rest, other, rest);
  }
  // Products j, j + 4, j + 8, ...
  void partial_sums(const LaneSums& s, int j, int fours, const Both& sums) {
    const Both odd{5, 10};
    add_terms(s, j, sums, true);
    for (std::size_t i = 0; i < index(s.count); ++i) zero(at(odd[i]));
    for (int i = 1; i < fours; ++i) add_terms(s, 4 * i + j, i % 2 == 1 ? odd : sums, false);
    for (std::size_t i = 0; i < index(s.count); ++i) add(at(sums[i]), at(sums[i]), at(odd[i]));
  }
  // Product i of the sums. @param starts is it the first one?
  void add_terms(const LaneSums& s, int i, const Both& sums, bool starts) {
    const auto factor = [&](std::size_t sum, bool first) {
      return first ? coefficient(s.factors[sum][0], s.first + i) : coefficient(s.factors[sum][1], s.last - i);
    };
    load(at(4), factor(0, s.first_in_common));
    for (std::size_t k = 0; k < index(s.count); ++k) {
      const Address own = factor(k, !s.first_in_common);
      starts ? multiply(at(sums[k]), at(4), own) : multiply_add(at(sums[k]), at(4), own);
    }
  }
  void add_four(int j, int a, int first, int b, int last) {
    // A load of more than one of the numbers that were just stored would wait for their way to the cache.
    if (j == 0 && gathers_) {
      vmovsd(xmm1, coefficient(b, last));
      vmovhpd(xmm1, xmm1, coefficient(b, last - 1));
      vpermilpd(xmm4, coefficient(b, last - 3), 1);
      vinsertf128(ymm1, ymm1, xmm4, 1);
    } else {
      vpermpd(ymm1, coefficient(b, last - 3), 0x1b);
    }
    const auto add_to_sum = [&](const Operand& ascending) {
      if (j == 0)
        vmulpd(ymm2, ymm1, ascending);
      else
        vfmadd231pd(j % 2 == 1 ? ymm3 : ymm2, ymm1, ascending);
    };
    if (gathers_ && first + 3 == k_ - 1) {
      vmovsd(xmm5, coefficient(a, first + 2));
      vmovhpd(xmm5, xmm5, coefficient(a, first + 3));
      vmovupd(xmm4, coefficient(a, first));
      vinsertf128(ymm4, ymm4, xmm5, 1);
      add_to_sum(ymm4);
    } else {
      add_to_sum(coefficient(a, first));
    }
  }

  // Pairs of products with a factor in common.
  void find_partners() {
    for (int j = 0; j < program_.instruction_count; ++j) {
      const Instruction& one = program_.instructions[j];
      if (one.operation != Operation::product || partners_[index(j)] != none) continue;
      for (int m = j + 1; m < program_.instruction_count; ++m) {
        const Instruction& other = program_.instructions[m];
        if (other.operation != Operation::product || partners_[index(m)] != none ||
            (one.a != other.a && one.b != other.b))
          continue;
        partners_[index(j)] = m;
        partners_[index(m)] = j;
        break;
      }
    }
  }
  // middle() of both factors to register 0. That of the second of a pair is computed with the first, and
  // waits in the place of the coefficient.
  void middle_of_product(int j) {
    const Instruction& i = program_.instructions[j];
    const int partner = partners_[index(j)];
    if (partner == none) return middle(at(0), i.a, i.b);
    if (partner < j) return load(at(0), coefficient(i.r, k_));
    const Instruction& other = program_.instructions[partner];
    add_lanes({{{{i.a, i.b}, {other.a, other.b}}}, 2, i.a == other.a, 1, k_ - 1}, 0, k_ - 1);
    store(coefficient(other.r, k_), at(6));
  }

  // The following functions have the names and rules of tape::Replayer.
  void middle(const Register& r, int a, int b) { add_products(r, a, 1, b, k_ - 1, k_ - 1); }
  void middle_square(const Register& r, int a) {
    add_products(r, a, 1, a, k_ - 1, (k_ - 1) / 2);
    add(r, r, r);
    if (k_ % 2 == 1) return;
    load(at(1), coefficient(a, k_ / 2));
    multiply(at(1), at(1), at(1));
    add(r, r, at(1));
  }
  void square(const Register& r, int a) {
    middle_square(r, a);
    multiply(at(1), newest(a), coefficient(a, 0));
    add(at(1), at(1), at(1));
    add(r, r, at(1));
  }
  void slope_times(const Register& r, int d, int b, bool line) {
    if (line) {
      load(r, coefficient(d, 1));
      multiply(r, r, coefficient(b, k_ - 1));
      return;
    }
    middle(r, d, b);
    multiply(at(1), newest(d), coefficient(b, 0));
    add(r, r, at(1));
  }
  // r = (r - quotient_0 b_k) / b_0
  void finish_quotient(const Register& r, int quotient, int b) {
    multiply(at(1), newest(b), coefficient(quotient, 0));
    subtract(r, r, at(1));
    divide(r, r, coefficient(b, 0));
  }

  // --- passes ---

  void first_pass() {
    k_ = 0;
    for (int j = 0; j < program_.instruction_count; ++j) {
      if (is_function(program_.instructions[j].operation)) {
        part_ = 0;
        call_first_coefficient(j);
      } else {
        for (part_ = 0; part_ < parts_; ++part_) first_coefficient(j);
      }
    }
    for (int i = 0; i < program_.size; ++i) {
      const tape::Output& output = program_.outputs[i];
      for (part_ = 0; part_ < parts_; ++part_) {
        load(at(0), output.series >= 0 ? coefficient(output.series, 0)
                                       : number(output.constant, tape::output_of(program_, i)));
        multiply(at(0), at(0), scale());
        set(i + 1, 1, at(0));
      }
    }
  }
  static bool is_function(Operation operation) { return operation > Operation::slope; }
  void first_coefficient(int j) {
    const Instruction& i = program_.instructions[j];
    const Register r = at(0);
    switch (i.operation) {
      case Operation::linear: linear(j); break;
      case Operation::slope: zero(r); break;
      case Operation::quotient: divide(r, newest(i.a), newest(i.b)); break;
      case Operation::reciprocal:
        load(r, number(i.factor, tape::factor_of(j)));
        divide(r, r, newest(i.a));
        break;
      case Operation::root:
        if (is_single())
          vsqrtsd(r, r, newest(i.a));
        else
          vsqrtpd(r, newest(i.a));
        break;
      default: multiply(r, newest(i.a), newest(i.b));
    }
    set(i.r, 0, r);
  }
  // In all lanes.
  void call_first_coefficient(int j) {
    const Instruction& i = program_.instructions[j];
    mov(edi, static_cast<std::uint32_t>(i.operation));
    lea(rsi, number(i.factor, tape::factor_of(j)));
    lea(rdx, coefficient(i.a, 0));
    lea(rcx, coefficient(i.b, 0));
    lea(r8, coefficient(i.r, 0));
    lea(r9, coefficient(i.r + 1, 0));
    if (lanes_ > 1) vzeroupper();
    call_and_forget(lanes_ == 1   ? &function_values<1>
                    : lanes_ == 4 ? &function_values<8>
                                  : &function_values<16>);
  }
  template <int count>
  static void function_values(Operation operation, const double* factors, const double* a, const double* b,
                              double* results, double* companions) {
    Instruction i{};
    i.operation = operation;
    for (int lane = 0; lane < count; ++lane) {
      const auto [value, second] = tape::first_coefficient(i, factors[lane], a[lane], b[lane]);
      results[lane] = value;
      if (tape::has_companion(operation)) companions[lane] = second;
    }
  }

  void pass() {
    for (part_ = 0; part_ < parts_; ++part_) {
      for (int j = 0; j < program_.instruction_count; ++j) execute(j);
      load(at(6), scale());
      if (k_ >= tape::first_reciprocal) multiply(at(6), at(6), constant(1 / static_cast<double>(k_ + 1)));
      for (int i = 0; i < program_.size; ++i) next_coefficient(i, at(6));
    }
  }
  void next_coefficient(int i, const Register& unit) {
    const int series = program_.outputs[i].series;
    zero(at(0));
    multiply(at(0), series < 0 ? at(0) : newest(series), unit);
    if (k_ < tape::first_reciprocal) divide_by_number(at(0), k_ + 1);
    set(i + 1, k_ + 1, at(0));
  }

  // A constant of the tape, or one per lane.
  [[nodiscard]] Address number(double own, int i) { return is_single() ? constant(own) : of_lanes(r12, i); }
  void linear(int j) {
    const Instruction& i = program_.instructions[j];
    for (int m = i.first; m < i.first + i.count; ++m) {
      const tape::Term& term = program_.terms[m];
      const Register x = newest(term.series);
      const bool first = m == i.first;
      if (first && term.factor == 1) {
        copy(at(0), x);
      } else if (term.factor == 1) {
        add(at(0), at(0), x);
      } else if (!first && term.factor == -1) {
        subtract(at(0), at(0), x);
      } else {
        multiply(at(first ? 0 : 1), x, number(term.factor, tape::term_of(program_, m)));
        if (!first) add(at(0), at(0), at(1));
      }
    }
    if (k_ == 0) add(at(0), at(0), number(i.shift, tape::shift_of(j)));
    if (i.factor != 1) multiply(at(0), at(0), number(i.factor, tape::factor_of(j)));
    if (i.divisor != 1) divide(at(0), at(0), number(i.divisor, tape::divisor_of(j)));
  }

  void execute(int j) {
    const Instruction& i = program_.instructions[j];
    const Register r = at(0);
    switch (i.operation) {
      case Operation::linear: linear(j); break;
      case Operation::product:
        middle_of_product(j);
        multiply(at(1), newest(i.b), coefficient(i.a, 0));
        multiply(at(2), newest(i.a), coefficient(i.b, 0));
        add(at(1), at(1), at(2));
        add(r, r, at(1));
        break;
      case Operation::product_by_line:
        multiply(r, newest(i.b), coefficient(i.a, 0));
        load(at(1), coefficient(i.a, 1));
        multiply(at(1), at(1), coefficient(i.b, k_ - 1));
        add(r, r, at(1));
        break;
      case Operation::square: square(r, i.a); break;
      case Operation::quotient:
        middle(r, i.b, i.r);
        subtract(r, newest(i.a), r);
        finish_quotient(r, i.r, i.b);
        break;
      case Operation::reciprocal:
        middle(r, i.b, i.r);
        negate(r);
        finish_quotient(r, i.r, i.b);
        break;
      case Operation::root:
        middle_square(r, i.r);
        subtract(r, newest(i.a), r);
        load(at(1), coefficient(i.r, 0));
        add(at(1), at(1), at(1));
        divide(r, r, at(1));
        break;
      case Operation::slope: multiply(r, newest(i.a), constant(k_)); break;
      default: execute_function(j); return;
    }
    set(i.r, k_, r);
  }

  // Functions with a differential equation.
  void execute_function(int j) {
    const Instruction& i = program_.instructions[j];
    const int g = i.r + 1, d = i.extra;
    const Register r = at(0), other = at(6);
    switch (i.operation) {
      case Operation::exponential:
        slope_times(r, d, i.r, i.line);
        divide_by_number(r, k_);
        break;
      case Operation::circular:
      case Operation::hyperbolic:
        slope_times(other, d, g, i.line);
        divide_by_number(other, k_);
        slope_times(r, d, i.r, i.line);
        divide_by_number(r, k_);
        if (i.operation == Operation::circular) negate(r);
        set(g, k_, r);
        set(i.r, k_, other);
        return;
      case Operation::tangent:
      case Operation::hyperbolic_tangent:
        slope_times(r, d, g, i.line);
        divide_by_number(r, k_);
        set(i.r, k_, r);
        square(r, i.r);
        if (i.operation == Operation::hyperbolic_tangent) negate(r);
        set(g, k_, r);
        return;
      case Operation::logarithm:
        middle(r, g, i.a);
        multiply(at(1), newest(i.a), constant(k_));
        subtract(r, at(1), r);
        finish_logarithm(i);
        return;
      case Operation::power:
        slope_times(other, d, i.r, i.line);
        multiply(other, other, number(i.factor, tape::factor_of(j)));
        middle(r, g, i.a);
        subtract(r, other, r);
        finish_logarithm(i);
        return;
      default:  // the integral of its slope
        copy(r, newest(d));
        divide_by_number(r, k_);
    }
    set(i.r, k_, r);
  }
  // The slope from a_0 times it, and its integral.
  void finish_logarithm(const Instruction& i) {
    divide(at(0), at(0), coefficient(i.a, 0));
    set(i.r + 1, k_, at(0));
    divide_by_number(at(0), k_);
    set(i.r, k_, at(0));
  }

  const tape::Program& program_;
  std::int64_t stride_;
  int order_, lanes_, parts_, registers_, first_register_;
  bool gathers_;
  std::vector<int> partners_;  // the other product of a pair
  std::array<Held, 32> held_;
  int k_ = 0, part_ = 0, now_ = 0;
};

namespace {

// Code of more products exceeds the caches, and takes milliseconds to make.
constexpr int most_single = 100'000, most_in_lanes = 8'000;

// Sums of products in a pass, times the square of the order.
int products(const tape::Program& program, int order) { return sums(program) * order * order; }

std::shared_ptr<Coefficients> made(const tape::Program& program, std::int64_t stride, int order, int lanes,
                                   int parts) {
  try {
    return SeriesAssembler(program, stride, order, lanes, parts).make();
  } catch (const Xbyak::Error&) {
    return nullptr;  // no memory
  }
}

}  // namespace

std::shared_ptr<Coefficients> coefficients(const tape::Program& program, std::int64_t stride, int order) {
  if (!available(InstructionSet::avx2) || products(program, order) > most_single) return nullptr;
  return made(program, stride, order, 1, 1);
}

std::shared_ptr<Coefficients> lane_coefficients(const tape::Program& program, std::int64_t stride, int order,
                                                InstructionSet set) {
  if (set == InstructionSet::baseline || !available(set) || products(program, order) > most_in_lanes)
    return nullptr;
  return made(program, stride, order, set == InstructionSet::avx2 ? 4 : 8, 2);
}

}  // namespace nlmech::machine_code
