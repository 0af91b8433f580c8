// No method allocates memory within a step. This is a program of its own, because it replaces `operator new`,
// and the linker redirects malloc() and realloc(), which Eigen calls, to the counters here (CMakeLists.txt).
// The instances are those of the library.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"

namespace {
// Number of allocations since the program started. Clang assumes that malloc() changes no variable that is
// not atomic.
std::atomic<std::int64_t> requests = 0;
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier): the linker gives these names.
extern "C" {
void* __real_malloc(std::size_t bytes);
void* __real_realloc(void* block, std::size_t bytes);
void* __wrap_malloc(std::size_t bytes) {
  ++requests;
  return __real_malloc(bytes);
}
void* __wrap_realloc(void* block, std::size_t bytes) {
  ++requests;
  return __real_realloc(block, bytes);
}
}
// NOLINTEND(bugprone-reserved-identifier)

void* operator new(std::size_t bytes) {
  ++requests;
  if (void* block = __real_malloc(bytes > 0 ? bytes : 1)) return block;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  ++requests;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* block = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit)) return block;
  throw std::bad_alloc();
}
// Not inlined: GCC would otherwise warn about mismatched new and delete.
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  std::free(block);
}

namespace nlmech::ivp::no_allocation_test {
namespace {

// Counts from the end of the first of ten steps to the end of the ninth.
void expect_no_allocation(const NamedIntegrator& integrate, std::string_view name,
                          const chapters::PlainChain& chain = {}) {
  std::int64_t before = 0, after = 0;
  const Observer count = [&](const Step& step) {
    (step.index <= 1 ? before : after) = requests;
    return step.index < 10;
  };
  const auto s = integrate(System(chain), State::Zero(6), 0, 100, count, {});
  EXPECT_EQ(s.status.outcome(), Outcome::interrupted) << s.status.text();
  EXPECT_EQ(after - before, 0) << name;
}

TEST(NoAllocation, IsCounted) {
  const std::int64_t before = requests;
  const Eigen::VectorXd algebra(7);
  const std::string text(100, 'x');
  // Clang removes an allocation whose result is not used.
  for (const void* volatile block :
       {static_cast<const void*>(algebra.data()), static_cast<const void*>(text.data())})
    EXPECT_NE(block, nullptr);
  EXPECT_EQ(requests - before, 2);
}

// The workspace is allocated by code of the library.
TEST(NoAllocation, IsCountedInTheLibrary) {
  const System system(chapters::PlainChain{});
  const State rest = State::Zero(6);
  const std::int64_t before = requests;
  EXPECT_TRUE(integrate(system, rest, 0, 1, Rk4{.step = 0.5}).status.ok());
  EXPECT_GT(requests, before);
}

TEST(NoAllocation, InStepsOfEveryMethod) {
  for (const MethodInfo& row : named_methods()) {
    const chapters::PlainChain chain = {.c2 = row.name == Rkn1210::name ? 0 : chapters::PlainChain{}.c2};
    const double step = row.has(points_setting) ? 0.125 : 0.5;
    Settings equal{.step = step};
    if (row.has(shape_setting)) equal.shape = 0.4;
    if (row.steps != Steps::adaptive) expect_no_allocation(row.with(equal), row.name, chain);
    if (row.steps != Steps::fixed) expect_no_allocation(row.with({}), row.name, chain);
  }
  const Mtl mtl{.step = 0.125, .points = 4, .linear = MtlLinear::jacobian, .error_tolerance = 10};
  expect_no_allocation(named::with_options(mtl), "mtl, by the Jacobian");
}

}  // namespace
}  // namespace nlmech::ivp::no_allocation_test
