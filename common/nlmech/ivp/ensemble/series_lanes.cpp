#include "nlmech/ivp/ensemble/series_lanes.hpp"

namespace nlmech::ivp::detail {

template class SeriesLanes<1>;
template class SeriesLanes<2>;
template class SeriesLanes<3>;
template class SeriesLanes<4>;
template class SeriesLanes<6>;
template class SeriesLanes<Eigen::Dynamic>;

}  // namespace nlmech::ivp::detail
