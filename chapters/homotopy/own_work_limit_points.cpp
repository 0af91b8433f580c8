#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chapters/homotopy/scenes.hpp"
#include "nlmech/algebraic/path.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/scene/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

/// What was typed.
struct Words {
  std::string height, model = "element", elements = "1";
};

/// The toggle under a growing load: half of it, or Williams' equation.
struct GrowingLoad {
  std::optional<frames::ToggleFrame> toggle;
  std::unique_ptr<algebraic::Loaded> equations;
  Eigen::Index apex = 0;
  double sign = 1;  ///< of the drop

  [[nodiscard]] double drop(const algebraic::PathPoint& point) const { return sign * point.x[apex]; }
};

void fill(GrowingLoad& all, const Words& words, double height) {
  const int elements = scene::typed_whole("--elements", words.elements, 1, 10'000);
  if (words.model == "williams") {
    if (elements != 1)
      throw InputError(
          fmt::format("--elements {}: Williams' equation has none; use --model element", words.elements));
    static_cast<void>(frames::make_frame({.height = height}));  // refuses what is no toggle
    all.equations = std::make_unique<frames::LoadedWilliams>(frames::Williams{.height = height});
  } else if (words.model == "element") {
    all.toggle.emplace(frames::make_frame({.height = height, .elements = static_cast<int>(elements)}));
    all.equations = std::make_unique<frames::LoadedFrame>(all.toggle->frame, all.toggle->load);
    all.apex = all.toggle->apex;
    all.sign = -1;
  } else {
    throw InputError(fmt::format("--model {}: there are element and williams", words.model));
  }
}

//! [trace of the toggle]
/// Follows the path from rest until the toggle hangs below its bases and its load rises again.
std::vector<algebraic::PathPoint> limit_points_of(GrowingLoad& all, double height) {
  // The first step drops the apex by about a twentieth of the height.
  const double first = 0.05 * height * frames::Williams{.height = height}.stiffness(0.);
  algebraic::Path path({.first = first}, *all.equations, Eigen::VectorXd::Zero(all.equations->size()), 0);
  std::vector<algebraic::PathPoint> found, here;
  Status status = path.start();
  constexpr int most = 5000;
  for (int k = 0; status.ok() && (all.drop(path.now()) < 2.2 * height || path.now().slope <= 0); ++k) {
    if (k == most)
      status = Status::failure(
          Outcome::step_limit,
          fmt::format("limit-points: after {} steps of the path the apex has dropped by {:.6g} "
                      "and the toggle is not through; take a lower height",
                      most, all.drop(path.now())));
    if (status.ok()) status = path.advance();
    // The straight branch of a buckled member is an equilibrium that no toggle would take.
    if (status.ok()) status = all.equations->status();
    if (!status.ok()) break;
    if (path.folds(here) != Outcome::success) {
      status = Status::failure(
          Outcome::not_converged,
          fmt::format("limit-points: none is found between the drops {:.6g} and {:.6g}, where "
                      "one was passed; take another number of elements",
                      all.drop(path.before()), all.drop(path.now())));
    }
    found.insert(found.end(), here.begin(), here.end());
  }
  if (!status.ok()) throw Failure(status);
  return found;
}
//! [trace of the toggle]

void limit_points(const Words& words) {
  const double height = scene::typed_number("--height", words.height);
  GrowingLoad all;
  try {
    fill(all, words, height);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--height {}: {}", words.height, error.what()));
  }
  const std::vector<algebraic::PathPoint> found = limit_points_of(all, height);
  std::string text = "kind,load,deflection\n";
  // Rising before a maximum, falling after it; so maxima and minima take turns.
  for (std::size_t i = 0; i < found.size(); ++i)
    text += fmt::format("{},{:.12g},{:.12g}\n", i % 2 == 0 ? "maximum" : "minimum", found[i].load,
                        all.drop(found[i]));
  scene::print_result(text);
}

}  // namespace

void add_limit_points_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* const command = app.add_subcommand("limit-points",
                                               "Limit points of a toggle on the path from rest, as CSV: "
                                               "kind,load,deflection; only the head if there are "
                                               "none. Members, inch and pound as in Table 2.1");
  command->add_option("--height", words->height, "of the apex over the bases, inch")->required();
  command->add_option("--model", words->model, "element, or williams for Eq. 2.21")->capture_default_str();
  command->add_option("--elements", words->elements, "beam-columns a member")->capture_default_str();
  command->callback([words] { limit_points(*words); });
}

}  // namespace nlmech::chapters
