# How far the energy errors of Analytic-Cont are from print, against steps an orbit, for several readings of "order".
#
#   gnuplot -e "data='results/two_body_series/reading-study.csv'; low='(10, 9)|(9, 8)'; high='(30, 29)'" \
#       figures/style.gp figures/templates/two_body_series-readings.gp > out.svg
#
# Variables: data, low and high (labels of the curves of either orbit, separated by |), heading (title; optional).
#
# Data: CSV with the header `curve,steps,distance`, blank lines between curves `LEO 1`, `LEO 2`, ..., `HEO 1`, ...: the
# largest of ours/printed and printed/ours over 5, 10 and 20 orbits, less 1.

if (!exists("heading")) heading = "Distance of the energy errors from print"

# The labels between the bars.
set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale y
set format y power_of_ten
set xlabel "steps an orbit"
set key at graph 0.5, graph 1.01 center bottom horizontal maxrows 3 Left reverse samplen 3 width -1
within(x) = 0.1

set margins screen 0.12, screen 0.52, screen 0.13, screen 0.74
set label 1 "LEO, printed with 25 steps" at graph 0.04, graph 0.07 textcolor rgb soft_ink
set label 2 "10 %" at graph 0.97, first 0.14 right textcolor rgb soft_ink
set ylabel offset 1,0 "max(ours/printed, printed/ours) − 1"
set xrange [18.8:25.2]
set yrange [1e-2:1e4]
low_of(i) = strcol("curve") eq sprintf("LEO %d", i) ? column("steps") : NaN
plot within(x) linestyle 13 dashtype 3 notitle, \
     for [i = 1:entries(low)] data using (low_of(i)):"distance" with lines linestyle i title entry(low, i)

set margins screen 0.60, screen 0.985, screen 0.13, screen 0.74
set label 1 "HEO, printed with 100 steps"
unset ylabel
set xrange [63:101]
set yrange [1e-2:1e8]
high_of(i) = strcol("curve") eq sprintf("HEO %d", i) ? column("steps") : NaN
plot within(x) linestyle 13 dashtype 3 notitle, \
     for [i = 1:entries(high)] data using (high_of(i)):"distance" with lines linestyle i title entry(high, i)
unset multiplot
