# Largest error of the perturbation solution against its order: latitude (left) and height (right).
#
#   gnuplot -e "data='results/geodesy/order-study.csv'" \
#       figures/style.gp figures/templates/geodesy-order-study.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header, in one line,
#   order,latitude_corrected_deg,latitude_extended_deg,latitude_printed_deg,
#   height_corrected_m,height_extended_m,height_printed_m,height_projected_m
# and one row an order, ascending. Each cell is a maximum over the grid, positive: `corrected` the
# corrected series in double precision, `extended` the same in extended precision (truncation alone),
# `printed` the series as printed with its coefficients taken literally, `projected` the height from the
# projection of the satellite on the normal instead of its series. An empty cell is a curve that has no such
# order; a column may be empty altogether except for its name.

if (!exists("heading")) heading = "Largest error against the order of the expansion"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set xrange [0.7:6.3]
set logscale y
set format y power_of_ten
set xtics 1
set ytics 100
set xlabel "order of the expansion"
unset key

# The printed series has the larger points: where the corrected one covers them, the two agree.
set margins screen 0.125, screen 0.49, screen 0.13, screen 0.83
set ylabel "maximum |latitude error| (deg)"
plot data using "order":"latitude_printed_deg"   with linespoints linestyle 5 pointsize 1.2, \
     data using "order":"latitude_corrected_deg" with linespoints linestyle 1, \
     data using "order":"latitude_extended_deg"  with linespoints linestyle 3

set margins screen 0.615, screen 0.98, screen 0.13, screen 0.83
set ylabel "maximum |height error| (m)"
plot data using "order":"height_printed_m"   with linespoints linestyle 5 pointsize 1.2, \
     data using "order":"height_corrected_m" with linespoints linestyle 1, \
     data using "order":"height_extended_m"  with linespoints linestyle 3, \
     data using "order":"height_projected_m" with linespoints linestyle 2

# One key for both panels, alone in a strip under the title.
set margins screen 0.02, screen 0.98, screen 0.86, screen 0.92
set key center center horizontal maxrows 2 Left reverse samplen 3 width -2 font "sans-serif,12"
unset border
unset tics
unset xlabel
unset ylabel
plot [0:1] [1:10] NaN, \
     keyentry with linespoints linestyle 5 pointsize 1.2 title "as printed", \
     keyentry with linespoints linestyle 1 title "corrected, double", \
     keyentry with linespoints linestyle 3 title "corrected, extended", \
     keyentry with linespoints linestyle 2 title "height by projection"
unset multiplot
