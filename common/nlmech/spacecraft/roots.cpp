#include "nlmech/spacecraft/roots.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
RootCount count_roots(const AnalyticFunction&, const Rectangle&) { throw std::logic_error("count_roots"); }
Roots find_roots(const AnalyticFunction&, const Rectangle&) { throw std::logic_error("find_roots"); }
Root refine_root(const AnalyticFunction&, Complex) { throw std::logic_error("refine_root"); }
}  // namespace nlmech::spacecraft
