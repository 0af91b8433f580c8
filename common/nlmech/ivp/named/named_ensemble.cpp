#include "nlmech/ivp/named/named_ensemble.hpp"

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp {

template <int n>
std::vector<Solution<n>> each_by(const NamedIntegrator<n>& method, std::span<const Start<n>> starts,
                                 int threads) {
  std::vector<Solution<n>> solutions(starts.size());
  share_out(starts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Start<n>& s = starts[i];
      solutions[i] = method(*s.system, s.x0, s.t0, s.t1, s.observer, s.limits_from_now());
      solutions[i].statistics.seconds = 0;
    }
  });
  return solutions;
}

template <int n>
std::vector<Solution<n>> named_integrate_all(std::string_view name, const Settings& settings,
                                             std::span<const Start<n>> starts, int threads) {
  const NamedIntegrator<n> method = named_integrator<n>(name, settings);
  if (name != Series::name || settings.step) return each_by<n>(method, starts, threads);
  return integrate_all<n>(starts, named::series_of(settings), threads);
}

template std::vector<Solution<1>> each_by<1>(const NamedIntegrator<1>&, std::span<const Start<1>>, int);
template std::vector<Solution<2>> each_by<2>(const NamedIntegrator<2>&, std::span<const Start<2>>, int);
template std::vector<Solution<3>> each_by<3>(const NamedIntegrator<3>&, std::span<const Start<3>>, int);
template std::vector<Solution<4>> each_by<4>(const NamedIntegrator<4>&, std::span<const Start<4>>, int);
template std::vector<Solution<6>> each_by<6>(const NamedIntegrator<6>&, std::span<const Start<6>>, int);
template std::vector<Solution<Eigen::Dynamic>> each_by<Eigen::Dynamic>(const NamedIntegrator<Eigen::Dynamic>&,
                                                                       std::span<const Start<Eigen::Dynamic>>,
                                                                       int);

template std::vector<Solution<1>> named_integrate_all<1>(std::string_view, const Settings&,
                                                         std::span<const Start<1>>, int);
template std::vector<Solution<2>> named_integrate_all<2>(std::string_view, const Settings&,
                                                         std::span<const Start<2>>, int);
template std::vector<Solution<3>> named_integrate_all<3>(std::string_view, const Settings&,
                                                         std::span<const Start<3>>, int);
template std::vector<Solution<4>> named_integrate_all<4>(std::string_view, const Settings&,
                                                         std::span<const Start<4>>, int);
template std::vector<Solution<6>> named_integrate_all<6>(std::string_view, const Settings&,
                                                         std::span<const Start<6>>, int);
template std::vector<Solution<Eigen::Dynamic>> named_integrate_all<Eigen::Dynamic>(
    std::string_view, const Settings&, std::span<const Start<Eigen::Dynamic>>, int);

}  // namespace nlmech::ivp
