# Printed errors beside ours, and our run times (Elgohary 2015, Tables 4.2, 4.4, 4.6).
#
#   gnuplot -e "data='results/rbf_ivp/table-4.2.csv'; rows='14'" \
#       figures/style.gp figures/templates/rbf_ivp-results.gp > out.svg
#
# Variables: data and rows (their number), heading (title; optional).
#
# Data: CSV with the header `row,method,published,nominal,inferred,time_ms`: rows numbered from 1, the RMS errors printed,
# ours by the text as it stands, ours by the inferred reading (empty if it cannot be told from the nominal one), and the
# median time of our run.

if (!exists("heading")) heading = "Printed errors beside ours"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set yrange [real(rows) + 0.7:0.3]
set logscale x
set format x power_of_ten
set grid linestyle 12
unset key

set margins screen 0.16, screen 0.67, screen 0.13, screen 0.85
set xlabel "RMS error"
set xtics 100
set ytics scale 0
plot data using "nominal":"row":ytic(stringcolumn("method")) with points pointtype 7 pointsize 1.1 linecolor rgb colour(1), \
     data using "inferred":"row" with points pointtype 5 pointsize 1 linecolor rgb colour(4), \
     data using "published":"row" with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink

set margins screen 0.72, screen 0.97, screen 0.13, screen 0.85
set xlabel "our time (ms)"
set xtics 10
set format y ""
plot data using "time_ms":"row" with points pointtype 13 pointsize 1.3 linecolor rgb colour(5)

# The key alone in a strip under the title.
set margins screen 0.02, screen 0.98, screen 0.86, screen 0.92
set key center center horizontal maxrows 1 Left reverse samplen 1 width -2
unset border
unset tics
unset xlabel
unset logscale
set yrange [0:1]
plot [0:1] NaN, \
     keyentry with points pointtype 7 pointsize 1.1 linecolor rgb colour(1) title "ours, nominal", \
     keyentry with points pointtype 5 pointsize 1 linecolor rgb colour(4) title "ours, inferred", \
     keyentry with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink title "printed"
unset multiplot
