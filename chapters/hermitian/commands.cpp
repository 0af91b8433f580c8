#include <fmt/format.h>

#include <string>

#include "chapters/hermitian/peaks.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::hermitian {
namespace {

struct PeakOptions {
  std::string problem, method;
  double step = 0;
};

void declare(scene::Options& options, PeakOptions& typed) {
  options
      .add("--problem", typed.problem,
           "oscillator of the paper: from rest (laier-duffing) or from 0.01 (laier-van-der-pol)")
      .one_of({"laier-duffing", "laier-van-der-pol"})
      .required();
  options.add("--method", typed.method, "author of the operators")
      .one_of({"laier", "argyris", "newmark", "hoff", "bazzi"})
      .required();
  options.add("--step", typed.step, "step size, s").positive().required();
}

std::string peak(const PeakOptions& typed) {
  const Case what = typed.problem == "laier-duffing" ? duffing_case() : van_der_pol_case();
  // The peaks are at t = 2.45 and 4.60; longer steps miss them.
  const Peak found =
      first_peak(what, {.operators = ivp::hermitian_pair(typed.method), .step = typed.step}, 40);
  if (!found.status.ok()) throw Failure(found.status);
  return fmt::format("t,peak\n{:.17g},{:.17g}\n", found.t, found.x);
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("peak", "Print the first peak of an oscillator of the paper as CSV: t,peak", declare, peak);
}

}  // namespace nlmech::chapters::hermitian
