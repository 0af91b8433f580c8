# Attractor of the Lorenz system: the solution, and what the printed steps make of it (Filipich and Rosales, Fig. 3b).
#
#   gnuplot -e "data='results/algebraic_series/fig-3b.csv'; width=900" \
#       figures/style.gp figures/templates/algebraic_series-lorenz-phase.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t,u,v,w,u_printed,v_printed,w_printed`.

if (!exists("heading")) heading = "Attractor of the Lorenz system"

set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set xrange [-20:22]
set yrange [0:50]
set xlabel "{/:Italic u}"
unset key
array panel_left[2] = [0.075, 0.55]
array title_of[2] = ["solution", "T = 0.1, N = 20, as printed"]
do for [panel = 1:2] {
  set margins screen panel_left[panel], screen panel_left[panel] + 0.42, screen 0.14, screen 0.86
  if (panel == 1) {set ylabel "{/:Italic w}"} else {unset ylabel}
  set title title_of[panel] font sprintf("%s,%d", font_family, font_size)
  if (panel == 1) {
    plot data using "u":"w" with lines linestyle 1 linewidth 1.2
    unset label
  } else {
    plot data using "u_printed":"w_printed" with lines linestyle 5 dashtype solid linewidth 1.2
  }
}
unset multiplot
