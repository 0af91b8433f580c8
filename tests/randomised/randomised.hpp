/// @file
/// Randomised tests against silent failures: random cases with frequent special values; every success is
/// compared with a reference that does not use the tested code.
///
///     TEST(RandomisedKepler, PropagationKeepsItsDigits) {
///       randomised_test({.quick = 300, .full = 200'000}, [](Draw& draw) {
///         const double e = draw.log_uniform(1e-12, 0.999999);
///         ...
///         if (!found.status.ok()) return Case::refused();
///         if (!oracle.sure) return Case::undecided();
///         return Case::judged(error, bound, fmt::format("e = {:.17g}, ...", e));
///       });
///     }
///
/// The number `quick` is that of the unit test; with NLMECH_RANDOMISED=full in the environment (label `long`,
/// `make randomised`) `full` cases run. NLMECH_RANDOMISED_SEED selects other cases; NLMECH_RANDOMISED_CASE=n
/// runs case n alone and prints it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <random>
#include <span>
#include <string>

namespace nlmech::randomised {

/// The random numbers of one case, equal for the same seed on every machine.
class Draw {
 public:
  /// @param seed of the case
  explicit Draw(std::uint64_t seed);

  /// Uniform between @p low and @p high; one case in eight is an end of the range or its middle.
  [[nodiscard]] double uniform(double low, double high);
  /// Between two positive numbers, uniform in the logarithm; one case in eight is an end of the range or a
  /// power of ten.
  [[nodiscard]] double log_uniform(double low, double high);
  /// log_uniform() with a random sign.
  [[nodiscard]] double signed_log(double low, double high);
  /// Any finite double: random bit patterns, zeros of both signs, the smallest and the largest number, simple
  /// numbers.
  [[nodiscard]] double any_finite();
  /// An integer from @p low to @p high.
  [[nodiscard]] int whole(int low, int high);
  /// True with the probability @p probability.
  [[nodiscard]] bool chance(double probability);
  /// A normal deviate.
  [[nodiscard]] double normal();
  /// One of a list.
  template <class T>
  [[nodiscard]] T one_of(std::initializer_list<T> list) {
    return list.begin()[whole(0, static_cast<int>(list.size()) - 1)];
  }
  /// One of a range with size() and [].
  template <class Range>
  [[nodiscard]] const auto& one_of(const Range& range) {
    return range[static_cast<std::size_t>(whole(0, static_cast<int>(range.size()) - 1))];
  }

 private:
  [[nodiscard]] double unit();  // in [0, 1)
  std::mt19937_64 engine_;
};

/// The result of one case.
struct Case {
  /// wrong: a silent failure; refused: a status or an exception that names the cause; undecided: no
  /// reference.
  enum class Verdict { right, wrong, refused, undecided };
  Verdict verdict;        ///< the result
  double ratio = 0;       ///< error over its bound; meaningful for right and wrong
  std::string what = {};  ///< all data needed to repeat the case

  /// Right if @p error <= @p bound; wrong otherwise, also for a NaN.
  [[nodiscard]] static Case judged(double error, double bound, std::string what);
  /// A success with a non-numerical error, such as a missing row or a violated bound.
  [[nodiscard]] static Case wrong(std::string what);
  /// A failure with a message, or an exception.
  [[nodiscard]] static Case refused(std::string what = {});
  /// A case without reference.
  [[nodiscard]] static Case undecided(std::string what = {});
};

/// Numbers of cases, and the share of right cases that the test requires.
struct RandomisedTest {
  std::int64_t quick = 100;    ///< cases of the unit test
  std::int64_t full = 10'000;  ///< cases with NLMECH_RANDOMISED=full
  double least_right =
      0.1;  ///< smallest share of right cases; three standard deviations below it the test fails as empty
};

/// Runs the cases of the current test. It fails for a wrong case (the first few are printed with their data)
/// and for too few right cases. An exception other than std::invalid_argument, InputError and Failure is a
/// wrong case. With NLMECH_RANDOMISED=full the counts are written as a row of this seed for
/// tables/RANDOMISED.md.
void randomised_test(const RandomisedTest& size, const std::function<Case(Draw&)>& trial);

}  // namespace nlmech::randomised
