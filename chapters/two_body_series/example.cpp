#include <cstdio>

#include "nlmech/orbit/continuation.hpp"

int main() {
  using namespace nlmech;
  const orbit::State start{{7e6, 0, 0}, {0, 7.5e3, 0}};
  const auto end = orbit::propagate(start, 0, 86400, orbit::earth());
  std::printf("%s\n", end.status.ok() ? "ok" : end.status.text().c_str());
  return end.status.ok() ? 0 : 1;
}
