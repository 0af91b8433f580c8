# A periodic cycle, sections of a chaotic motion, and how errors grow in both.
#
#   gnuplot -e "data='results/transversal/chaos.csv'; width='1000'; height='420'" \
#       figures/style.gp figures/templates/transversal-chaos.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `series,x,v`, a blank line between series: the cycle and the sections as position and velocity,
# then for the periodic and the chaotic regime time and error.

if (!exists("heading")) heading = "Two regimes"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
unset key
set margins screen 0.065, screen 0.32, screen 0.19, screen 0.82
set title "periodic: a cycle" font sprintf("%s,%d", font_family, font_size)
set xlabel "{/:Italic x}"
set ylabel "{/:Italic v}" offset 1,0
set xtics 0.5
set xrange [-1.2:1.2]
plot data using "x":"v" every :::0::0 with lines linestyle 1 linewidth 2.2
set margins screen 0.395, screen 0.65, screen 0.19, screen 0.82
set title "chaotic: sections once a period"
set xrange [1:4]
set yrange [-6:8]
set ytics 2
plot data using "x":"v" every :::1::1 with points pointtype 7 pointsize 0.14 linecolor rgb colour(5)
set margins screen 0.735, screen 0.985, screen 0.19, screen 0.82
set title "errors, ​{/:Italic p}​ = 3, ​{/:Italic h}​ = 0.02"
set xlabel "time"
set ylabel "greatest error in a unit of time" offset 1,0
set logscale y
set xrange [0:200]
set xtics 50
set yrange [1e-8:10]
set ytics 100
set mytics 1
set format y power_of_ten
set key at graph 0.98, graph 0.22 right samplen 2
plot data using "x":"v" every :::2::2 with lines linestyle 1 title "periodic", \
     data using "x":"v" every :::3::3 with lines linestyle 5 dashtype solid title "chaotic"
unset multiplot
