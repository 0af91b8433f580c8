#include "tests/randomised/randomised.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "nlmech/support/errors.hpp"
#include "tests/places.hpp"

namespace nlmech::randomised {
namespace {

constexpr double corner_share = 0.125;
constexpr std::size_t shown = 8;  // number of wrong cases that are printed

/// SplitMix64: neighbouring seeds give unrelated numbers.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Hash of the name, equal on every machine (FNV-1a).
std::uint64_t hashed(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::int64_t from_environment(const char* name, std::int64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoll(text, nullptr, 10);
}

bool is_full() {
  const char* const text = std::getenv("NLMECH_RANDOMISED");
  return text != nullptr && std::string_view(text) == "full";
}

/// An exception that the tested code may throw is a refusal; any other is a failure of the test.
Case tried(const std::function<Case(Draw&)>& trial, Draw& draw) {
  try {
    return trial(draw);
  } catch (const std::invalid_argument& error) {
    return Case::refused(error.what());
  } catch (const InputError& error) {
    return Case::refused(error.what());
  } catch (const Failure& error) {
    return Case::refused(error.what());
  } catch (const std::exception& error) {
    return Case::wrong(fmt::format("an exception that no caller expects: {}", error.what()));
  }
}

struct Counts {
  std::int64_t cases = 0, right = 0, wrong = 0, refused = 0, undecided = 0;
  double worst = 0;  // largest error over bound among the right cases

  void add(const Case& c) {
    ++cases;
    using enum Case::Verdict;
    if (c.verdict == right) {
      ++this->right;
      worst = std::max(worst, c.ratio);
    }
    if (c.verdict == wrong) ++this->wrong;
    if (c.verdict == refused) ++this->refused;
    if (c.verdict == undecided) ++this->undecided;
  }
};

/// Writes a row for tables/RANDOMISED.md: a file for each test and seed, so that tests may run in parallel.
void keep(const std::string& name, std::int64_t seed, const Counts& n) {
  const std::filesystem::path folder = std::filesystem::path(NLMECH_BINARY_DIR) / "randomised";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / fmt::format("{}.{}.csv", name, seed))
      << fmt::format("{},{},{},{},{},{},{},{:.2g}\n", name, seed, n.cases, n.right, n.refused, n.undecided,
                     n.wrong, n.worst);
}

/// The smallest number of right cases: three standard deviations below the stated share, at least one.
double least_right_of(const RandomisedTest& size, std::int64_t cases) {
  const double mean = size.least_right * static_cast<double>(cases);
  return mean > 0 ? std::max(1.0, mean - 3 * std::sqrt(mean)) : 0;
}

void show_alone(std::int64_t number, const Case& c) {
  constexpr std::array words = {"right", "wrong", "refused", "undecided"};
  std::cout << fmt::format("case {}: {}, {:.3g} of its bound; {}\n", number,
                           words.at(static_cast<std::size_t>(c.verdict)), c.ratio, c.what);
}

}  // namespace

Draw::Draw(std::uint64_t seed) : engine_(seed) {}

double Draw::unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

double Draw::uniform(double low, double high) {
  if (unit() < corner_share) return one_of({low, high, low / 2 + high / 2});
  return low + (high - low) * unit();
}

double Draw::log_uniform(double low, double high) {
  const double from = std::log10(low), to = std::log10(high);
  if (unit() < corner_share) {
    const double ten = std::pow(10.0, whole(static_cast<int>(std::ceil(from)),
                                            static_cast<int>(std::floor(std::max(to, std::ceil(from))))));
    return one_of({low, high, std::clamp(ten, low, high)});
  }
  return std::clamp(std::pow(10.0, from + (to - from) * unit()), low, high);
}

double Draw::signed_log(double low, double high) {
  const double size = log_uniform(low, high);
  return chance(0.5) ? size : -size;
}

double Draw::any_finite() {
  using Limits = std::numeric_limits<double>;
  if (unit() < 0.25) {
    const double x = one_of({0.0, 0.5, 1.0, 2.0, Limits::min(), Limits::max(), Limits::denorm_min(),
                             Limits::epsilon(), 1e308, 1e-308});
    return chance(0.5) ? x : -x;
  }
  for (;;) {
    const double x = std::bit_cast<double>(engine_());
    if (std::isfinite(x)) return x;
  }
}

int Draw::whole(int low, int high) {
  const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
  return static_cast<int>(low + static_cast<std::int64_t>(engine_() % count));
}

bool Draw::chance(double probability) { return unit() < probability; }

double Draw::normal() {  // Box and Muller
  constexpr double two_pi = 6.283185307179586;
  const double radius = std::sqrt(-2 * std::log1p(-unit()));
  return radius * std::cos(two_pi * unit());
}

Case Case::judged(double error, double bound, std::string what) {
  const bool is_right = error <= bound;
  const double ratio = bound > 0 ? error / bound : is_right ? 0 : HUGE_VAL;
  if (is_right) return {Verdict::right, ratio, std::move(what)};
  return {Verdict::wrong, ratio, fmt::format("error {:.3g}, allowed {:.3g}; {}", error, bound, what)};
}

Case Case::wrong(std::string what) { return {Verdict::wrong, HUGE_VAL, std::move(what)}; }
Case Case::refused(std::string what) { return {Verdict::refused, 0, std::move(what)}; }
Case Case::undecided(std::string what) { return {Verdict::undecided, 0, std::move(what)}; }

void randomised_test(const RandomisedTest& size, const std::function<Case(Draw&)>& trial) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = fmt::format("{}.{}", test->test_suite_name(), test->name());
  const bool full = is_full();
  const std::int64_t seed = from_environment("NLMECH_RANDOMISED_SEED", 1);
  const auto first = mixed(hashed(name) + static_cast<std::uint64_t>(seed));
  const auto case_of = [&](std::int64_t number) {
    Draw draw(mixed(first + static_cast<std::uint64_t>(number)));
    return tried(trial, draw);
  };
  if (const std::int64_t alone = from_environment("NLMECH_RANDOMISED_CASE", -1); alone >= 0) {
    show_alone(alone, case_of(alone));
    return;
  }
  Counts counts;
  for (std::int64_t number = 0; number < (full ? size.full : size.quick); ++number) {
    const Case found = case_of(number);
    counts.add(found);
    if (found.verdict == Case::Verdict::wrong && static_cast<std::size_t>(counts.wrong) <= shown)
      ADD_FAILURE() << "case " << number << " (NLMECH_RANDOMISED_SEED=" << seed
                    << " NLMECH_RANDOMISED_CASE=" << number << "): " << found.what;
  }
  std::cout << fmt::format(
      "randomised {}: {} cases, {} right (worst {:.2g} of its bound), {} refused, {} undecided, {} wrong\n",
      name, counts.cases, counts.right, counts.worst, counts.refused, counts.undecided, counts.wrong);
  EXPECT_EQ(counts.wrong, 0) << "successes that are wrong";
  EXPECT_GE(static_cast<double>(counts.right), least_right_of(size, counts.cases))
      << "too few cases come to a judgement: the randomised test is empty";
  if (full) keep(name, seed, counts);
}

}  // namespace nlmech::randomised
