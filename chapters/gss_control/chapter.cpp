#include "chapters/gss_control/chapter.hpp"

#include "chapters/gss_control/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter gss_control_chapter() {
  scene::Chapter chapter("gss_control", "Exact transfer functions and control of a flexible spacecraft");
  add_drawings(chapter);
  add_parameters(chapter);
  add_frequency_figures(chapter);
  add_step_figures(chapter);
  add_closed_bode(chapter);
  add_manoeuvre_figures(chapter);
  add_natural_frequencies(chapter);
  add_accuracy(chapter);
  add_optimal_gains(chapter);
  add_delay_margin(chapter);
  add_lyapunov(chapter);
  add_energies(chapter);
  add_tracking(chapter);
  add_timoshenko(chapter);
  add_extremes(chapter);
  add_loop_extremes(chapter);
  add_error_vs_time_response(chapter);
  add_error_vs_time_step(chapter);
  return chapter;
}

void gss_control_work(CLI::App& app) {
  add_poles_command(app);
  add_zeros_command(app);
  add_response_command(app);
  add_step_command(app);
  add_optimal_gains_command(app);
}

}  // namespace nlmech::chapters
