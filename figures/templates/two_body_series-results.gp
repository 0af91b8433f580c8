# Printed energy errors and times beside ours (Elgohary 2015, Tables 3.2 and 3.3).
#
#   gnuplot -e "data='results/two_body_series/table-3.2.csv'; rows='15'" \
#       figures/style.gp figures/templates/two_body_series-results.gp > out.svg
#
# Variables: data and rows (their number), heading (title; optional).
#
# Data: CSV with the header `row,label,published,ours,published_ms,time_ms`: rows numbered from 1, printed and our norm of
# the energy error, printed and our median time of a run.

if (!exists("heading")) heading = "Printed energy errors beside ours"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set yrange [real(rows) + 0.7:0.3]
set logscale x
set format x power_of_ten
set grid linestyle 12
unset key

set margins screen 0.33, screen 0.67, screen 0.11, screen 0.87
set xlabel "norm of the relative energy error"
set xtics 1e4
set ytics scale 0
plot data using "ours":"row":ytic(stringcolumn("label")) with points pointtype 7 pointsize 1.1 linecolor rgb colour(1), \
     data using "published":"row" with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink

set margins screen 0.72, screen 0.97, screen 0.11, screen 0.87
set xlabel "time of a run (ms)"
set xtics 100
set format y ""
plot data using "time_ms":"row" with points pointtype 7 pointsize 1.1 linecolor rgb colour(1), \
     data using "published_ms":"row" with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink

# The key alone in a strip under the title.
set margins screen 0.02, screen 0.98, screen 0.88, screen 0.94
set key center center horizontal maxrows 1 Left reverse samplen 1 width -2
unset border
unset tics
unset xlabel
unset logscale
set yrange [0:1]
plot [0:1] NaN, \
     keyentry with points pointtype 7 pointsize 1.1 linecolor rgb colour(1) title "ours", \
     keyentry with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink title "printed"
unset multiplot
