# Error of series of Bessel functions about tau = 1.
#
#   gnuplot -e "data='results/algebraic_series/bessel.csv'" \
#       figures/style.gp figures/templates/algebraic_series-bessel.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `case,tau,error`, a blank line between cases: J_2 with 20 and 100 terms, J_0 with 20 and 100.

if (!exists("heading")) heading = "Bessel functions about tau = 1"

set title heading
set xlabel "{/:Italic τ}​ = ​{/:Italic x}/{/:Italic T}"
set ylabel "error"
set logscale y
set format y power_of_ten
set yrange [1e-70:1e5]
# Tics one by one: gnuplot 5.4 does not come back from steps of ten powers of ten.
set ytics (1)
set format y power_of_ten
do for [k = -70:0:10] {set ytics add (sprintf("10^{%d}", k) 10.0**k)}
set xrange [0:1]
set key at graph 0.34, 0.52 left top
plot data using "tau":"error" every :::2::2 with lines linestyle 5 title "J_0, T = 10, 20 terms", \
     data using "tau":"error" every :::0::0 with lines linestyle 2 title "J_2, T = 5, 20 terms", \
     data using "tau":"error" every :::3::3 with lines linestyle 1 title "J_0, T = 10, 100 terms", \
     data using "tau":"error" every :::1::1 with lines linestyle 4 title "J_2, T = 5, 100 terms"
