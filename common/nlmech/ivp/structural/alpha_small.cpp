#include "nlmech/ivp/structural/alpha_stepper.hpp"

namespace nlmech::ivp {

template Solution<2> walk_by_alpha(const Task<System<2>>&, std::string_view, double, const AlphaScheme&,
                                   const algebraic::Newton&);
template Solution<4> walk_by_alpha(const Task<System<4>>&, std::string_view, double, const AlphaScheme&,
                                   const algebraic::Newton&);

}  // namespace nlmech::ivp
