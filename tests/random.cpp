#include "tests/random.hpp"

namespace nlmech::tests {

rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 52), [=](std::int64_t i) {
    return low + (high - low) * (static_cast<double>(i) * 0x1p-52);
  });
}

}  // namespace nlmech::tests

template void rc::detail::checkGTest<void (*)()>(void (*&&)());
template class rc::Gen<double>;
template class rc::Gen<int>;
template class rc::Gen<std::int64_t>;
template class rc::Shrinkable<double>;
template class rc::Shrinkable<int>;
template class rc::Shrinkable<std::int64_t>;
template class rc::Seq<rc::Shrinkable<double>>;
template class rc::Seq<rc::Shrinkable<int>>;
template class rc::Seq<rc::Shrinkable<std::int64_t>>;
template rc::Gen<int> rc::gen::inRange<int>(int, int);
template rc::Gen<std::int64_t> rc::gen::inRange<std::int64_t>(std::int64_t, std::int64_t);
