# Phase plane of the forced Duffing oscillator (Filipich and Rosales, Fig. 4b).
#
#   gnuplot -e "data='results/algebraic_series/fig-4b.csv'" \
#       figures/style.gp figures/templates/algebraic_series-duffing-phase.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `tau,u,v,u_printed,v_printed`.

if (!exists("heading")) heading = "Phase plane of the forced Duffing oscillator"

set title heading
set xlabel "{/:Italic u}"
set ylabel "d{/:Italic u}/d{/:Italic t}"
set xrange [-4:4]
set yrange [-7:7]
unset key
plot data using "u":"v" with lines linestyle 1 linewidth 1.2
