/// @file
/// Assembler for the functions of machine_code.hpp. Internal to them.
#pragma once

#include <xbyak/xbyak.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

namespace nlmech::machine_code {

/// Memory of the heap in which code is written; it is not executable.
class Heap : public Xbyak::Allocator {
 public:
  /// The protection of this memory is not changed.
  [[nodiscard]] bool useProtect() const override { return false; }
};

/// Instructions with a table of constants behind them. The code does not depend on its address.
class Assembler : private Heap, public Xbyak::CodeGenerator {
 protected:
  /// @param copies of each constant, as many as a register has lanes
  explicit Assembler(int copies = 1)
      : CodeGenerator(Xbyak::DEFAULT_MAX_CODE_SIZE, Xbyak::AutoGrow, static_cast<Heap*>(this)),
        copies_(copies) {}

  /// The constant @p c as an operand.
  [[nodiscard]] Xbyak::Address constant(double c) {
    return ptr[rip + table_[std::bit_cast<std::uint64_t>(c)]];
  }

  /// Calls a function of the C calling convention, which may change all vector registers.
  template <class Function>
  void call_function(Function* function) {
    mov(rax, std::bit_cast<std::uint64_t>(function));
    call(rax);
  }

  /// Returns from the function. @return the function in executable memory; null if the system refuses it
  template <class Function>
  [[nodiscard]] std::shared_ptr<Function> finish() {
    ret();
    align(64);
    for (auto& [bits, label] : table_) {
      L(label);
      for (int i = 0; i < copies_; ++i) dq(bits);
    }
    ready();
    const std::shared_ptr<void> memory = executable(getCode(), getSize());
    return memory == nullptr ? nullptr
                             : std::shared_ptr<Function>(memory, std::bit_cast<Function*>(memory.get()));
  }

 private:
  /// A copy of @p size bytes in executable memory; null if the system refuses it.
  [[nodiscard]] static std::shared_ptr<void> executable(const std::uint8_t* code, std::size_t size);

  int copies_;
  std::map<std::uint64_t, Xbyak::Label> table_;
};

}  // namespace nlmech::machine_code
