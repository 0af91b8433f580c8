# Modified Chebyshev-Picard iteration as a flow chart (Elgohary 2015, Fig. 4.1).
#
#   gnuplot -e "data='results/rbf_ivp/fig-4.1.csv'" figures/style.gp figures/templates/rbf_ivp-flow-chart.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `kind,x,y,dx,dy` on a page of 100 by 100. `box`: centre and half sides; `line` and `arrow`:
# begin and the way from there. The texts stand below, where the boxes are.

if (!exists("heading")) heading = "MCPI: expand the right-hand side, integrate term by term, repeat"

unset border
unset tics
unset grid
unset key
set title heading
set xrange [0:100]
set yrange [0:100]
set margins 0.5, 0.5, 0.5, 2.5

text(t, x, y) = sprintf("set label \"%s\" at %g,%g center front textcolor rgb ink font \"%s,12\"", t, x, y, font_family)
eval text(bold("given"), 22, 93.6)
eval text("state x_0 at t_0, step {/:Italic h},", 22, 89.6)
eval text("order {/:Italic N}, nodes 0, …, {/:Italic M} ≥ {/:Italic N}", 22, 85.4)
eval text(bold("nodes"), 22, 71.6)
eval text("τ_j = −cos({/:Italic jπ}/{/:Italic M})", 22, 67.6)
eval text("{/:Italic t_j} = {/:Italic t}_0 + {/:Italic h} (1 + τ_j)/2", 22, 63.6)
eval text(bold("start"), 22, 46)
eval text("x_j = x_0 at all nodes", 22, 41.6)
eval text(bold("end of the step"), 22, 13)
eval text("x({/:Italic t}_0 + {/:Italic h}) = x_M", 22, 8.6)
eval text(bold("right-hand sides"), 72, 92)
eval text("g_j = ({/:Italic h}/2) f({/:Italic t_j}, x_j)", 72, 87.6)
eval text(bold("expand") . " up to the degree {/:Italic N} − 1", 72, 73)
eval text("F_k = (2/{/:Italic M}) Σ'' g_j {/:Italic T}_k(τ_j)", 72, 68.6)
eval text(bold("integrate") . " term by term", 72, 54)
eval text("β_r = (F_{r − 1} − F_{r + 1})/(2{/:Italic r}), β_0 from x_0", 72, 49.6)
eval text(bold("evaluate"), 72, 35)
eval text("x_j = Σ β_r {/:Italic T}_r(τ_j)", 72, 30.6)
eval text("do all x_j", 72, 13)
eval text("stand still?", 72, 9)
set label "yes" at 48, 13.5 center textcolor rgb soft_ink
set label "no" at 93, 13.5 center textcolor rgb soft_ink
set label "next step" at 23.5, 27 left textcolor rgb soft_ink
set label "repeat" at 99.2, 50 center rotate by 90 textcolor rgb soft_ink

of(name) = strcol("kind") eq name ? column("x") : NaN
plot data using (of("box")):"y":"dx":"dy" with boxxyerror fillcolor rgb pale linecolor rgb ink, \
     data using (of("box")):"y":"dx":"dy" with boxxyerror linestyle 10 fillstyle empty, \
     data using (of("line")):"y":"dx":"dy" with vectors nohead linestyle 10, \
     data using (of("arrow")):"y":"dx":"dy" with vectors head filled size 1.5,18 linestyle 10
