#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "nlmech/program/machine_code/assembler.hpp"
#include "nlmech/program/machine_code/machine_code.hpp"

namespace nlmech::machine_code {

std::shared_ptr<void> Assembler::executable(const std::uint8_t* code, std::size_t size) {
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  std::memcpy(memory, code, size);
  std::shared_ptr<void> owner(memory, [size](void* own) { munmap(own, size); });
  return mprotect(memory, size, PROT_READ | PROT_EXEC) == 0 ? owner : nullptr;
}

using program::Function;
using program::Operation;

/// Makes the code of a Program: results stay in registers, of which the one that was used longest ago is
/// saved in the frame of the stack when there are too few.
class ValueAssembler : private Assembler {
 public:
  ValueAssembler(const program::Program& program, std::size_t first, std::size_t last)
      : program_(program),
        first_(first),
        last_(last),
        places_(program.places_),
        uses_(program.instructions_.size()) {}

  [[nodiscard]] static std::size_t places(const program::Program& program) { return program.places_; }
  [[nodiscard]] std::shared_ptr<Values> make() {
    find_uses();
    if (calls_) {
      push(rbx);
      push(r12);
      mov(rbx, rdi);
      mov(r12, rsi);
    }
    const bool saves = calls_ || places_.size() > registers;
    const auto frame = static_cast<std::uint32_t>((places_.size() + 2) / 2 * 16 - 8);  // aligns calls
    if (saves) sub(rsp, frame);
    for (std::size_t i = 0; i < program_.size_; ++i) places_[i + 1].saved = true;
    hold(0, 0);
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      if (uses_[i].needed) emit(program_.instructions_[i], uses_[i]);
    }
    for (std::size_t i = first_; i < last_; ++i) put_output(i);
    if (saves) add(rsp, frame);
    if (calls_) {
      pop(r12);
      pop(rbx);
    }
    return finish<Values>();
  }

 private:
  using Instruction = program::Program::Instruction;
  static constexpr int registers = 15, scratch = 15, none = -1;

  /// Where the value of a place is.
  struct Place {
    int in = none;       ///< register
    bool saved = false;  ///< is it in memory?
    int used = 0;        ///< time of the last use
  };
  /// Is the result of an instruction needed, and its operand for the last time?
  struct Uses {
    bool needed = false, last_a = false, last_b = false;
  };

  static bool has_b(const Instruction& i) { return program::has_two_operands(i.operation); }
  [[nodiscard]] bool is_input(std::uint32_t place) const { return place >= 1 && place <= program_.size_; }

  void find_uses() {
    std::vector<bool> live(places_.size());
    for (std::size_t i = first_; i < last_; ++i) {
      if (!program_.outputs_[i].number) live[program_.outputs_[i].place] = true;
    }
    for (std::size_t i = uses_.size(); i-- > 0;) {
      const Instruction& step = program_.instructions_[i];
      if (!live[step.r]) continue;
      live[step.r] = false;
      uses_[i].needed = true;
      if (step.operation == Operation::number) continue;
      calls_ = calls_ || !is_arithmetic(step);
      uses_[i].last_a = !live[step.a];
      uses_[i].last_b = has_b(step) && !live[step.b];
      live[step.a] = true;
      if (has_b(step)) live[step.b] = true;
      if (step.operation == Operation::choice) live[step.decides] = true;
    }
  }

  [[nodiscard]] const Xbyak::Reg64& state() const { return calls_ ? rbx : rdi; }
  [[nodiscard]] Xbyak::Address home(std::uint32_t place) const {
    return is_input(place) ? ptr[state() + std::size_t{8} * (place - 1)] : ptr[rsp + std::size_t{8} * place];
  }
  void hold(std::uint32_t place, int in) {
    places_[place].in = in;
    places_[place].used = ++now_;
    held_[static_cast<std::size_t>(in)] = static_cast<int>(place);
  }
  void save(int in) {
    const auto place = static_cast<std::uint32_t>(held_[static_cast<std::size_t>(in)]);
    if (!places_[place].saved) vmovsd(home(place), Xbyak::Xmm(in));
    places_[place].saved = true;
    places_[place].in = held_[static_cast<std::size_t>(in)] = none;
  }
  // Its value is not needed any more.
  void forget(std::uint32_t place) {
    Place& old = places_[place];
    if (old.in != none) held_[static_cast<std::size_t>(old.in)] = none;
    old.in = none;
    if (!is_input(place)) old.saved = false;
  }
  // A register that holds nothing, except the register @p not_this.
  int free_register(int not_this = none) {
    int oldest = none;
    for (int r = 0; r < registers; ++r) {
      if (held_[static_cast<std::size_t>(r)] == none) return r;
      if (r != not_this && (oldest == none || used(r) < used(oldest))) oldest = r;
    }
    save(oldest);
    return oldest;
  }
  [[nodiscard]] int used(int in) const {
    return places_[static_cast<std::size_t>(held_[static_cast<std::size_t>(in)])].used;
  }
  Xbyak::Xmm load(std::uint32_t place, int not_this = none) {
    if (places_[place].in == none) {
      const int r = free_register(not_this);
      vmovsd(Xbyak::Xmm(r), home(place));
      hold(place, r);
    }
    places_[place].used = ++now_;
    return Xbyak::Xmm(places_[place].in);
  }
  Xbyak::Xmm result(const Instruction& i) {
    forget(i.r);
    hold(i.r, free_register());
    return Xbyak::Xmm(places_[i.r].in);
  }

  void emit(const Instruction& i, const Uses& uses) {
    if (i.operation == Operation::number) {
      vmovsd(result(i), constant(i.c));
      return;
    }
    if (!is_arithmetic(i)) {
      call_of(i);
      return;
    }
    const Xbyak::Xmm a = load(i.a), b = has_b(i) ? load(i.b, a.getIdx()) : a, other(scratch);
    if (uses.last_a) forget(i.a);
    if (uses.last_b) forget(i.b);
    if (i.operation == Operation::combined) vmulsd(other, b, constant(i.c));
    if (i.operation == Operation::reciprocal) vmovsd(other, constant(i.c));
    // An operand that is needed later keeps its register: load() made it the newest.
    const Xbyak::Xmm r = result(i);
    switch (i.operation) {
      case Operation::sum: vaddsd(r, a, b); return;
      case Operation::difference: vsubsd(r, a, b); return;
      case Operation::shifted: vaddsd(r, a, constant(i.c)); return;
      case Operation::scaled: vmulsd(r, a, constant(i.c)); return;
      case Operation::divided: vdivsd(r, a, constant(i.c)); return;
      case Operation::product: vmulsd(r, a, b); return;
      case Operation::quotient: vdivsd(r, a, b); return;
      case Operation::combined: vaddsd(r, a, other); return;
      case Operation::reciprocal: vdivsd(r, other, a); return;
      default: vsqrtsd(r, a, a);
    }
  }
  static bool is_arithmetic(const Instruction& i) {
    switch (i.operation) {
      case Operation::sum:
      case Operation::difference:
      case Operation::shifted:
      case Operation::scaled:
      case Operation::divided:
      case Operation::product:
      case Operation::quotient:
      case Operation::combined:
      case Operation::reciprocal: return true;
      default: return i.operation == Operation::function && i.function == Function::sqrt;
    }
  }

  // A call of the function that the interpreter calls.
  void call_of(const Instruction& i) {
    for (int r = 0; r < registers; ++r) {
      if (held_[static_cast<std::size_t>(r)] != none) save(r);
    }
    vmovsd(xmm0, home(i.a));
    switch (i.operation) {
      case Operation::power:
        vmovsd(xmm1, constant(i.c));
        call_function<double(double, double)>(std::pow);
        break;
      case Operation::any_power:
        vmovsd(xmm1, home(i.b));
        call_function<double(double, double)>(std::pow);
        break;
      case Operation::atan2:
        vmovsd(xmm1, home(i.b));
        call_function<double(double, double)>(std::atan2);
        break;
      case Operation::choice:
        vmovsd(xmm1, home(i.b));
        vmovsd(xmm2, home(i.decides));
        call_function(&chosen);
        break;
      case Operation::floor: call_function<double(double)>(std::floor); break;
      case Operation::table:
        mov(rdi, std::bit_cast<std::uint64_t>(program_.tables_[static_cast<std::size_t>(i.c)].get()));
        call_function(&of_table);
        break;
      default: call_function(function(i.function));
    }
    forget(i.r);
    hold(i.r, 0);
  }
  static double chosen(double a, double b, double decides) { return program::Program::chosen(decides, a, b); }
  static double of_table(const program::Table* table, double t) { return table->at(t); }
  static double (*function(Function function))(double) {
    switch (function) {
      case Function::exp: return std::exp;
      case Function::log: return std::log;
      case Function::sin: return std::sin;
      case Function::cos: return std::cos;
      case Function::tan: return std::tan;
      case Function::asin: return std::asin;
      case Function::acos: return std::acos;
      case Function::atan: return std::atan;
      case Function::sinh: return std::sinh;
      case Function::cosh: return std::cosh;
      case Function::tanh: return std::tanh;
      case Function::asinh: return std::asinh;
      default: return std::erf;
    }
  }

  void put_output(std::size_t i) {
    const program::Program::Output& output = program_.outputs_[i];
    Xbyak::Xmm value(scratch);
    if (output.number)
      vmovsd(value, constant(output.c));
    else
      value = load(output.place);
    vmovsd(ptr[(calls_ ? r12 : rsi) + 8 * (i - first_)], value);
  }

  const program::Program& program_;
  std::size_t first_, last_;
  std::vector<Place> places_;
  std::vector<Uses> uses_;
  std::array<int, registers> held_ = filled();
  int now_ = 0;
  bool calls_ = false;

  static std::array<int, registers> filled() {
    std::array<int, registers> all{};
    all.fill(none);
    return all;
  }
};

std::shared_ptr<Values> values(const program::Program& program, std::size_t first, std::size_t last) {
  // The frame is one step of the stack.
  constexpr std::size_t most_places = 4096;
  if (!available(InstructionSet::avx2) || ValueAssembler::places(program) > most_places) return nullptr;
  try {
    return ValueAssembler(program, first, last).make();
  } catch (const Xbyak::Error&) {
    return nullptr;  // no memory
  }
}

}  // namespace nlmech::machine_code
