# Drawings of the spacecraft (Elgohary 2015, Figs. 3.1 and 3.2).
#
#   gnuplot -e "data='results/gss_control/fig-3.1.csv'; heading='A hub'; xrange='[-10:10]'; yrange='[-1:5]'" \
#       figures/style.gp figures/templates/gss_control-drawing.gp > out.svg
#
# Variables: data, heading, xrange, yrange (required; ranges as "[0:1]").
#
# Data: CSV with the header `kind,path,x,y,dx,dy,text`, a blank line after each path. Kinds: lines `member`, `rest` and
# `thin`; `body` a filled outline; `arrow`, `axis` and `force` from (x, y) by (dx, dy); `label` a text at (x, y).

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
plot data using (of("rest")):"y" with lines linestyle 11 linewidth 1.5, \
     data using (of("thin")):"y" with lines linestyle 13, \
     data using (of("axis")):"y":"dx":"dy" with vectors head filled size 0.22,18 linestyle 10, \
     data using (of("member")):"y" with lines linestyle 1 linewidth 3, \
     data using (of("body")):"y" with filledcurves closed fillcolor rgb pale, \
     data using (of("body")):"y" with lines linestyle 10 linewidth 2, \
     data using (of("arrow")):"y":"dx":"dy" with vectors head filled size 0.22,18 linestyle 13, \
     data using (of("force")):"y":"dx":"dy" with vectors head filled size 0.3,18 linestyle 5 dashtype solid, \
     data using (of("label")):"y":"text" with labels textcolor rgb ink
