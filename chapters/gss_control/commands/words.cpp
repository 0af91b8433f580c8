#include "chapters/gss_control/commands/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {

void declare_craft(scene::Options& options, Craft& craft, bool with_gains) {
  options.add(
      "--spacecraft", craft.file,
      "TOML file, - for standard input, with hub_inertia, mass_per_length, youngs_modulus, length, "
      "hub_radius, second_moment, tip_mass, tip_inertia in any consistent units, which are those of all "
      "options and results; without it, and for a key that is missing, Table 3.1 in slug, ft, lb, s");
  if (with_gains)
    options.add("--gains", craft.gains, "k1,k2,k3 of u = -k1 (theta - theta_f) - k2 (r S0 - M0) - k3 theta'");
}

std::vector<double> typed_frequencies(const char* option, const std::string& text) {
  if (text.find(':') == std::string::npos) {
    std::vector<double> all;
    for (const std::string& word : scene::typed_words(option, text)) {
      const double omega = scene::typed_number(option, word);
      if (omega == 0)
        throw InputError(fmt::format("{} {}: 0 is the double pole of a free body", option, text));
      all.push_back(omega);
    }
    return all;
  }
  const std::vector<std::string> parts = scene::split(text, ':');
  if (parts.size() != 3)
    throw InputError(fmt::format("{} {}: LO:HI:N has three parts, not {}", option, text, parts.size()));
  const double low = scene::typed_positive(option, parts[0]), high = scene::typed_positive(option, parts[1]);
  const int n = scene::typed_whole(option, parts[2], 1, 10'000'000);
  if (n < 2 || !(high > low))
    throw InputError(fmt::format("{} {}: LO:HI:N needs LO below HI, and N of 2 at least", option, text));
  return logarithmic(low, high, n);
}

std::vector<Place> typed_places(const char* option, const std::string& text,
                                const spacecraft::Parameters& craft) {
  std::vector<Place> all;
  if (text.empty()) return all;
  for (const std::string& word : scene::typed_words(option, text)) {
    const double x = scene::typed_number(option, word);
    if (x < 0 || x > craft.length)
      throw InputError(fmt::format("{} {}: {} lies off the appendage, which reaches from 0 to {:.17g}",
                                   option, text, word, craft.length));
    all.push_back({word, x});
  }
  return all;
}

spacecraft::ClosedLoop typed_loop(const spacecraft::Parameters& craft, const std::vector<double>& gains) {
  const std::string typed = fmt::format("--gains {}", fmt::join(gains, ","));
  if (gains.size() != 3)
    throw InputError(fmt::format("{}: {} numbers where k1,k2,k3 are needed", typed, gains.size()));
  try {
    return {craft, {gains[0], gains[1], gains[2]}};
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", typed, error.what()));
  }
}

std::vector<double> typed_times(double until, const std::optional<double>& every) {
  std::vector<double> times = {0};
  if (every) {
    if (until / *every > 1e7) throw InputError(fmt::format("--every {}: more than 10 million rows", *every));
    // A last step shorter than a millionth of DT is rounding of T/DT, and no row of its own.
    for (int i = 1; i * *every < until - 1e-6 * *every; ++i) times.push_back(i * *every);
  }
  times.push_back(until);
  return times;
}

}  // namespace nlmech::chapters::gss_control
