# Energy error against orbits for two ellipses.
#
#   gnuplot -e "data='results/two_body_series/drift.csv'; width=1000; height=500" \
#       figures/style.gp figures/templates/two_body_series-drift.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `line,e,method,orbits,energy_error,position_error`, a blank line between lines: six for
# e = 0.1 (reciprocals, reciprocals compensated, division, division compensated, adaptive 1e-15 and 1e-17), then five
# for e = 0.7 (the same without the first).

if (!exists("heading")) heading = "Drift of the energy"
set multiplot
set label 1 heading at screen 0.5, screen 0.96 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set logscale xy
set xrange [8:12500]
set xtics ("10" 10, "100" 100, "1000" 1000, "10 000" 10000)
set yrange [2e-16:1e-10]
set ytics ("10^{−15}" 1e-15, "10^{−14}" 1e-14, "10^{−13}" 1e-13, "10^{−12}" 1e-12, "10^{−11}" 1e-11, "10^{−10}" 1e-10)
set xlabel "orbits"
small = sprintf("%s,%d", font_family, font_size - 3)
set key inside top left font small spacing 1.15
array name[6] = ["rounded reciprocals", "rounded reciprocals, compensated", "division", "division, compensated", \
                 "adaptive, tolerance 10^{−15}", "adaptive, tolerance 10^{−17}"]
array style_of[6] = [5, 2, 3, 1, 7, 4]
array panel_left[2] = [0.095, 0.57]
array panel_e[2] = ["e = 0.1", "e = 0.7"]
do for [panel = 1:2] {
  first = panel == 1 ? 1 : 2
  offset = panel == 1 ? -1 : 4
  set margins screen panel_left[panel], screen panel_left[panel] + 0.365, screen 0.135, screen 0.87
  set label 2 panel_e[panel] at graph 0.98, graph 0.06 right font sprintf("%s:Bold,%d", font_family, font_size)
  if (panel == 1) {set ylabel "energy error |E/E_0 − 1|" offset 0,0} else {unset ylabel}
  set label 3 "t" at 12500, 7.5e-13 left offset 0.3,0 font small textcolor rgb soft_ink
  set label 4 "t^{1/2}" at 12500, 1.68e-14 left offset 0.3,0 font small textcolor rgb soft_ink
  plot for [k = first:6] data using "orbits":"energy_error" every :::k + offset::k + offset with linespoints \
         linestyle style_of[k] title name[k], \
       1.5e-15*sqrt(x/100) with lines linestyle 13 notitle, \
       6e-15*(x/100) with lines linestyle 13 notitle
  unset label 1
}
unset multiplot
