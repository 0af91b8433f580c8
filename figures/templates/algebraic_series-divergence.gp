# When forward Euler departs from the solution, against its step.
#
#   gnuplot -e "data='results/algebraic_series/divergence.csv'" \
#       figures/style.gp figures/templates/algebraic_series-divergence.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `step,visible,large,overflow`, times in s, cells empty where it does not happen.

if (!exists("heading")) heading = "Departure of forward Euler"

set title heading
set xlabel "step ​{/:Italic h}​ (s)"
set ylabel "time (s)"
set logscale x
set xrange [8e-4:0.25]
set yrange [0:80]
set arrow from graph 0, first 30 to graph 1, first 30 nohead linestyle 11
set label "30 s, as the paper says" at graph 0.01, first 30 left offset 0,0.7 textcolor rgb soft_ink
set key inside bottom left
plot data using "step":"overflow" with linespoints linestyle 3 title "overflow", \
     data using "step":"large" with linespoints linestyle 5 title "|x| above 1, twice the amplitude", \
     data using "step":"visible" with linespoints linestyle 1 title "error of a tenth of the amplitude"
