#include <numbers>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::series::basel {
namespace {

/// The sum of 1/k^2 over so many terms.
struct Sum {
  int terms;
  double value;
  [[nodiscard]] double rest() const { return std::numbers::pi * std::numbers::pi / 6 - value; }
};

std::vector<Sum> sums(bool quick) {
  std::vector<Sum> all;
  double value = 0;
  for (int k = 1; k <= (quick ? 100 : 1000); ++k) all.push_back({k, value += 1.0 / k / k});
  return all;
}

void put(const std::vector<Sum>& all, scene::Show& show) {
  show.plot("The rest falls as the reciprocal of the terms", "terms", "rest")
      .log_x(1, 1000)
      .log_y(1e-3, 2)
      .curve("", all, &Sum::terms, &Sum::rest);
  show.at_most("rest times terms", all.back().rest() * all.back().terms, 1,
               "the integral of 1/x^2 bounds it");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "basel",
           .title = "What partial sums of the reciprocal squares leave",
           .content = scene::Content(put, scene::Result("sums", "as Euler states it", sums))}};
}

}  // namespace nlmech::chapters::series::basel
