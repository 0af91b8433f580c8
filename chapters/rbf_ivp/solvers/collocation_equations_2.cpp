#include "chapters/rbf_ivp/solvers/collocation_equations_of.hpp"

namespace nlmech::chapters::rbf_ivp {

template class CollocationEquations<2>;

}  // namespace nlmech::chapters::rbf_ivp
