#include <memory>

#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"

namespace nlmech::comparison {

template std::unique_ptr<OwnProblem> own_problem<problems::Lorenz>();
template std::unique_ptr<OwnProblem> own_problem<problems::Projectile>();
template std::unique_ptr<OwnProblem> own_problem<problems::FourBodies>();

}  // namespace nlmech::comparison
