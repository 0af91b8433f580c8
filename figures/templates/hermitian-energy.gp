# Greatest relative energy error in stretches of time, three pairs of operators.
#
#   gnuplot -e "data='results/hermitian/energy.csv'" \
#       figures/style.gp figures/templates/hermitian-energy.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t,laier,argyris,newmark`: middle of each stretch and greatest |E/E_0 - 1| within it.

if (!exists("heading")) heading = "Energy error"

set title heading
set xlabel "time (s)"
set ylabel "greatest |{/:Italic E}/{/:Italic E}_0 − 1| in 5 s"
set logscale y
set yrange [1e-5:1]
set ytics 10
set format y power_of_ten
set key inside top right
plot data using "t":"newmark" with lines linestyle 3 dashtype 1 title "Newmark, Hoff, Bazzi", \
     data using "t":"laier" with lines linestyle 1 title "Laier", \
     data using "t":"argyris" with lines linestyle 5 title "Argyris"
