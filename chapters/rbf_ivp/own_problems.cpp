#include <memory>

#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::comparison {

template std::unique_ptr<OwnProblem> own_problem<problems::VanDerPol>();
template std::unique_ptr<OwnProblem> own_problem<problems::BlowUp>();
template std::unique_ptr<OwnProblem> own_problem<problems::Robertson>();
template std::unique_ptr<OwnProblem> own_problem<problems::Hires>();

}  // namespace nlmech::comparison
