# An orbit about an oblate Earth from above the pole (left), distances over a day (right).
#
#   gnuplot -e "data='results/two_body_series/zonal.csv'; width=1000; height=480; orbit_hours=1.727" \
#       figures/style.gp figures/templates/two_body_series-zonal.gp > out.svg
#
# Variables: data (required), orbit_hours (required: a revolution of the second orbit), heading (title; optional).
#
# Data: CSV with the header `orbit,hours,x_km,y_km,z_km,j2_from_kepler_km,j6_from_j2_km`, a blank line between
# orbits: LEO, LEO tilted, CIRC.

if (!exists("heading")) heading = "A day about the oblate Earth"
hours_of_orbit = real(orbit_hours)
small = sprintf("%s,%d", font_family, font_size - 3)
set multiplot
set label 1 heading at screen 0.5, screen 0.96 center font sprintf("%s:Bold,%d", font_family, font_size + 1)

set margins screen 0.075, screen 0.44, screen 0.17, screen 0.86
set size ratio -1
set xrange [-9:9]
set yrange [-9:9]
set xtics 3
set ytics 3
set xlabel "x (1000 km)"
set ylabel "y (1000 km)"
set object 1 circle at 0,0 size 6.378137 fillcolor rgb pale fillstyle solid 1 noborder
set label 2 "Earth" at 0,0 center font small textcolor rgb soft_ink
set label 3 "LEO tilted, from above the pole" at graph 0.5, graph 1.03 center font small
set key at graph 0.99, graph 0.13 right Right noreverse font small samplen 3
first(h, v) = h <= hours_of_orbit ? v : NaN
last(h, v) = h >= 24 - hours_of_orbit ? v : NaN
plot data using (first(column("hours"), 1e-3*column("x_km"))):(1e-3*column("y_km")) every :::1::1 with lines \
       linestyle 2 dashtype 2 title "first revolution", \
     data using (last(column("hours"), 1e-3*column("x_km"))):(1e-3*column("y_km")) every :::1::1 with lines \
       linestyle 1 title "last of the day"
unset label
unset object 1
set size noratio

set margins screen 0.57, screen 0.975, screen 0.17, screen 0.86
set logscale y
set xrange [0:24]
set xtics 4
set yrange [1e-3:2e4]
set ytics ("1 m" 1e-3, "10 m" 1e-2, "100 m" 1e-1, "1 km" 1, "10 km" 10, "100 km" 100, "1000 km" 1000)
set xlabel "time (hours)"
set ylabel "distance" offset 0.5,0
set key at graph 0.98, graph 0.03 right bottom Left reverse font small samplen 4
set label 4 "by J_2, from Kepler" at 0.8, 6e3 left font small
set label 5 "by J_3 to J_6, further (dotted)" at 2.2, 11 left font small
array name[3] = ["LEO", "LEO tilted", "CIRC"]
plot for [k = 1:3] data using "hours":"j2_from_kepler_km" every :::k - 1::k - 1 with lines linestyle k dashtype solid \
       title name[k], \
     for [k = 1:3] data using "hours":"j6_from_j2_km" every :::k - 1::k - 1 with lines linestyle k dashtype 3 notitle
unset multiplot
