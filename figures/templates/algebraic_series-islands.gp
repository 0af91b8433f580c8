# Every 31st section of the oscillator, about the orbit of 31 periods in the middle.
#
#   gnuplot -e "data='results/algebraic_series/poincare.csv'" \
#       figures/style.gp figures/templates/algebraic_series-islands.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `section,dx,dv`.

if (!exists("heading")) heading = "An island"

set title heading
set xlabel "10^{4}​ ({/:Italic x}​ − ​{/:Italic x}_{31})"
set ylabel "10^{4}​ d{/:Italic x}/d{/:Italic t}​ (1/s)"
set xrange [-2:2]
set yrange [-3:3]
set key at graph 0.5, graph 0.5 center center
plot data using (1e4*column("dx")):(column("section") < 5000 ? 1e4*column("dv") : NaN) with points linestyle 2 \
       pointsize 0.6 title "first 5000", \
     data using (1e4*column("dx")):(column("section") >= 15000 ? 1e4*column("dv") : NaN) with points linestyle 1 \
       pointsize 0.3 title "last 5000"
