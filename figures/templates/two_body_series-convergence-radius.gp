# Radius of convergence along ellipses, and the printed steps.
#
#   gnuplot -e "data='results/two_body_series/convergence-radius.csv'" \
#       figures/style.gp figures/templates/two_body_series-convergence-radius.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `e,mean_anomaly_deg,radius_orbits,by_coefficients_orbits`, a blank line between
# ellipses: e = 0.1, 0.7, 0.9, 0.99.

if (!exists("heading")) heading = "Radius of convergence"
set title heading
set logscale y
set yrange [1e-4:2]
set ytics ("10^{−4}" 1e-4, "10^{−3}" 1e-3, "10^{−2}" 1e-2, "10^{−1}" 1e-1, "1" 1)
set xrange [-180:180]
set xtics 60
set xlabel "mean anomaly (degrees); periapsis at 0"
set ylabel "radius of convergence (orbits)"
set key inside bottom left
array name[4] = ["e = 0.1", "e = 0.7", "e = 0.9", "e = 0.99"]
set arrow from -180, 0.04 to 180, 0.04 nohead linestyle 11
set arrow from -180, 0.01 to 180, 0.01 nohead linestyle 11
small = sprintf("%s,%d", font_family, font_size - 3)
set label "marks: from the coefficients of orders 40 to 100" at 176, 1.4e-4 right font small textcolor rgb soft_ink
set label "25 steps an orbit" at 176, 0.04 right offset 0,-0.6 font small textcolor rgb soft_ink
set label "100 steps an orbit" at 176, 0.01 right offset 0,-0.6 font small textcolor rgb soft_ink
plot for [k = 1:4] data using "mean_anomaly_deg":"radius_orbits" every :::k - 1::k - 1 with lines \
       linestyle k title name[k], \
     for [k = 1:4] data using "mean_anomaly_deg":"by_coefficients_orbits" every 10:::k - 1::k - 1 with points \
       linestyle k notitle
