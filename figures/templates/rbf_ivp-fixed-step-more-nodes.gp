# Error against the number of nodes at a fixed step: radial functions, and polynomials at the same and other nodes.
#
#   gnuplot -e "data='results/rbf_ivp/fixed-step-more-nodes.csv'" \
#       figures/style.gp figures/templates/rbf_ivp-fixed-step-more-nodes.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `problem,nodes,rbf,lgl,radau`; problem is duffing or three-masses, the others are errors.
# An empty cell: a step was not solved.

if (!exists("heading")) heading = "Error against the number of nodes"

of(name) = strcol("problem") eq name ? column("nodes") : NaN

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale y
set yrange [1e-15:1]
set ytics 1000
set mytics 1
set format y power_of_ten
set xlabel "nodes in a step"
set xrange [5:85]
set xtics 20

set margins screen 0.135, screen 0.53, screen 0.13, screen 0.80
set title "free Duffing, step P" font sprintf("%s,%d", font_family, font_size) offset 0,-0.4
set ylabel "RMS error of ​{/:Italic x}_1"
set key at screen 0.53, screen 0.925 center top maxrows 1 Left reverse samplen 3
plot data using (of("duffing")):"rbf" with linespoints linestyle 5 title "RBF, ​{/:Italic c = }({/:Italic N − }1)/(4{/:Italic h})", \
     data using (of("duffing")):"lgl" with linespoints linestyle 1 title "polynomials, LGL", \
     data using (of("duffing")):"radau" with linespoints linestyle 4 title "polynomials, Radau"

unset key
unset ylabel
set format y ""
set xrange [5:65]
set margins screen 0.575, screen 0.97, screen 0.13, screen 0.80
set title "three masses, step 20 s"
plot data using (of("three-masses")):"rbf" with linespoints linestyle 5, \
     data using (of("three-masses")):"lgl" with linespoints linestyle 1, \
     data using (of("three-masses")):"radau" with linespoints linestyle 4
unset multiplot
