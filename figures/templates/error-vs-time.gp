# Digits of many integrators against what they cost: median run time (left), right-hand sides (right).
#
#   gnuplot -e "data='results/rbf_ivp/error-vs-time-duffing.csv'; width=1000; height=620; \
#       legend='rbf-coll, N = 7|ode45'; kinds='1 4'" \
#       figures/style.gp figures/templates/error-vs-time.gp > out.svg
#
# Variables: data (required), legend (required: names of the methods, number 1 first, separated by |), kinds (required:
# the kind of each, 1 to 8), heading (title; optional), own_name (what kind 8 is; optional), floor_digits (what rounding leaves; optional), floor_right
# (if it exists, the words at that line stand at its right end).
#
# Data: CSV with the header, in one line,
#   kind,number,digits,time_s,time_low_s,time_high_s,rhs_evaluations,best,status,method,setting
# and one row a setting, methods in the order of their numbers, cheapest setting first. Kinds: 1 radial functions,
# 2 polynomials and Picard iteration, 3 other methods of fixed step, 4 and 5 step control, explicit and implicit,
# 6 Taylor series, 7 a closed form, 8 adaptive collocation. A run
# that failed has no digits and is not drawn. best is 1 in the row with the most digits of a method: its number stands
# there.

if (!exists("heading")) heading = "Digits against cost"

array kind_name[8] = ["radial functions", "polynomials, Picard", "fixed step, others", \
                      "step control, explicit", "step control, implicit", "Taylor series", "closed form", \
                      "adaptive collocation"]
if (exists("own_name")) kind_name[8] = own_name
array kind_colour[8] = ["#D55E00", "#0072B2", "#7F7F7F", "#009E73", "#CC79A7", "#D55E00", "#000000", "#000000"]
array kind_width[8] = [2.6, 2, 1, 1.4, 1.4, 2.6, 2.6, 2.8]
array kind_point[8] = [5, 7, 2, 9, 11, 13, 15, 15]

# The methods by kind, to the right of the panels.
array name[64]
count = entries(legend)
do for [k = 1:count] {name[k] = entry(legend, k)}
kind(k) = int(word(kinds, k))
line = 0
# Lines as close as they must be for all names to find room.
groups = 0
do for [group = 1:8] {
  members = 0
  do for [k = 1:count] {members = members + (kind(k) == group)}
  groups = groups + (members > 0)
}
pitch = 0.94/(count + 1.35*groups)
pitch = pitch < 0.0255 ? pitch : 0.0255
small = sprintf("%s,%d", font_family, font_size - 3)
order = "8 7 6 1 2 3 4 5"
do for [place = 1:8] {
  group = int(word(order, place))
  members = 0
  do for [k = 1:count] {members = members + (kind(k) == group)}
  if (members > 0) {
    set label bold(kind_name[group]) at screen 0.815, screen 0.955 - pitch*line left font small textcolor rgb kind_colour[group]
    line = line + 1
    do for [k = 1:count] {
      if (kind(k) == group) {
        set label sprintf("%d", k) at screen 0.837, screen 0.955 - pitch*line right font small textcolor rgb kind_colour[group]
        set label name[k] at screen 0.845, screen 0.955 - pitch*line left noenhanced font small
        line = line + 1
      }
    }
    line = line + 0.35
  }
}

set multiplot
set label heading at screen 0.065, screen 0.965 left font sprintf("%s:Bold,%d", font_family, font_size + 1)
set logscale x
set format x power_of_ten
set yrange [0:15]
set ytics 3
set ylabel "digits: -log_{10} of the relative error" offset 1.5,0
unset key
floor_at = exists("floor_right") ? 0.99 : 0.01
floor_side = exists("floor_right") ? "right" : "left"
if (exists("floor_digits")) {
  set arrow from graph 0, first real(floor_digits) to graph 1, first real(floor_digits) nohead linestyle 11
  set label "condition times rounding" at graph floor_at, first real(floor_digits) @floor_side offset 0,0.6 font small textcolor rgb soft_ink
}

of(k, value) = int(column("number")) == k ? value : NaN
best_of(k, value) = int(column("number")) == k && int(column("best")) == 1 ? value : NaN
# Our own methods last, over the others.
drawn = ""
do for [group in "3 5 4 2 1 6 7 8"] {
  do for [k = 1:count] {if (kind(k) == int(group)) {drawn = drawn . sprintf(" %d", k)}}
}
set style textbox opaque noborder fillcolor "#ffffff" margins 0.3,0.3
# Numbers stand at four places about their points, so that neighbours keep apart.
array right[4] = [1.1, 0.3, -0.9, -0.3]
array up[4] = [0.35, 0.8, 0.5, -0.8]
array cost[2] = ["time_s", "rhs_evaluations"]
array axis_label[2] = ["median run time (s)", "right-hand sides evaluated"]
array panel_left[2] = [0.085, 0.485]
do for [panel = 1:2] {
  set margins screen panel_left[panel], screen panel_left[panel] + 0.31, screen 0.15, screen 0.93
  set xlabel axis_label[panel] offset 0,0.4
  name_of_cost = cost[panel]
  plot for [m in drawn] \
         data using (of(int(m), column(name_of_cost))):"digits" with linespoints \
         linecolor rgb kind_colour[kind(int(m))] linewidth kind_width[kind(int(m))] dashtype solid \
         pointtype kind_point[kind(int(m))] pointsize 0.55 notitle, \
       for [k = 1:count] data using (best_of(k, column(name_of_cost))):"digits":(sprintf("%d", k)) with labels boxed \
         offset right[k % 4 + 1],up[k % 4 + 1] font small textcolor rgb kind_colour[kind(k)] notitle
  if (panel == 1) {
    unset label
    unset ylabel
    if (exists("floor_digits")) {
      set label "condition times rounding" at graph floor_at, first real(floor_digits) @floor_side offset 0,0.6 font small textcolor rgb soft_ink
    }
  }
}
unset multiplot
