# Digits of the deflection against time for all solvers, in four panels.
#
#   gnuplot -e "data='results/homotopy/error-vs-time-toggle.csv'; legend='newton|kinsol'; kinds='1 2'; width='1000'; \
#       height='720'" figures/style.gp figures/templates/homotopy-error-vs-time.gp > out.svg
#
# Variables: data, legend (names of the solvers, number 1 first, separated by |), kinds (of each, 1 to 6) (required);
# heading (optional).
#
# Data: CSV with the header `panel,line,kind,number,digits,time_s,last,solver,status`, a blank line between lines. Kinds:
# 1 Newton's, 2 |F| made smaller, 3 descent, 4 homotopy, 5 energy, 6 path following. A run that failed has no digits and is not drawn; `last`
# is 1 at the end of a line: its number stands there.

if (!exists("heading")) heading = "Digits against time"
array kind_name[6] = ["Newton's kind", "made safe by |F|", "descent", "homotopy", "energy", "path following"]
array kind_colour[6] = ["#0072B2", "#E69F00", "#7F7F7F", "#009E73", "#000000", "#CC79A7"]
array kind_point[6] = [7, 5, 2, 9, 15, 13]
array name[40]
count = entries(legend)
do for [k = 1:count] {name[k] = entry(legend, k)}
small = sprintf("%s,%d", font_family, font_size - 3)
line = 0
do for [group = 1:6] {
  set label bold(kind_name[group]) at screen 0.825, screen 0.90 - 0.03*line left font small textcolor rgb kind_colour[group]
  line = line + 1
  do for [k = 1:count] {
    if (int(word(kinds, k)) == group) {
      set label sprintf("%d", k) at screen 0.847, screen 0.90 - 0.03*line right font small textcolor rgb kind_colour[group]
      set label name[k] at screen 0.855, screen 0.90 - 0.03*line left noenhanced font small
      line = line + 1
    }
  }
  line = line + 0.4
}

set multiplot
set label heading at screen 0.44, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set logscale x
set yrange [0:17.5]
set ytics 4
unset key
array caption[4] = ["0.32 in, 27.11 lb, 1 element a member", "0.32 in, 27.11 lb, 16 elements", \
                    "0.44 in, 43.79 lb, 1 element a member", "0.44 in, 43.79 lb, 16 elements"]
do for [p = 1:4] {
  left = p % 2 == 1 ? 0.07 : 0.465
  bottom = p <= 2 ? 0.555 : 0.10
  set margins screen left, screen left + 0.335, screen bottom, screen bottom + 0.335
  set label 99 caption[p] at graph 0.02, graph 1.06 left textcolor rgb ink
  if (p % 2 == 1) {
    set xrange [2e-6:2e-3]
    set xtics ("10 µs" 1e-5, "0.1 ms" 1e-4, "1 ms" 1e-3)
  } else {
    set xrange [6e-5:6e-2]
    set xtics ("0.1 ms" 1e-4, "1 ms" 1e-3, "10 ms" 1e-2)
  }
  if (p > 2) { set xlabel "time" } else { unset xlabel }
  if (p % 2 == 1) { set ylabel "digits of the deflection" offset 0.5,0 } else { unset ylabel }
  here(k) = column("panel") == p && column("number") == k ? column("time_s") : NaN
  plot for [k = 1:count] data using (here(k)):"digits" with linespoints linecolor rgb kind_colour[int(word(kinds, k))] \
           dashtype solid linewidth 1.4 pointtype kind_point[int(word(kinds, k))] pointsize 0.5, \
       for [k = 1:count] data using (column("last") == 1 ? here(k) : NaN):"digits":(sprintf("%d", k)) \
           with labels offset 0.9,0.5 font small textcolor rgb kind_colour[int(word(kinds, k))]
  if (p == 1) { do for [k = 1:98] { unset label k } }
}
unset multiplot
