#include "chapters/rbf_ivp/chapter.hpp"

#include "chapters/rbf_ivp/scenes.hpp"

namespace nlmech::chapters::rbf_ivp {

scene::Chapter rbf_ivp_chapter() {
  scene::Chapter chapter(
      "rbf_ivp",
      "Collocation in time by radial basis functions against the classical integrators (chapter 4)");
  const auto add = [&](std::vector<scene::Scene> scenes) {
    for (scene::Scene& one : scenes) chapter.add(std::move(one));
  };
  add_drawings(chapter);
  add_parameter_tables(chapter);
  add_free_duffing(chapter);
  add_impact(chapter);
  add_three_masses(chapter);
  add_readings(chapter);
  add(mcpi_limit());
  add(kernels());
  add(fixed_step_more_nodes());
  add(conditioning());
  add(orders());
  add(instability_windows());
  add(stability());
  add(extremes());
  add_error_vs_time(chapter);
  add(shape_study());
  add(contour());
  add(node_study());
  add(solver_study());
  add_chaos(chapter);
  add_ladder(chapter);
  add_held_back(chapter);
  return chapter;
}

}  // namespace nlmech::chapters::rbf_ivp
