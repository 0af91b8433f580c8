# The forced Duffing oscillator in time: the solution and the printed steps (Filipich and Rosales, Fig. 4a).
#
#   gnuplot -e "data='results/algebraic_series/fig-4a.csv'" \
#       figures/style.gp figures/templates/algebraic_series-duffing-time.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `tau,u,v,u_printed,v_printed`.

if (!exists("heading")) heading = "Forced Duffing oscillator in time"

set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set xrange [0:143]
set margins screen 0.12, screen 0.97, screen 0.46, screen 0.91
set format x ""
set ylabel "{/:Italic u}"
unset key
plot data using "tau":"u" with lines linestyle 1 linewidth 1.6
unset label
set margins screen 0.12, screen 0.97, screen 0.14, screen 0.40
set format x "%g"
set xlabel "{/:Italic τ}​ = ​{/:Italic t}/{/:Italic T}, ​{/:Italic T}​ = 0.35"
set ylabel "error of the printed steps"
set logscale y
set format y power_of_ten
set yrange [1e-9:10]
set ytics 1e2
plot data using "tau":(abs(column("u_printed") - column("u")) + 1e-12) with lines linestyle 5 dashtype solid linewidth 1.2
unset multiplot
