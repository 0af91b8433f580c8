#include "chapters/rbf_ivp/solvers/collocation_equations_of.hpp"

namespace nlmech::chapters {

template class CollocationEquations<2>;

}  // namespace nlmech::chapters
