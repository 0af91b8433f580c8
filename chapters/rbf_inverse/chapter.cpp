#include "chapters/rbf_inverse/chapter.hpp"

#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter rbf_inverse_chapter() {
  scene::Chapter chapter("rbf_inverse", "Conditions at both ends: optimal control and Lambert's problem");
  // Sections 5.1 to 5.3: optimal control.
  const DuffingRuns runs = add_duffing_runs(chapter);
  add_end_conditions(chapter);
  add_duffing_parameters(chapter);
  add_duffing_histories(chapter, runs);
  add_from_guesses(chapter, runs);
  add_boundary_errors(chapter, runs);
  add_extremals(chapter, runs);
  add_basin(chapter);
  add_shooting(chapter);
  add_shape_study(chapter, runs);
  add_bounded_control(chapter, runs);
  add_interior_point(chapter, runs);
  add_continuation(chapter, runs);
  add_scalar_homotopy(chapter);
  add_control_extremes(chapter);
  add_error_vs_time_control(chapter);
  // Section 5.4: Lambert's problem.
  add_transfer(chapter);
  add_guesses(chapter);
  add_shape_study_lambert(chapter);
  add_porkchop(chapter);
  add_lambert_extremes(chapter);
  add_error_vs_time_lambert(chapter);
  return chapter;
}

void rbf_inverse_work(CLI::App& app) {
  add_duffing_command(app);
  add_lambert_commands(app);
}

}  // namespace nlmech::chapters
