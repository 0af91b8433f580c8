#include "nlmech/program/power_series.hpp"

namespace nlmech {

template class PowerSeries<double>;
template class PowerSeries<long double>;

}  // namespace nlmech
