# The concept of transversal linearisation, p = 4 (Roy, Fig. 1): a sketch of the paths, and below it a computed defect.
#
#   gnuplot -e "data='results/transversal/fig-1.csv'; height='520'" \
#       figures/style.gp figures/templates/transversal-drawing.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `series,t,y`, a blank line between series: true path, linearised path, points, and what the
# linearised path of a computed block fails the equation by, times 1000; t in steps.

if (!exists("heading")) heading = "Transversal linearisation"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set xrange [-0.25:4.25]
set margins screen 0.11, screen 0.97, screen 0.44, screen 0.90
unset grid
set border 3
unset ytics
set xtics ("" 0, "" 1, "" 2, "" 3, "" 4)
set ylabel "{/:Italic x}, sketched"
set yrange [0.2:3.2]
set for [k = 0:4] arrow from first k, graph 0 to first k, graph 1 nohead linestyle 11
set key top left
plot data using "t":"y" every :::0::0 with lines linestyle 1 linewidth 2.5 title "true path", \
     data using "t":"y" every :::1::1 with lines linestyle 2 linewidth 2 title "linearised path, its distance enlarged", \
     data using "t":"y" every :::2::2 with points pointtype 7 pointsize 1.1 linecolor rgb ink title "points ​{/:Italic X}_{/:Italic k}"
set margins screen 0.11, screen 0.97, screen 0.14, screen 0.38
set ylabel "defect × 10^3"
set ytics 2 nomirror
set xtics ("{/:Italic t}_0" 0, "{/:Italic t}_1" 1, "{/:Italic t}_2" 2, "{/:Italic t}_3" 3, "{/:Italic t}_4" 4)
set yrange [*:*]
set xlabel "time, ​{/:Italic h}​ = 0.4"
unset key
set grid ytics linestyle 12
plot data using "t":"y" every :::3::3 with lines linestyle 5 dashtype solid, 0 with lines linestyle 13
unset multiplot
