# Three formulas for the height at a latitude that is slightly wrong.
#
#   gnuplot -e "data='results/geodesy/height-study.csv'; latitude_error='1e-9 rad'" \
#       figures/style.gp figures/templates/geodesy-height-study.gp > out.svg
#
# Variables: data and latitude_error (required), heading (title; optional).
#
# Data: CSV with the header `latitude_deg,by_cosine_m,by_sine_m,by_projection_m,exact_latitude_m`: magnitudes of the height
# error by r/cos(phi) - N, by z/sin(phi) - (1 - e^2) N and by projection at the wrong latitude, and by projection at the
# exact one. Zeros are drawn at 1e-11 m.

if (!exists("heading")) heading = "Height by three formulas"

shown(h) = h < 1e-11 ? 1e-11 : h
set title heading offset 0,2.6
set xrange [0:90]
set xtics 15
set xlabel "geodetic latitude (deg)"
set logscale y
set yrange [5e-12:10]
set ytics 100
set format y power_of_ten
set ylabel "|height error| (m)"
set margins screen 0.12, screen 0.97, screen 0.13, screen 0.78
set key at screen 0.54, screen 0.90 center top maxrows 2 Left reverse samplen 2 spacing 1.2 width -9

plot data using "latitude_deg":(shown(column("by_cosine_m"))) with lines linestyle 2 \
       title "{/:Italic r}/cos φ − ​{/:Italic N}, latitude off by ".latitude_error, \
     data using "latitude_deg":(shown(column("by_sine_m"))) with lines linestyle 5 \
       title "{/:Italic z}/sin φ − (1 − ​{/:Italic e}^2){/:Italic N}, the same", \
     data using "latitude_deg":(shown(column("by_projection_m"))) with points pointtype 7 pointsize 0.35 linecolor rgb colour(1) \
       title "projection, the same", \
     data using "latitude_deg":(shown(column("exact_latitude_m"))) with points pointtype 6 pointsize 0.5 linecolor rgb soft_ink \
       title "projection, exact latitude"
