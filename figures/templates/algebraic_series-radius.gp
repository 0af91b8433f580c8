# Radius of convergence along three solutions, and the printed steps.
#
#   gnuplot -e "data='results/algebraic_series/radius.csv'; height=640" \
#       figures/style.gp figures/templates/algebraic_series-radius.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `problem,share,radius,printed_step`, a blank line between problems: lorenz, duffing,
# oscillator.

if (!exists("heading")) heading = "Radius of convergence"

set multiplot
set label heading at screen 0.5, screen 0.97 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
array name[3] = ["Lorenz, t to 20", "forced Duffing, t to 50", "oscillator, 375 s"]
array largest[3] = [0.6, 2, 6]
array step_of[3] = [0.2, 0.5, 2]
array printed[3] = ["T = 0.1", "T = 0.35", "T = 0.125"]
set xrange [0:1]
unset key
do for [k = 1:3] {
  top = 0.93 - 0.285*(k - 1)
  set margins screen 0.12, screen 0.97, screen top - 0.23, screen top
  set yrange [0:largest[k]]
  set ytics step_of[k]
  if (k == 3) {set format x "%g"; set xlabel "share of the way"} else {set format x ""}
  set ylabel "radius"
  set label 2 name[k] at graph 0.98, graph 0.9 right font sprintf("%s:Bold,%d", font_family, font_size - 1)
  plot data using "share":"radius" every :::k - 1::k - 1 with lines linestyle 1 linewidth 1.2, \
       data using "share":"printed_step" every :::k - 1::k - 1 with lines linestyle 5 dashtype 2 linewidth 1.8
  unset label
}
unset multiplot
