# Drawings of the toggle and of its member (Elgohary 2015, Figs. 2.4, 2.5 and 2.12).
#
#   gnuplot -e "data='results/homotopy/fig-2.4.csv'; heading='A toggle'; xrange='[-10:10]'; yrange='[-1:5]'" \
#       figures/style.gp figures/templates/homotopy-drawing.gp > out.svg
#
# Variables: data, heading, xrange, yrange (required; ranges as "[0:1]").
#
# Data: CSV with the header `kind,path,x,y,dx,dy,text`, a blank line after each path. Kinds: lines `member`, `rest`,
# `thin`, `hatch`; `arrow` and `force` from (x, y) by (dx, dy); `joint` a point; `label` a text at (x, y).

unset border
unset tics
unset grid
unset key
set title heading
set size ratio -1
eval "set xrange " . xrange
eval "set yrange " . yrange
set margins 0.5, 0.5, 0.5, 2.5

of(name) = strcol("kind") eq name ? column("x") : NaN
plot data using (of("thin")):"y" with lines linestyle 13, \
     data using (of("hatch")):"y" with lines linestyle 13, \
     data using (of("rest")):"y" with lines linestyle 11 linewidth 1.5, \
     data using (of("member")):"y" with lines linestyle 10 linewidth 2.8, \
     data using (of("arrow")):"y":"dx":"dy" with vectors head filled size 0.25,18 linestyle 10, \
     data using (of("force")):"y":"dx":"dy" with vectors head filled size 0.35,18 linestyle 5 dashtype solid, \
     data using (of("joint")):"y" with points pointtype 7 pointsize 0.7 linecolor rgb ink, \
     data using (of("label")):"y":"text" with labels textcolor rgb ink
