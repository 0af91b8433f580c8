# A driven Duffing oscillator by RK6 and MTL at three steps (Roy, Fig. 2).
#
#   gnuplot -e "data='results/transversal/fig-2.csv'; panels='h = 0.05|h = 0.1|h = 0.21'; height='620'" \
#       figures/style.gp figures/templates/transversal-histories.gp > out.svg
#
# Variables: data and panels (required: what stands beside the three panels, separated by |), heading (title; optional).
#
# Data: CSV with the header `series,t,x`, a blank line between series: for each panel the solution, RK6 and MTL.

if (!exists("heading")) heading = "Driven Duffing oscillator"

array name[3]
do for [i = 1:3] {name[i] = entry(panels, i)}

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set xrange [0:8]
set yrange [-3:3]
set ytics 1
set ylabel "{/:Italic x}"
do for [i = 1:3] {
  top = 0.90 - (i - 1)*0.27
  set margins screen 0.09, screen 0.98, screen top - 0.235, screen top
  set label 1 "{/:Italic h}​" . name[i][2:*] at graph 0.01, graph 0.08 left textcolor rgb ink
  if (i == 3) { set xlabel "time (periods of the force)"; set format x "%g" } else { unset xlabel; set format x "" }
  if (i == 1) { set key at screen 0.98, screen 0.945 right maxrows 1 samplen 3 } else { unset key }
  plot data using "t":"x" every :::(3*i - 3)::(3*i - 3) with lines linecolor rgb soft_ink linewidth 4 title "solution", \
       data using "t":"x" every :::(3*i - 2)::(3*i - 2) with linespoints linestyle 5 linewidth 1.3 pointsize 0.5 title "RK6", \
       data using "t":"x" every :::(3*i - 1)::(3*i - 1) with linespoints linestyle 1 linewidth 1.5 pointsize 0.45 title "MTL, ​{/:Italic p}​ = 3"
}
unset multiplot
