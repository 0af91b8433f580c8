/// @file
/// Random numbers for properties. The common part of RapidCheck is compiled once, in random.cpp.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdint>

namespace nlmech::tests {

/// A double in [low, high) with all digits random. RapidCheck draws the first cases of a property near the
/// lower bound and the last ones anywhere.
[[nodiscard]] rc::Gen<double> between(double low, double high);

}  // namespace nlmech::tests

extern template void rc::detail::checkGTest<void (*)()>(void (*&&)());
extern template class rc::Gen<double>;
extern template class rc::Gen<int>;
extern template class rc::Gen<std::int64_t>;
extern template class rc::Shrinkable<double>;
extern template class rc::Shrinkable<int>;
extern template class rc::Shrinkable<std::int64_t>;
extern template class rc::Seq<rc::Shrinkable<double>>;
extern template class rc::Seq<rc::Shrinkable<int>>;
extern template class rc::Seq<rc::Shrinkable<std::int64_t>>;
extern template rc::Gen<int> rc::gen::inRange<int>(int, int);
extern template rc::Gen<std::int64_t> rc::gen::inRange<std::int64_t>(std::int64_t, std::int64_t);
