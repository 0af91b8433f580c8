# Error of the fifth root of a function against the number of terms of its series.
#
#   gnuplot -e "data='results/algebraic_series/fractional-power.csv'" \
#       figures/style.gp figures/templates/algebraic_series-fractional-power.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `function,terms,error`, a blank line between functions: nearest zero at 2.24, 1.1, 1.01, 1.

if (!exists("heading")) heading = "Terms of a fifth root"

set title heading
set xlabel "terms"
set ylabel "error at ​{/:Italic t}​ = 1"
set logscale xy
set format y power_of_ten
set format x power_of_ten
set yrange [1e-40:1e2]
# Tics one by one: gnuplot 5.4 does not come back from steps of ten powers of ten.
set ytics (1)
set format y power_of_ten
do for [k = -40:0:10] {set ytics add (sprintf("10^{%d}", k) 10.0**k)}
set xrange [1:3000]
set key inside bottom left
plot data using "terms":"error" every :::3::3 with lines linestyle 5 title "f = 1 − t", \
     data using "terms":"error" every :::2::2 with lines linestyle 2 title "f = 1 − t/1.01", \
     data using "terms":"error" every :::1::1 with lines linestyle 4 title "f = 1 − t/1.1", \
     data using "terms":"error" every :::0::0 with lines linestyle 1 title "f = 1 + 0.3 t + 0.2 t^2"
