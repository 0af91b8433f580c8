# The three positions of the chain of masses against time (Elgohary 2015, Fig. 4.31).
#
#   gnuplot -e "data='results/rbf_ivp/fig-4.31.csv'" figures/style.gp figures/templates/rbf_ivp-response.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t_s,x1,x2,x3`.

if (!exists("heading")) heading = "Positions of three masses"

set title heading offset 0,1.4
set xrange [0:200]
set xlabel "{/:Italic t}​ (s)"
set ylabel "position"
set margins screen 0.12, screen 0.97, screen 0.13, screen 0.83
set key at screen 0.535, screen 0.905 center top horizontal maxrows 1 Left reverse samplen 3
plot data using "t_s":"x3" with lines linestyle 2 dashtype solid linewidth 1.4 title "x_3", \
     data using "t_s":"x2" with lines linestyle 4 dashtype solid linewidth 1.4 title "x_2", \
     data using "t_s":"x1" with lines linestyle 1 linewidth 1.8 title "x_1"
