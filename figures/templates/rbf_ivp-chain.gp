# Three masses between two walls (Elgohary 2015, Fig. 4.30).
#
#   gnuplot -e "data='results/rbf_ivp/fig-4.30.csv'; height='330'" \
#       figures/style.gp figures/templates/rbf_ivp-chain.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `kind,x,y,path`, a blank line after each path; kind is `element`, `mass`, `wall` or `hatch`.
# Walls stand at x = 5 and 95; four elements of length 15, three masses of length 10. Springs lie at y = 3, dampers at -3.

if (!exists("heading")) heading = "A linear and a cubic spring and a damper on either side of each mass"

unset border
unset tics
unset grid
unset key
set title heading
set size ratio -1
set xrange [1:99]
set yrange [-15:17]
set margins 0.5, 0.5, 0.5, 2.5

do for [i = 1:4] {
  middle = 5 + 25*(i - 1) + 7.5
  set label sprintf("k_%d, l_%d", i, i) at middle, 7.4 center textcolor rgb ink
  set label sprintf("c_%d", i) at middle, -7.2 center textcolor rgb ink
}
do for [i = 1:3] {
  left = 20 + 25*(i - 1)
  set label sprintf("m_%d", i) at left + 5, 0 center front textcolor rgb ink
  set arrow from left + 5, 8.5 to left + 11, 8.5 head filled size 1.2,18 linestyle 10
  set arrow from left + 5, 7 to left + 5, 10 nohead linestyle 10
  set label sprintf("x_%d", i) at left + 8.5, 11.2 center textcolor rgb ink
}
set arrow from 43, -10 to 51, -10 head filled size 1.2,18 linestyle 5 dashtype solid
set label "{/:Italic F} cos Ω{/:Italic t} on m_2" at 52, -10 left textcolor rgb ink

of(name) = strcol("kind") eq name ? column("x") : NaN
plot data using (of("mass")):"y" with filledcurves closed fillcolor rgb pale, \
     data using (of("mass")):"y" with lines linestyle 10, \
     data using (of("element")):"y" with lines linestyle 10, \
     data using (of("hatch")):"y" with lines linestyle 13, \
     data using (of("wall")):"y" with lines linestyle 10 linewidth 2.5
