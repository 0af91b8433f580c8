# The forced Duffing oscillator from two starts, and the distance of the motions (Filipich and Rosales, section 4.4).
#
#   gnuplot -e "data='results/algebraic_series/duffing-starts.csv'" \
#       figures/style.gp figures/templates/algebraic_series-duffing-starts.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t,u,u_near,distance`.

if (!exists("heading")) heading = "Forced Duffing oscillator from two starts"

set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set xrange [0:50]
set margins screen 0.12, screen 0.97, screen 0.46, screen 0.85
set format x ""
set ylabel "{/:Italic u}"
set key at screen 0.97, screen 0.915 right horizontal samplen 2
plot data using "t":"u" with lines linestyle 1 linewidth 1.6 title "from (3, 4)", \
     data using "t":"u_near" with lines linestyle 5 linewidth 1.6 title "from (3.1, 4.1)"
unset label
unset key
set margins screen 0.12, screen 0.97, screen 0.14, screen 0.40
set format x "%g"
set xlabel "{/:Italic t}"
set ylabel "distance"
set logscale y
set yrange [0.05:20]
plot data using "t":"distance" with lines linestyle 1 linewidth 1.2
unset multiplot
