# Van der Pol's oscillator: a converged run of fixed steps that is lost, beside one of chosen steps.
#
#   gnuplot -e "data='results/hermitian/wrong-branch.csv'" \
#       figures/style.gp figures/templates/hermitian-wrong-branch.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `run,t,x`; run is `right` or `wrong`.

if (!exists("heading")) heading = "A wrong branch"

set title heading
set xlabel "time (s)"
set ylabel "{/:Italic x}"
set xrange [0:200]
set bmargin 7
set key at screen 0.55, screen 0.02 center bottom maxrows 2
plot data using "t":(stringcolumn("run") eq "right" ? column("x") : NaN) with lines linestyle 1 linewidth 3 \
         title "Laier, steps chosen, tolerance 10^{-8}", \
     data using "t":(stringcolumn("run") eq "wrong" ? column("x") : NaN) with lines linestyle 5 dashtype 1 \
         title "Laier, fixed step of 0.0625 s, not checked"
