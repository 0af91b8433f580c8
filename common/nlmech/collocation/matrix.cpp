#include "nlmech/collocation/matrix.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

namespace nlmech::collocation {

void require_node_count(const char* what, Eigen::Index n, int least) {
  if (n >= least && n <= max_nodes) return;
  throw std::invalid_argument(std::string(what) + ": the number of nodes must lie between " +
                              std::to_string(least) + " and " + std::to_string(max_nodes) + ", is " +
                              std::to_string(n));
}

void refuse_node(const char* what, Eigen::Index k, double node, const char* why) {
  std::ostringstream text;
  text.precision(17);
  text << what << ": node number " << k << ", " << node << ", " << why;
  throw std::invalid_argument(text.str());
}

void refuse_time(const char* what, double t) {
  throw std::invalid_argument(std::string(what) + ": the time must be finite, is " + std::to_string(t));
}

}  // namespace nlmech::collocation
