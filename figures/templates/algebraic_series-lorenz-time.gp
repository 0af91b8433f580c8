# v of the Lorenz system in time: the solution and the printed steps (Filipich and Rosales, Fig. 3a).
#
#   gnuplot -e "data='results/algebraic_series/fig-3a.csv'" \
#       figures/style.gp figures/templates/algebraic_series-lorenz-time.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t,u,v,w,u_printed,v_printed,w_printed`.

if (!exists("heading")) heading = "Lorenz system in time"

set title heading offset 0,1.4
set xrange [0:20]
set yrange [-30:30]
set xlabel "{/:Italic t}"
set ylabel "{/:Italic v}"
set margins screen 0.1, screen 0.97, screen 0.13, screen 0.83
set key at screen 0.535, screen 0.905 center top horizontal maxrows 1 Left reverse samplen 3
plot data using "t":"v_printed" with lines linestyle 2 dashtype solid linewidth 1.6 title "T = 0.1, N = 20, as printed", \
     data using "t":"v" with lines linestyle 1 linewidth 1.6 title "solution"
