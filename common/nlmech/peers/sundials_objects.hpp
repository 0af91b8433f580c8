/// @file
/// Owners of SUNDIALS objects. Only for sources that are compiled with SUNDIALS.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <new>

namespace nlmech::peers {

/// Owner of a SUNDIALS object that is released by value.
template <class Handle, auto release>
class SundialsObject {
 public:
  /// Takes over @p handle. @throws std::bad_alloc if it is null: SUNDIALS had no memory
  explicit SundialsObject(Handle handle) : handle_(handle) {
    if (!handle_) throw std::bad_alloc();
  }
  ~SundialsObject() { release(handle_); }
  SundialsObject(const SundialsObject&) = delete;
  SundialsObject& operator=(const SundialsObject&) = delete;
  /// For calls of the library.
  [[nodiscard]] Handle get() const { return handle_; }

 private:
  Handle handle_;
};

/// The context of all objects of one computation.
class SundialsContext {
 public:
  SundialsContext() {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::bad_alloc();
  }
  ~SundialsContext() { SUNContext_Free(&context_); }
  SundialsContext(const SundialsContext&) = delete;
  SundialsContext& operator=(const SundialsContext&) = delete;
  /// For calls of the library.
  [[nodiscard]] SUNContext get() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

/// Vector.
using SundialsVector = SundialsObject<N_Vector, &N_VDestroy>;
/// Dense matrix.
using SundialsMatrix = SundialsObject<SUNMatrix, &SUNMatDestroy>;
/// Dense factorisation.
using SundialsLinearSolver = SundialsObject<SUNLinearSolver, &SUNLinSolFree>;

/// Error handler that discards the errors and warnings of SUNDIALS, which prints them by default.
inline void silence_sundials(int /*code*/, const char* /*module*/, const char* /*function*/,
                             char* /*message*/, void* /*data*/) noexcept {}

}  // namespace nlmech::peers
