/// Machine code of programs and tapes against the interpreters: the same bits, also of numbers that are not
/// finite, and the interpreters where there is no memory for code.
#include "nlmech/program/machine_code/machine_code.hpp"

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "nlmech/program/problem.hpp"
#include "nlmech/program/recorded.hpp"
#include "nlmech/program/tape_expansion.hpp"
#include "nlmech/program/tape_lanes.hpp"

namespace nlmech::tests::machine_code_test {
namespace {

using program::Equations;
using program::Problem;
using program::Program;
using program::SourceText;

constexpr int repays_after = program::RepeatedProgram::repays_after;

/// Every operation and function, with values that are needed more than once.
constexpr const char* everything =
    "x' = (a + b + c)*(a - b)/(c + 2) - a/3 + 2/b - x^3 y + 0.1 sin(t)\n"
    "y' = sqrt(b^2 + 1) + exp(-c) + log(1 + a^2) + tan(x) + asin(x/9) - acos(y/9) + atan(z) + atan2(x, y)\n"
    "z' = sinh(a/4) - cosh(b/4) + tanh(c) + asinh(x) + erf(y) + (1 + x^2)^0.3 + (2 + a^2)^(b/5) + t a c\n"
    "a = sin(x - y); b = cos(x - y) + x z; c = x + y - 2 z";
/// Branches, and jumps at known times.
constexpr const char* branches =
    "x' = max(x, y) - abs(z) + floor(t) + if(x < z, y, 2)\ny' = sign(x) + step(t - 1) - min(y, 0.5)\nz' = "
    "mod(t, 0.7) - z";
/// More values than registers: all are needed at the end.
std::string crowded() {
  std::string sum, product;
  for (int i = 0; i < 40; ++i) {
    const std::string part = "p" + std::to_string(i);
    sum += (i > 0 ? " + " : "") + part;
    product += (i > 0 ? "*" : "") + part;
  }
  std::string text = "x' = " + sum + "; y' = " + product + "; z' = sin(x) + " + sum + "/(" + product + ")";
  for (int i = 0; i < 40; ++i)
    text += "; p" + std::to_string(i) + " = (x + " + std::to_string(i) + ")*(y - z/" + std::to_string(i + 3) +
            ")";
  return text;
}

Equations equations(const std::string& text) { return Equations(SourceText("E", text)); }

/// The same bits, but that all NaN are alike.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Random states; every fourth number is special.
class States {
 public:
  std::vector<double> operator()(std::size_t size) {
    std::vector<double> all(size);
    for (double& x : all) x = engine_() % 4 == 0 ? special_[engine_() % special_.size()] : uniform_(engine_);
    return all;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> special_ = {
      0,     -0.0, 1,        -1,        std::numeric_limits<double>::denorm_min(), 1e-300,
      1e300, -1e9, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_{-3, 3};
};

class MachineCode : public testing::Test {
 protected:
  void SetUp() override {
    if (!available(InstructionSet::avx2)) GTEST_SKIP() << "machine code needs AVX2";
  }
};

TEST_F(MachineCode, HasTheValuesOfPrograms) {
  for (const std::string& text : {std::string(everything), std::string(branches), crowded()}) {
    const Equations all = equations(text);
    const Program program(all.graph(), all.slopes());
    const std::size_t last = program.outputs();
    for (std::size_t first = 0; first < 2; ++first) {
      const auto code = machine_code::values(program, first, last);
      ASSERT_TRUE(code != nullptr);
      States states;
      for (int trial = 0; trial < 2000; ++trial) {
        const std::vector<double> x = states(4);
        std::vector<double> values(last), expected(last);
        program.run(x[3], x, first, last,
                    [&](int i, double v) { expected[static_cast<std::size_t>(i)] = v; });
        (*code)(x[3], x.data(), values.data());
        for (std::size_t i = 0; i < last; ++i)
          ASSERT_TRUE(same(values[i], expected[i])) << text << "\n" << values[i] << ", " << expected[i];
      }
    }
  }
}

TEST_F(MachineCode, IsNotMadeForTooManyValues) {
  EXPECT_TRUE(machine_code::values(Program(program::Graph(5000), {1}), 0, 1) == nullptr);
}

/// Problem::operator() and acceleration() before and after they have code.
TEST_F(MachineCode, TakesOverFromTheInterpreter) {
  const Problem problem(equations("x'' = -x + y'^2 - sin(t); y'' = x y - 0.1 x'"));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(4, 0.3, 1.7), q = x.head(2), v = x.tail(2);
  Eigen::VectorXd f(4), first(4), a(2);
  problem(0.7, x, first);
  for (int i = 0; i < repays_after + 10; ++i) {
    problem(0.7, x, f);
    ASSERT_EQ(f, first) << i;
    problem.acceleration(0.7, q, v, a);
    ASSERT_EQ(a, first.tail(2)) << i;
  }
  Eigen::VectorXd in_place = x;  // as the interpreter, which reads the state before it writes
  problem(0.7, in_place, in_place);
  EXPECT_EQ(in_place, first);
}

TEST_F(MachineCode, IsMadeOnceWhenItRepaysItself) {
  const Equations all = equations("x' = 2 x");
  const Program program(all.graph(), all.slopes());
  const machine_code::CodeOnDemand<machine_code::Values> code(repays_after), none(repays_after);
  int made = 0;
  for (int i = 1; i <= repays_after + 10; ++i) {
    const bool there = code([&] { return ++made, machine_code::values(program, 0, 1); }) != nullptr;
    ASSERT_EQ(there, i >= repays_after) << i;
    ASSERT_TRUE(none([&] { return ++made, std::shared_ptr<machine_code::Values>(); }) == nullptr);
  }
  EXPECT_EQ(made, 2);
}

TEST_F(MachineCode, IsSharedByThreads) {
  const Problem problem(equations(everything));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(3, 0.3, 0.7);
  Eigen::VectorXd first(3);
  problem(0.2, x, first);
  std::vector<int> differ(4);
  std::vector<std::thread> threads;
  for (int& count : differ) {
    threads.emplace_back([&] {
      Eigen::VectorXd f(3);
      for (int i = 0; i < 2 * repays_after; ++i) {
        problem(0.2, x, f);
        if (f != first) ++count;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differ, std::vector<int>(4));
}

/// Tapes of all operations, of few sums, and of constants.
std::vector<Tape> tapes() {
  std::vector<Tape> all;
  for (const char* text :
       {everything, "x' = 10 (y - x); y' = 28 x - y - x z; z' = x y - 8/3 z", "x' = 2; y' = 0; z' = t - x/y",
        "x' = -x/3 + sin(t)/7; y' = sqrt(y) - 1/x; z' = exp(2 t) z^2",
        "x' = y z - x z + x*sin(z); y' = x y + x z - y*sin(z); z' = y x - x + z*cos(z)"})
    all.emplace_back(equations(text).graph(), equations(text).slopes());
  return all;
}

TEST_F(MachineCode, HasTheCoefficientsOfTapes) {
  for (const Tape& tape : tapes()) {
    for (const int order : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 17, 18, 25, 40}) {
      TapeExpansion expected(InstructionSet::avx2);
      expected.load(tape, order);
      const std::int64_t stride = order + 3;
      const auto code = machine_code::coefficients(tape.program(), stride, order);
      ASSERT_TRUE(code != nullptr);
      std::vector<double> memory(static_cast<std::size_t>(tape.series() * stride));
      States states;
      for (int trial = 0; trial < 100; ++trial) {
        const std::vector<double> x = states(4);
        const double scale = std::ldexp(1, trial % 7 - 4);
        expected.expand(x[3], x.data(), scale);
        memory[0] = x[3];
        memory[1] = scale;
        for (std::size_t i = 0; i < 3; ++i) memory[(i + 1) * static_cast<std::size_t>(stride)] = x[i];
        (*code)(memory.data(), nullptr, &scale);
        for (int i = 0; i < 3; ++i) {
          for (int k = 0; k <= order; ++k) {
            const double c = memory[static_cast<std::size_t>((i + 1) * stride + k)];
            ASSERT_TRUE(same(c, expected.coefficients(i)[k])) << i << ", " << k << " of " << order;
          }
        }
      }
    }
  }
}

/// The first expansions are those of the interpreter, the last of the code. Another tape has other code.
TEST_F(MachineCode, TakesOverFromTheKernel) {
  const std::vector<Tape> all = tapes();
  TapeExpansion repeated(InstructionSet::avx2);
  States states;
  for (const std::size_t which : {1U, 1U, 3U}) {
    repeated.load(all[which], 21);
    for (int i = 0; i < TapeExpansion::repays_after + 20; ++i) {
      const std::vector<double> x = states(4);
      TapeExpansion fresh(InstructionSet::avx2);
      fresh.load(all[which], 21);
      fresh.expand(x[3], x.data(), 0.5);
      repeated.expand(x[3], x.data(), 0.5);
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k <= 21; ++k)
          ASSERT_TRUE(same(fresh.coefficients(j)[k], repeated.coefficients(j)[k]))
              << i << ", " << j << ", " << k;
      }
    }
  }
}

/// Requests of the code of a tape of one solution, until there is one.
int requests_until_code(machine_code::SeriesCodes& codes, const Tape& tape, int order) {
  const auto code = codes.of(tape, order, 1, TapeExpansion::repays_after);
  const auto make = [&] { return machine_code::coefficients(tape.program(), order + 1, order); };
  int requests = 1;
  while ((*code)(make) == nullptr) ++requests;
  return requests;
}

/// The expansions of an earlier run count, if it had the same tape and order.
TEST_F(MachineCode, OfATapeIsSharedByRuns) {
  const Problem problem(equations(everything)), other(equations(everything));
  const std::vector<Problem> copies{problem};
  const Tape tape = tapes()[0], another = tapes()[1];
  TapeExpansion run(InstructionSet::avx2);
  run.load(tape, 9, problem.series_codes().get());
  const std::vector<double> x = {0.3, 0.5, 0.7};
  constexpr int expansions = TapeExpansion::repays_after - 10;
  for (int i = 0; i < expansions; ++i) run.expand(0, x.data());
  EXPECT_EQ(requests_until_code(*copies[0].series_codes(), tape, 9), 10);
  EXPECT_EQ(requests_until_code(*copies[0].series_codes(), tape, 9), 1);
  EXPECT_EQ(requests_until_code(*copies[0].series_codes(), tape, 8), TapeExpansion::repays_after);
  EXPECT_EQ(requests_until_code(*copies[0].series_codes(), another, 9), TapeExpansion::repays_after);
  EXPECT_EQ(requests_until_code(*other.series_codes(), tape, 9), TapeExpansion::repays_after);
}

TEST_F(MachineCode, OfTheLatestTapesAlone) {
  machine_code::SeriesCodes codes;
  const auto code = [&](int order) { return codes.of(tapes()[1], order, 1, 5); };
  const auto first = code(1);
  for (int order = 2; order <= 32; ++order) static_cast<void>(code(order));
  EXPECT_EQ(code(1), first);
  EXPECT_NE(codes.of(tapes()[1], 2, 8, 5), code(2));  // lanes; the oldest code goes
  EXPECT_NE(code(1), first);
}

TEST_F(MachineCode, OfATapeIsSharedByThreads) {
  const Tape tape = tapes()[0];
  const std::vector<double> x = {0.3, 0.5, 0.7};
  TapeExpansion expected(InstructionSet::avx2);
  expected.load(tape, 9);
  expected.expand(0.1, x.data());
  machine_code::SeriesCodes codes;
  std::vector<int> differ(4);
  std::vector<std::thread> threads;
  for (int& count : differ) {
    threads.emplace_back([&] {
      for (int run = 0; run < 20; ++run) {
        TapeExpansion expansion(InstructionSet::avx2);
        expansion.load(tape, 9, &codes);
        for (int i = 0; i < TapeExpansion::repays_after / 10; ++i) {
          expansion.expand(0.1, x.data());
          if (expansion.coefficients(2)[9] != expected.coefficients(2)[9]) ++count;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differ, std::vector<int>(4));
}

TEST_F(MachineCode, HasTheCoefficientsOfLanes) {
  const std::vector<Tape> all = tapes();
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (!available(set)) continue;
    for (const Tape& tape : all) {
      for (const int order : {2, 3, 5, 9, 12, 18, 23}) {
        if (order > 12 && &tape == &all.front()) continue;  // too many products
        TapeLanes repeated(set);
        repeated.load(tape, order);
        const int lanes = repeated.lanes();
        ASSERT_TRUE(machine_code::lane_coefficients(tape.program(), std::int64_t{order + 1} * lanes, order,
                                                    set) != nullptr);
        States states;
        for (int i = 0; i < TapeLanes::repays_after + 5; ++i) {
          TapeLanes fresh(set);
          fresh.load(tape, order);
          for (int lane = 0; lane < lanes; ++lane) {
            const std::vector<double> x = states(4);
            for (TapeLanes* each : {&fresh, &repeated})
              each->set(lane, x[3], x.data(), std::ldexp(1, lane % 5 - 2));
          }
          repeated.expand();
          if (i < TapeLanes::repays_after - 5) continue;
          fresh.expand();
          for (int j = 0; j < 3; ++j) {
            for (int k = 0; k <= order; ++k) {
              for (int lane = 0; lane < lanes; ++lane)
                ASSERT_TRUE(same(fresh.coefficients(j, k)[lane], repeated.coefficients(j, k)[lane]))
                    << i << ", " << j << ", " << k << " of " << order;
            }
          }
        }
      }
    }
  }
}

/// From here on the system refuses to make memory of this process executable.
void refuse_executable_memory() {
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_mprotect, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t)),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  sock_fprog program = {.len = std::size(rules), .filter = rules};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    std::exit(2);
}

TEST_F(MachineCode, LeavesItToTheInterpretersWithoutExecutableMemory) {
  const auto values = [] {
    const Equations all = equations("x' = x y - t; y' = sin(x)");
    const Problem problem(all);
    const Eigen::Vector2d start(0.3, 0.4);
    Eigen::VectorXd f(2), x = start;
    for (int i = 0; i < 2 * repays_after; ++i) problem(0.1, x, f);
    TapeExpansion expansion;
    expansion.load(Tape(all.graph(), all.slopes()), 12);
    for (int i = 0; i < 2 * TapeExpansion::repays_after; ++i) expansion.expand(0.1, x.data());
    return std::vector<double>{f[0], f[1], expansion.coefficients(0)[12], expansion.coefficients(1)[12]};
  };
  const std::vector<double> expected = values();
  EXPECT_EXIT(
      {
        refuse_executable_memory();
        const Equations all = equations("x' = x");
        const bool none = machine_code::values(Program(all.graph(), all.slopes()), 0, 1) == nullptr;
        std::exit(none && values() == expected ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace nlmech::tests::machine_code_test
