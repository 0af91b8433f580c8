# Error against the length of a step for every method, in three groups.
#
#   gnuplot -e "data='results/rbf_ivp/orders.csv'; legend='1 euler|2 rk4'; height='600'" \
#       figures/style.gp figures/templates/rbf_ivp-orders.gp > out.svg
#
# Variables: data and legend (required: group and name of each method in the order of the data, separated by |),
# heading (title; optional).
#
# Data: CSV with the header `group,method,step,error`, a blank line between methods.

if (!exists("heading")) heading = "Error against the step"

# The legend, taken apart: group[k] and name[k].
array group[40]
array name[40]
count = entries(legend)
do for [k = 1:count] {
  words_of_entry = entry(legend, k)
  group[k] = int(words_of_entry[1:1])
  name[k] = words_of_entry[3:*]
}
array first[4]
do for [k = count:1:-1] { first[group[k]] = k }
first[4] = count + 1

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set yrange [1e-14:1]
set ytics 1000
set mytics 1
set format y power_of_ten
set format x "%g"
set xlabel "step (s)" offset 0,0.3

array low[3] = [0.004, 0.02, 0.03]
array high[3] = [0.25, 1.2, 2]
do for [g = 1:3] {
  left = 0.12 + (g - 1) * 0.298
  set margins screen left, screen left + 0.265, screen 0.44, screen 0.91
  set xrange [low[g]:high[g]]
  if (g == 1) { set ylabel "largest error at 8 s" offset 0.5,0 } else { unset ylabel; set format y "" }
  set key at screen left - 0.02, screen 0.31 left top maxrows 8 Left reverse samplen 3 spacing 1.1 \
      font "sans-serif,12"
  plot for [k = first[g]:first[g + 1] - 1] data using "step":"error" every :::(k - 1)::(k - 1) \
      with linespoints linestyle (k - first[g] + 1) title name[k]
}
unset multiplot
