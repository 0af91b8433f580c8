# Phase plane of the oscillator with modulated nonlinear damping (Filipich and Rosales, Fig. 6a).
#
#   gnuplot -e "data='results/algebraic_series/fig-6a.csv'" \
#       figures/style.gp figures/templates/algebraic_series-oscillator-phase.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `x,v`.

if (!exists("heading")) heading = "Phase plane"

set title heading
set xlabel "{/:Italic x}"
set ylabel "d{/:Italic x}/d{/:Italic t}​ (1/s)"
set xrange [-0.6:0.6]
set yrange [-0.4:0.4]
unset key
plot data using "x":"v" with lines linestyle 1 linewidth 0.8
