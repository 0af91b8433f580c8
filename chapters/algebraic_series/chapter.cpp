#include "chapters/algebraic_series/chapter.hpp"

#include "chapters/algebraic_series/scenes.hpp"

namespace nlmech::chapters {

scene::Chapter algebraic_series_chapter() {
  scene::Chapter chapter("algebraic_series",
                         "Nonlinear differential systems by power series in time (Filipich and Rosales)");
  add_projectile(chapter);
  add_bodies(chapter);
  add_lorenz(chapter);
  add_forced_duffing(chapter);
  add_oscillator(chapter);
  add_poincare(chapter);
  add_radius(chapter);
  add_bessel(chapter);
  add_fractional_power(chapter);
  add_divergence(chapter);
  add_extremes(chapter);
  add_error_vs_time(chapter);
  return chapter;
}

}  // namespace nlmech::chapters
