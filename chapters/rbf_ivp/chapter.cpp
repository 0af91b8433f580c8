#include "chapters/rbf_ivp/chapter.hpp"

#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters::rbf_ivp {

scene::Chapter rbf_ivp_chapter() {
  scene::Chapter chapter(
      "rbf_ivp",
      "Collocation in time by radial basis functions against the classical integrators (chapter 4)");
  add_drawings(chapter);
  add_parameter_tables(chapter);
  add_free_duffing(chapter);
  add_impact(chapter);
  add_three_masses(chapter);
  add_readings(chapter);
  add_mcpi_limit(chapter);
  add_kernels(chapter);
  add_fixed_step_more_nodes(chapter);
  add_conditioning(chapter);
  add_orders(chapter);
  add_instability_windows(chapter);
  add_stability(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  add_shape_study(chapter);
  add_contour(chapter);
  add_node_study(chapter);
  add_solver_study(chapter);
  add_chaos(chapter);
  add_ladder(chapter);
  add_held_back(chapter);
  return chapter;
}

}  // namespace nlmech::chapters::rbf_ivp
