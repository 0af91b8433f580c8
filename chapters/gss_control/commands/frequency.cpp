#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/gss_control/commands/commands.hpp"
#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/gss_control/commands/words.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Complex;

/// What was typed.
struct Words {
  Craft craft;
  int count = 10;
  std::string at, omega;
};

void declare_poles(scene::Options& options, Words& words) {
  declare_craft(options, words.craft);
  options.add("--count", words.count, "how many").range(1, 1000);
}

void declare_zeros(scene::Options& options, Words& words) {
  declare_poles(options, words);
  options.add("--at", words.at, "place on the appendage, its distance from the rim");
}

void declare_response(scene::Options& options, Words& words) {
  declare_craft(options, words.craft);
  options.add("--omega", words.omega, "w1,w2,... or LO:HI:N, N logarithmically spaced, rad/s").required();
  options.add("--at", words.at, "places on the appendage x1,x2,..., their distances from the rim");
}

std::string table_of(const std::vector<Complex>& points, int count) {
  std::string text = "index,real,imag\n";
  for (std::size_t i = 0; i < std::min(std::size_t(count), points.size()); ++i)
    text += fmt::format("{},{:.17g},{:.17g}\n", i + 1, points[i].real() + 0., points[i].imag() + 0.);
  return text;
}

std::vector<Complex> on_axis(const spacecraft::Frequencies& f) {
  if (!f.status.ok()) throw Failure(f.status);
  std::vector<Complex> all;
  for (const double omega : f.omega) all.emplace_back(0, omega);
  return all;
}

std::string poles(const Words& words) {
  const spacecraft::Parameters craft = read_spacecraft(words.craft.file);
  if (words.craft.gains.empty())
    return table_of(on_axis(spacecraft::poles(spacecraft::Plant(craft), words.count)), words.count);
  const spacecraft::LoopPoles found = typed_loop(craft, words.craft.gains).poles(words.count);
  if (!found.status.ok()) throw Failure(found.status);
  return table_of(found.s, words.count);
}

/// The first zeros of y(x)/u with Im s >= 0, by modulus.
std::vector<Complex> deflection_zeros(const spacecraft::Plant& plant, double x, int count) {
  // About as many zeros as poles below a frequency; the square grows until there are enough.
  const spacecraft::Frequencies guide = spacecraft::poles(plant, count);
  if (!guide.status.ok()) throw Failure(guide.status);
  double omega = 1.2 * guide.omega.back();
  std::vector<Complex> all;
  for (int k = 0; k < 12; ++k, omega *= 1.5) {
    const spacecraft::Zeros found = spacecraft::deflection_zeros(plant, x, omega);
    if (!found.status.ok()) throw Failure(found.status);
    all.clear();
    for (const Complex& s : found.s) {
      all.push_back(s);
      if (s.imag() == 0 && s.real() > 0) all.push_back(-s);  // a real pair has no imaginary part below 0
    }
    // Beyond this modulus the square of z = s^2 does not hold them all.
    const auto complete = std::count_if(all.begin(), all.end(),
                                        [omega](const Complex& s) { return std::abs(s) < 0.99 * omega; });
    if (complete >= count) break;
  }
  std::stable_sort(all.begin(), all.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a) < std::abs(b) * (1 - 1e-14);
  });
  return all;
}

std::string zeros(const Words& words) {
  const int count = words.count;
  const spacecraft::Parameters craft = read_spacecraft(words.craft.file);
  // Feedback from the hub moves no zero, but a loop that cannot be is refused all the same.
  if (!words.craft.gains.empty()) static_cast<void>(typed_loop(craft, words.craft.gains));
  const spacecraft::Plant plant(craft);
  if (words.at.empty()) return table_of(on_axis(spacecraft::hub_zeros(plant, count)), count);
  const std::vector<Place> places = typed_places("--at", words.at, craft);
  if (places.size() != 1) throw InputError(fmt::format("--at {}: zeros are those of one place", words.at));
  if (places[0].x == 0) throw InputError(fmt::format("--at {}: y is 0 at the root, at any s", words.at));
  const std::vector<Complex> found = deflection_zeros(plant, places[0].x, count);
  if (found.size() < std::size_t(count))
    throw Failure(
        Status::failure(Outcome::not_converged,
                        fmt::format("zeros: {} of {} found; ask for fewer by --count", found.size(), count)));
  return table_of(found, count);
}

std::string response(const Words& words) {
  const spacecraft::Parameters craft = read_spacecraft(words.craft.file);
  const std::vector<double> omega = typed_frequencies("--omega", words.omega);
  const std::vector<Place> places = typed_places("--at", words.at, craft);
  const spacecraft::Plant plant(craft);
  std::optional<spacecraft::ClosedLoop> loop;
  if (!words.craft.gains.empty()) loop.emplace(typed_loop(craft, words.craft.gains));
  std::vector<double> x;
  std::string text = "omega,theta_re,theta_im";
  for (const Place& p : places) {
    text += fmt::format(",y@{0}_re,y@{0}_im", p.text);
    x.push_back(p.x);
  }
  text += '\n';
  std::vector<Complex> y(x.size());
  for (const double w : omega) {
    const Complex s(0, w);
    Complex theta;
    Outcome outcome = Outcome::success;
    if (loop) {
      const spacecraft::LoopResponse r = loop->response(s);
      theta = r.theta;
      outcome = r.outcome;
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = loop->response(s, x[i]).deflection;
    } else {
      outcome = plant.response(s, x, theta, y);
    }
    if (outcome != Outcome::success) throw Failure(plant.status(outcome, s));
    text += fmt::format("{:.17g},{:.17g},{:.17g}", w, theta.real() + 0., theta.imag() + 0.);
    for (const Complex& value : y)
      text += fmt::format(",{:.17g},{:.17g}", value.real() + 0., value.imag() + 0.);
    text += '\n';
  }
  return text;
}

}  // namespace

void add_frequency_commands(scene::Commands& all) {
  all.add("poles",
          "Poles of theta/u, or with gains of the closed loop, as CSV: index,real,imag; those with imaginary "
          "part "
          "0 or more but not the double one at 0, by modulus, 1/s",
          declare_poles, poles);
  all.add("zeros",
          "Zeros of theta/u, or with --at of y/u there, as CSV: index,real,imag; those with imaginary part 0 "
          "or more, by modulus, 1/s; gains move none",
          declare_zeros, zeros);
  all.add("response",
          "theta/u and y/u at s = j omega, or with gains theta/theta_f and y/theta_f, as "
          "CSV: omega,theta_re,theta_im,y@X_re,y@X_im,...",
          declare_response, response);
}

}  // namespace nlmech::chapters::gss_control
