# An oscillator with modulated nonlinear damping: series and forward Euler (Filipich and Rosales, Fig. 5).
#
#   gnuplot -e "data='results/algebraic_series/fig-5.csv'" \
#       figures/style.gp figures/templates/algebraic_series-oscillator-time.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t_s,series,euler`.

if (!exists("heading")) heading = "Series and forward Euler"

set title heading offset 0,1.4
set xlabel "{/:Italic t}​ (s)"
set ylabel "{/:Italic x}"
set xrange [3:43.2]
set yrange [-0.8:0.8]
set margins screen 0.11, screen 0.97, screen 0.13, screen 0.83
set key at screen 0.535, screen 0.905 center top horizontal maxrows 1 Left reverse samplen 3
plot data using "t_s":"euler" with lines linestyle 2 dashtype solid linewidth 1.8 title "forward Euler, h = 0.01 s", \
     data using "t_s":"series" with lines linestyle 1 linewidth 1.8 title "series, T = 0.125 s, N = 50"
