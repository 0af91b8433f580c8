# Solutions by several methods beside the reference over a short window (Elgohary 2015, Figs. 4.16, 4.29, 4.54 to 4.56).
#
#   gnuplot -e "data='results/rbf_ivp/fig-4.16.csv'; legend='RK4-1|HHT-1'; symbol='x(t)'; begin='495'; end='500'" \
#       figures/style.gp figures/templates/rbf_ivp-comparison.gp > out.svg
#
# Variables: data, legend (the methods, separated by |), symbol (of the ordinate), begin and end (of the time axis, s);
# heading (title; optional).
#
# Data: CSV with the header `curve,kind,t_s,x`, blank lines between curves. Curve 0 is the reference, 1, 2, ... are the
# methods in the order of the legend. Kind 0 is a point of the method's dense output, 1 the end of a step.

if (!exists("heading")) heading = "Solutions side by side"

methods = entries(legend)

set title heading offset 0,2.4
set xrange [real(begin):real(end)]
set xlabel "{/:Italic t}​ (s)"
set ylabel symbol
set margins screen 0.12, screen 0.97, screen 0.13, screen 0.79
set key at screen 0.535, screen 0.91 center top horizontal maxrows 2 Left reverse samplen 2.5

# A block of the file is a curve: what is not read costs little.
of(k) = column("kind") == k ? column("t_s") : NaN
plot data every :::0::0 using (of(0)):"x" with lines linecolor rgb "#c9c9c9" linewidth 9 dashtype solid title "reference", \
     for [i = 1:methods] data every :::i::i using (of(0)):"x" with lines linestyle i linewidth 1.4 notitle, \
     for [i = 1:methods] data every :::i::i using (of(1)):"x" with points linestyle i pointsize 0.9 notitle, \
     for [i = 1:methods] keyentry with linespoints linestyle i linewidth 1.4 pointsize 0.9 title entry(legend, i)
