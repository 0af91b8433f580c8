# Drawings: machines, axes, flow charts.
#
#   gnuplot -e "data='results/homotopy/fig-2.4.csv'; heading='A toggle'; xrange='[-10:10]'; yrange='[-1:5]'; \
#       labels='W@0.5@3.5@ink'" figures/style.gp figures/templates/drawing.gp > out.svg
#
# Variables: data, heading, xrange, yrange (required; ranges as "[0:1]"); labels ("text@x@y@ink|...", `soft` in place of
# `ink` for secondary labels), letters (their size in points), head (length of an arrow's head in units of x, 0.25
# without), free (if it exists, x and y have scales of their own) (optional).
#
# Data: CSV with the header `kind,path,x,y,dx,dy`, a blank line after each path. Kinds: paths `member`, `outline`,
# `ground`, `thin`, `hatch`, `rest`; `body` a filled outline; `arrow`, `axis` and `force` from (x, y) by (dx, dy);
# `joint` a point.

unset border
unset tics
unset grid
unset key
set title heading
if (!exists("free")) {set size ratio -1}
eval "set xrange " . xrange
eval "set yrange " . yrange
set margins 0.5, 0.5, 0.5, 2.5
tip = exists("head") ? real(head) : 0.25
size_of_letters = exists("letters") ? int(letters) : font_size

if (exists("labels")) {
  do for [i = 1:entries(labels)] {
    item = entry(labels, i)
    words_of_item = field(item, 1)
    at_x = real(field(item, 2))
    at_y = real(field(item, 3))
    shade = field(item, 4) eq "soft" ? soft_ink : ink
    set label words_of_item at at_x, at_y center front textcolor rgb shade font sprintf("%s,%d", font_family, size_of_letters)
  }
}

of(name) = strcol("kind") eq name ? column("x") : NaN
plot data using (of("rest")):"y" with lines linestyle 11 linewidth 1.5, \
     data using (of("thin")):"y" with lines linestyle 13, \
     data using (of("hatch")):"y" with lines linestyle 13, \
     data using (of("axis")):"y":"dx":"dy" with vectors head filled size tip,18 linestyle 10, \
     data using (of("ground")):"y" with lines linestyle 10 linewidth 2.5, \
     data using (of("member")):"y" with lines linestyle 1 linewidth 3, \
     data using (of("body")):"y" with filledcurves closed fillcolor rgb pale, \
     data using (of("body")):"y" with lines linestyle 10, \
     data using (of("outline")):"y" with lines linestyle 10, \
     data using (of("arrow")):"y":"dx":"dy" with vectors head filled size tip,18 linestyle 13, \
     data using (of("force")):"y":"dx":"dy" with vectors head filled size 1.3*tip,18 linestyle 5 dashtype solid, \
     data using (of("joint")):"y" with points pointtype 7 pointsize 0.7 linecolor rgb ink
