# Time of a step against its order (left), time of a run against its orbits (right).
#
#   gnuplot -e "data='results/two_body_series/cost.csv'; width=1000; height=460; step_lines='plain loops|unrolled, avx2'" \
#       figures/style.gp figures/templates/two_body_series-cost.gp > out.svg
#
# Variables: data (required), step_lines (required: names of the lines of the left panel, separated by |; at most 4),
# heading (title; optional).
#
# Data: CSV with the header `line,x,time_s,steps,mean_order`, a blank line between lines: first those of the left
# panel, x the order; then those of the right panel, x the orbits: adaptive e = 0.1 and 0.7, Kepler.

if (!exists("heading")) heading = "Cost of a step and of a run"
array name[8]
count = entries(step_lines)
do for [k = 1:count] {name[k] = entry(step_lines, k)}
set multiplot
set label 1 heading at screen 0.5, screen 0.95 center font sprintf("%s:Bold,%d", font_family, font_size + 1)

set margins screen 0.085, screen 0.47, screen 0.15, screen 0.88
set xrange [5:41]
set xtics 5
set yrange [0:2500]
set ytics 500
set xlabel "order"
set ylabel "time of a step (ns)"
set key inside top left
plot for [k = 1:count] data using "x":(1e9*column("time_s")) every :::k - 1::k - 1 with linespoints linestyle k \
     title name[k]
unset label 1

set margins screen 0.595, screen 0.965, screen 0.15, screen 0.88
set logscale xy
set xrange [0.8:1250]
set xtics ("1" 1, "10" 10, "100" 100, "1000" 1000)
set yrange [5e-8:1e-1]
set ytics ("0.1 µs" 1e-7, "1 µs" 1e-6, "10 µs" 1e-5, "0.1 ms" 1e-4, "1 ms" 1e-3, "10 ms" 1e-2, "100 ms" 1e-1)
set xlabel "orbits"
set ylabel "time of a run"
array run_name[3] = ["adaptive, e = 0.1", "adaptive, e = 0.7", "Kepler's equation"]
array run_style[3] = [1, 5, 3]
plot for [k = 1:3] data using "x":"time_s" every :::count + k - 1::count + k - 1 with linespoints \
     linestyle run_style[k] title run_name[k]
unset multiplot
