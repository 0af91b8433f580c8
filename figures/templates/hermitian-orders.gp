# Error at t = 10 against the step on two oscillators.
#
#   gnuplot -e "data='results/hermitian/orders.csv'; width=900" \
#       figures/style.gp figures/templates/hermitian-orders.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `problem,operators,step,error`, eight rows a pair of operators, in the order laier, newmark,
# hoff, bazzi, argyris, first for the Duffing oscillator and then for van der Pol's.

if (!exists("heading")) heading = "Error against the step"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set xrange [0.0025:0.5]
set xtics (0.003, 0.01, 0.03, 0.1, 0.3)
set yrange [1e-14:1]
set ytics 100
set mytics 1
set format y power_of_ten
set xlabel "step (s)" offset 0,0.3
array problem[2] = ["Duffing (11) from rest", "van der Pol, 1.5, from (2, 0)"]
array name[5] = ["Laier", "Newmark", "Hoff", "Bazzi", "Argyris"]
array style_of[5] = [1, 3, 4, 6, 5]
array size_of[5] = [0.8, 1.3, 0.9, 0.5, 0.8]
do for [g = 1:2] {
  left = g == 1 ? 0.11 : 0.58
  set margins screen left, screen left + 0.40, screen 0.15, screen 0.84
  set title problem[g] font sprintf("%s,%d", font_family, font_size) offset 0,-0.5
  if (g == 1) { set ylabel "error at t = 10" } else { unset ylabel }
  set key at graph 0.97, graph 0.04 right bottom Left reverse
  plot for [k = 1:5] data using "step":"error" every ::(40*(g - 1) + 8*(k - 1))::(40*(g - 1) + 8*k - 1) \
      with linespoints linestyle style_of[k] pointsize size_of[k] title name[k]
}
unset multiplot
