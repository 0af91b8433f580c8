# Poincare sections of the oscillator (Filipich and Rosales, Fig. 6b).
#
#   gnuplot -e "data='results/algebraic_series/fig-6b.csv'" \
#       figures/style.gp figures/templates/algebraic_series-sections.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `x,v`.

if (!exists("heading")) heading = "Poincare sections"

set title heading
set xlabel "{/:Italic x}"
set ylabel "d{/:Italic x}/d{/:Italic t}​ (1/s)"
set xrange [-0.6:0.6]
set yrange [-0.4:0.4]
unset key
plot data using "x":"v" with points linestyle 1 pointsize 0.45
