# The recursion for the derivatives of an orbit as a flow chart (Elgohary 2015, Fig. 3.21).
#
#   gnuplot -e "data='results/two_body_series/fig-3.21.csv'" \
#       figures/style.gp figures/templates/two_body_series-algorithm.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `kind,x,y,dx,dy` on a page of 100 by 100. `box`: centre and half sides; `line` and `arrow`:
# begin and the way from there. The texts stand below, where the boxes are.

if (!exists("heading")) heading = "Analytic continuation: every derivative follows from the ones before"

unset border
unset tics
unset grid
unset key
set title heading
set xrange [0:100]
set yrange [0:100]
set margins 0.5, 0.5, 0.5, 2.5

text(t, x, y) = sprintf("set label \"%s\" at %g,%g center front textcolor rgb ink font \"%s,12\"", t, x, y, font_family)
eval text(bold("given"), 23, 92.6)
eval text("r, r' at {/:Italic t}_0; μ", 23, 88)
eval text("order {/:Italic K}, step {/:Italic h}", 23, 83.6)
eval text(bold("begin of a step"), 23, 64.4)
eval text("r^{(0)} = r,  r^{(1)} = r',  {/:Italic n} = 0", 23, 59.6)
eval text(bold("f = r·r") . "  (3.62)", 73, 91)
eval text("{/:Italic f}^{(n)} = Σ C({/:Italic n}, {/:Italic m}) r^{(m)}·r^{(n−m)},  {/:Italic m} = 0, …, {/:Italic n}", 73, 85.4)
eval text(bold("g = f^{−p/2}, p = 3") . "  (3.66)", 73, 70.6)
eval text("{/:Italic g}^{(n)} = −[({/:Italic p}/2) {/:Italic f} '{/:Italic g}^{(n−1)} + Σ C({/:Italic n}−1, {/:Italic m}) (({/:Italic p}/2) {/:Italic f}^{(m+1)}{/:Italic g}^{(n−1−m)}", 73, 65.4)
eval text("+ {/:Italic f}^{(m)}{/:Italic g}^{(n−m)})]/{/:Italic f},  {/:Italic m} = 1, …, {/:Italic n}−1", 73, 60.8)
eval text(bold("r'' = −μ g_3 r") . "  (3.68)", 73, 47)
eval text("r^{(n+2)} = −μ Σ C({/:Italic n}, {/:Italic m}) r^{(m)}{/:Italic g}^{(n−m)}", 73, 41.4)
eval text("{/:Italic n} + 2 = {/:Italic K}?", 73, 17)
eval text(bold("end of the step"), 23, 23.4)
eval text("r ← Σ r^{(k)} {/:Italic h^k}/{/:Italic k}!,  {/:Italic k} ≤ {/:Italic K}", 23, 18)
eval text("r' ← Σ r^{(k+1)} {/:Italic h^k}/{/:Italic k}!,  {/:Italic k} < {/:Italic K}", 23, 12)
set label "yes" at 49, 20 center textcolor rgb soft_ink
set label "no" at 94.5, 20 center textcolor rgb soft_ink
set label "next step" at 24.5, 40 left textcolor rgb soft_ink
set label "{/:Italic n} ← {/:Italic n} + 1" at 100, 30 right textcolor rgb soft_ink offset -1.2,0

of(name) = strcol("kind") eq name ? column("x") : NaN
plot data using (of("box")):"y":"dx":"dy" with boxxyerror fillcolor rgb pale linecolor rgb ink, \
     data using (of("box")):"y":"dx":"dy" with boxxyerror linestyle 10 fillstyle empty, \
     data using (of("line")):"y":"dx":"dy" with vectors nohead linestyle 10, \
     data using (of("arrow")):"y":"dx":"dy" with vectors head filled size 1.5,18 linestyle 10
