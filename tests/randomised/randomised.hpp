/// @file
/// A machine that looks for silent failures: random cases in which the corners of each range are drawn more
/// often than their share, and every success is held to something that does not use the code under test.
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
/// The quick share is a unit test; with NLMECH_RANDOMISED=full in the environment (label `long`, `make
/// randomised`) all of it runs. NLMECH_RANDOMISED_SEED draws other cases, NLMECH_RANDOMISED_CASE=n runs the
/// n-th one alone and prints it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <random>
#include <span>
#include <string>

namespace nlmech::randomised {

/// The random numbers of one case: the same for the same seed on every machine.
class Draw {
 public:
  /// @param seed of the case
  explicit Draw(std::uint64_t seed);

  /// Between the two, each in sight; one case in eight is an end of the range or its middle.
  [[nodiscard]] double uniform(double low, double high);
  /// Between two positive numbers, its logarithm uniform; one case in eight is an end of the range or a power
  /// of ten.
  [[nodiscard]] double log_uniform(double low, double high);
  /// log_uniform() with a random sign.
  [[nodiscard]] double signed_log(double low, double high);
  /// Any finite number of double: bit patterns, zeros of both signs, the smallest and the largest, halves and
  /// wholes.
  [[nodiscard]] double any_finite();
  /// A whole number, both ends included.
  [[nodiscard]] int whole(int low, int high);
  /// True in a share @p probability of the cases.
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

/// What became of one case.
struct Case {
  /// Wrong is what the machine looks for; refused is a status or an exception that names the trouble;
  /// undecided, that the oracle does not know.
  enum class Verdict { right, wrong, refused, undecided };
  Verdict verdict;        ///< how it ended
  double ratio = 0;       ///< error over its bound; meaningful for right and wrong
  std::string what = {};  ///< all that is needed to repeat it by hand

  /// Right if @p error <= @p bound; wrong otherwise, also for a NaN.
  [[nodiscard]] static Case judged(double error, double bound, std::string what);
  /// A success that breaks something which is not a number: a missing row, a broken bound.
  [[nodiscard]] static Case wrong(std::string what);
  /// A status with a sentence, or an exception.
  [[nodiscard]] static Case refused(std::string what = {});
  /// There is no oracle for this one.
  [[nodiscard]] static Case undecided(std::string what = {});
};

/// How many cases, and how many of them have to come to a judgement for the randomised test to mean
/// something.
struct RandomisedTest {
  std::int64_t quick = 100;    ///< cases of the unit test
  std::int64_t full = 10'000;  ///< cases with NLMECH_RANDOMISED=full
  double least_right =
      0.1;  ///< share of right ones below which the randomised test fails as empty, if that is no chance
};

/// Runs the cases of the current test; fails it at a wrong one (the first few are printed with their
/// numbers), and if too few were judged. An exception other than std::invalid_argument, InputError and
/// Failure is a wrong case too. With NLMECH_RANDOMISED=full the counts are written as a row of
/// this seed for tables/RANDOMISED.md.
void randomised_test(const RandomisedTest& size, const std::function<Case(Draw&)>& trial);

}  // namespace nlmech::randomised
