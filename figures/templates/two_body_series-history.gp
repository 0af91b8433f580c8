# Relative energy error over twenty orbits (Elgohary 2015, Figs. 3.22 and 3.23).
#
#   gnuplot -e "data='results/two_body_series/fig-3.22.csv'" \
#       figures/style.gp figures/templates/two_body_series-history.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `curve,orbit,error`, blank lines between curves: 1 ode45, 2 Analytic-Cont, 3 F&G, 4 RKN12(10).
# Errors of exactly 0 have no logarithm: they are drawn on a line of their own below the least double.

if (!exists("heading")) heading = "Relative error of the energy"

nothing = 2e-17
set title heading offset 0,1.4
set margins screen 0.13, screen 0.97, screen 0.13, screen 0.83
set xlabel "orbits"
set ylabel offset 1,0 "|{/:Italic E}_k − ​{/:Italic E}_0|/|{/:Italic E}_0|"
set xrange [0:20]
set logscale y
set format y power_of_ten
stats data using (column("error") > 0 ? log10(column("error")) : NaN) nooutput
set yrange [1e-17:10.0**(ceil(STATS_max))]
set ytics (1)
do for [k = -16:0:2] {set ytics add (sprintf("10^{%d}", k) 10.0**k)}
set ytics add ("0" nothing)
set key at screen 0.545, screen 0.9 center top horizontal maxrows 1 Left reverse samplen 2.5 width -4

of(i) = column("curve") == i ? column("orbit") : NaN
shown(e) = e > 0 ? e : nothing
plot data using (of(1)):(shown(column("error"))) with lines linestyle 5 dashtype solid linewidth 1.6 title "ode45", \
     data using (of(2)):(shown(column("error"))) with lines linestyle 1 linewidth 1.6 title "Analytic-Cont", \
     data using (of(3)):(shown(column("error"))) with points linestyle 4 pointtype 7 pointsize 0.28 title "F and G", \
     data using (of(4)):(shown(column("error"))) with points linestyle 2 pointtype 5 pointsize 0.28 title "RKN12(10)"
