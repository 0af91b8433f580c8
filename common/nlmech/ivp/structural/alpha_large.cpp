#include "nlmech/ivp/structural/alpha_stepper.hpp"

namespace nlmech::ivp {

template Solution<6> walk_by_alpha(const Task<System<6>>&, std::string_view, double, const AlphaScheme&,
                                   const algebraic::Newton&);
template Solution<Eigen::Dynamic> walk_by_alpha(const Task<System<Eigen::Dynamic>>&, std::string_view, double,
                                                const AlphaScheme&, const algebraic::Newton&);

}  // namespace nlmech::ivp
