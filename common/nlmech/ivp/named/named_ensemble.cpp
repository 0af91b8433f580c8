#include "nlmech/ivp/named/named_ensemble.hpp"

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp {

std::vector<Solution> integrate_all_by(const MethodInfo& method, const Settings& settings,
                                       std::span<const Start> starts, int threads) {
  const NamedIntegrator one = method.with(settings);
  if (method.name == Series::name && !settings.step)
    return integrate_all(starts, named::series_of(settings), threads);
  std::vector<Solution> solutions(starts.size());
  share_out(starts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Start& s = starts[i];
      solutions[i] = one(*s.system, s.x0, s.t0, s.t1, s.observer, s.limits_from_now());
      solutions[i].statistics.seconds = 0;
    }
  });
  return solutions;
}

}  // namespace nlmech::ivp
