# Path of a projectile, from the side and from above (Filipich and Rosales, Fig. 1).
#
#   gnuplot -e "data='results/algebraic_series/fig-1.csv'" \
#       figures/style.gp figures/templates/algebraic_series-projectile.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t_s,x_m,y_m,z_m`.

if (!exists("heading")) heading = "Path of a projectile"

set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set xrange [0:40]
unset key
set margins screen 0.11, screen 0.97, screen 0.60, screen 0.91
set format x ""
set ylabel "height ​{/:Italic z}​ (m)"
set ytics 40
plot data using (column("x_m")/1000):"z_m" with lines linestyle 1
unset label
set margins screen 0.11, screen 0.97, screen 0.14, screen 0.55
set format x "%g"
set xlabel "{/:Italic x}​ (km)"
set ylabel "{/:Italic y}​ (km)"
set ytics 5
plot data using (column("x_m")/1000):(column("y_m")/1000) with lines linestyle 2 dashtype solid, \
     data using (column("x_m")/1000):(int(column("t_s")*20 + 0.5) % 20 == 0 ? column("y_m")/1000 : NaN) \
       with points linestyle 2, \
     data using (column("x_m")/1000):(column("y_m")/1000):(sprintf("%.0f s", column("t_s"))) \
       every 40::40 with labels right offset -0.6,0.6
unset multiplot
