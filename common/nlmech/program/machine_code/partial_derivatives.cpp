#include <array>
#include <cstdint>

#include "nlmech/program/machine_code/assembler.hpp"
#include "nlmech/program/machine_code/machine_code.hpp"

namespace nlmech::machine_code {

using program::Operation;

/// Makes the code of a Program for dual numbers: operations from memory to memory, for the value and for two
/// registers of partial derivatives.
class DualAssembler : private Assembler {
 public:
  explicit DualAssembler(const program::Program& program) : Assembler(4), program_(program) {}

  [[nodiscard]] std::shared_ptr<PartialDerivatives> make() {
    push(rbx);
    mov(rbx, rdi);
    for (const Instruction& i : program_.instructions_) emit(i);
    vzeroupper();
    pop(rbx);
    return finish<PartialDerivatives>();
  }

 private:
  using Instruction = program::Program::Instruction;
  static_assert(sizeof(Numbers) == 9 * sizeof(double));

  [[nodiscard]] Xbyak::Address value(std::uint32_t place) const { return ptr[rbx + std::size_t{72} * place]; }
  [[nodiscard]] Xbyak::Address partial(std::uint32_t place, int part) const {
    return ptr[rbx + (std::size_t{72} * place + 8 + std::size_t{32} * static_cast<std::size_t>(part))];
  }

  void emit(const Instruction& i) {
    switch (i.operation) {
      case Operation::sum:
      case Operation::difference:
      case Operation::scaled:
      case Operation::combined: linear(i); return;
      case Operation::product: product(i); return;
      case Operation::quotient: quotient(i); return;
      default: call_of(i);
    }
  }

  // The same operation for the value and the partial derivatives.
  void linear(const Instruction& i) {
    vmovsd(xmm0, value(i.a));
    vmovupd(ymm1, partial(i.a, 0));
    vmovupd(ymm2, partial(i.a, 1));
    switch (i.operation) {
      case Operation::sum:
        vaddsd(xmm0, xmm0, value(i.b));
        vaddpd(ymm1, ymm1, partial(i.b, 0));
        vaddpd(ymm2, ymm2, partial(i.b, 1));
        break;
      case Operation::difference:
        vsubsd(xmm0, xmm0, value(i.b));
        vsubpd(ymm1, ymm1, partial(i.b, 0));
        vsubpd(ymm2, ymm2, partial(i.b, 1));
        break;
      case Operation::scaled:
        vmovapd(ymm3, constant(i.c));
        vmulsd(xmm0, xmm0, xmm3);
        vmulpd(ymm1, ymm1, ymm3);
        vmulpd(ymm2, ymm2, ymm3);
        break;
      default:  // combined
        vmovapd(ymm3, constant(i.c));
        vmulsd(xmm4, xmm3, value(i.b));
        vaddsd(xmm0, xmm0, xmm4);
        vmulpd(ymm4, ymm3, partial(i.b, 0));
        vaddpd(ymm1, ymm1, ymm4);
        vmulpd(ymm4, ymm3, partial(i.b, 1));
        vaddpd(ymm2, ymm2, ymm4);
    }
    store(i);
  }
  // a b' + b a'
  void product(const Instruction& i) {
    vbroadcastsd(ymm3, value(i.a));
    vbroadcastsd(ymm4, value(i.b));
    vmulsd(xmm0, xmm3, xmm4);
    for (int part = 0; part < 2; ++part) {
      const Xbyak::Ymm sum(1 + part);
      vmulpd(sum, ymm3, partial(i.b, part));
      vmulpd(ymm5, ymm4, partial(i.a, part));
      vaddpd(sum, sum, ymm5);
    }
    store(i);
  }
  // (a' - (a/b) b')/b
  void quotient(const Instruction& i) {
    vmovsd(xmm0, value(i.a));
    vdivsd(xmm0, xmm0, value(i.b));
    vbroadcastsd(ymm3, xmm0);
    vbroadcastsd(ymm4, value(i.b));
    for (int part = 0; part < 2; ++part) {
      const Xbyak::Ymm rest(1 + part);
      vmulpd(ymm5, ymm3, partial(i.b, part));
      vmovupd(rest, partial(i.a, part));
      vsubpd(rest, rest, ymm5);
      vdivpd(rest, rest, ymm4);
    }
    store(i);
  }
  void store(const Instruction& i) {
    vmovsd(value(i.r), xmm0);
    vmovupd(partial(i.r, 0), ymm1);
    vmovupd(partial(i.r, 1), ymm2);
  }

  // The interpreter's operation.
  void call_of(const Instruction& i) {
    vzeroupper();
    mov(rdi, std::bit_cast<std::uint64_t>(&program_));
    mov(rsi, std::bit_cast<std::uint64_t>(&i));
    mov(rdx, rbx);
    call_function(&carry_out);
  }
  static void carry_out(const program::Program* program, const Instruction* i, Numbers* places) {
    program->carry_out(*i, places);
  }

  const program::Program& program_;
};

std::shared_ptr<PartialDerivatives> partial_derivatives(const program::Program& program) {
  if (!available(InstructionSet::avx2)) return nullptr;
  try {
    return DualAssembler(program).make();
  } catch (const Xbyak::Error&) {
    return nullptr;  // no memory
  }
}

}  // namespace nlmech::machine_code
