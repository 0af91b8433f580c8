# Errors of printed and computed peaks against the step, three pairs of operators.
#
#   gnuplot -e "data='results/hermitian/table-4.csv'" \
#       figures/style.gp figures/templates/hermitian-peaks.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `column,step,printed,ours`: errors against the exact peak, three rows a column of the table,
# in the order Laier, Argyris, Newmark.

if (!exists("heading")) heading = "Errors of the first peak"

set title heading
set xlabel "step (s)"
set ylabel "error of the first peak"
set logscale xy
set xrange [0.045:0.22]
set xtics (0.05, 0.1, 0.2)
set yrange [1e-10:1]
set ytics 100
set mytics 1
set format y power_of_ten
set bmargin 8.5
set key at screen 0.55, screen 0.02 center bottom horizontal maxrows 2 width 2
array name[3] = ["Laier", "Argyris", "Newmark"]
array colour_of[3] = [1, 5, 3]
plot for [k = 1:3] data using "step":"printed" every ::(3*(k - 1))::(3*k - 1) with linespoints linestyle colour_of[k] \
         dashtype 3 title name[k] . ", printed", \
     for [k = 1:3] data using "step":"ours" every ::(3*(k - 1))::(3*k - 1) with linespoints linestyle colour_of[k] \
         dashtype 1 title name[k] . ", ours"
