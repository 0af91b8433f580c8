# Relative error against the number of elements, with a line of second order.
#
#   gnuplot -e "data='results/homotopy/elastica.csv'; legend='a|b'" \
#       figures/style.gp figures/templates/homotopy-elastica.gp > out.svg
#
# Variables: data, legend (required: one entry a curve in the order of the data, separated by |); heading (optional).
#
# Data: CSV with the header `curve,elements,error`, a blank line between curves.

if (!exists("heading")) heading = ""
set title heading
set xlabel "elements a member"
set ylabel "relative error" offset 0.5,0
set logscale xy
set xrange [0.8:160]
set yrange [1e-9:3e-4]
set xtics (1, 2, 4, 8, 16, 32, 64, 128)
set ytics ("10^{-9}" 1e-9, "10^{-8}" 1e-8, "10^{-7}" 1e-7, "10^{-6}" 1e-6, "10^{-5}" 1e-5, "10^{-4}" 1e-4)
set mxtics 1
set mytics 1
set key bottom left Left reverse
set label "second order" at 40,4e-5 left front textcolor rgb ink

plot for [k = 1:entries(legend)] data using "elements":"error" every :::(k - 1)::(k - 1) with linespoints linestyle k \
         title entry(legend, k), \
     [16:128] 0.03/x**2 with lines linecolor rgb ink dashtype 2 linewidth 1 notitle
