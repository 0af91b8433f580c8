# Errors of several methods against the step, or against time.
#
#   gnuplot -e "data='results/transversal/orders.csv'; legend='p = 1|p = 2'; xrange='[1e-3:1]'; yrange='[1e-12:1]'; \
#       xlabel='step'; ylabel='error'" figures/style.gp figures/templates/transversal-steps.gp > out.svg
#
# Variables: data, legend (names in the order of the series, separated by |), xrange, yrange, xlabel, ylabel (required);
# heading (title), linear_x (if it exists, the first axis is linear), level and level_words (a line and what it says),
# mark (a step marked by a vertical line), crosses (numbers of the series that failed somewhere, with blanks between) and
# overflow_words (what their crosses mean); optional.
#
# Data: CSV with the header `series,step,error,overflow`, a blank line between series. error is empty where a run failed;
# overflow is then the height of its cross.

if (!exists("heading")) heading = "Errors"

array name[20]
count = entries(legend)
do for [k = 1:count] {name[k] = entry(legend, k)}

set title heading
set xlabel xlabel
set ylabel ylabel offset 0.5,0
set logscale y
if (!exists("linear_x")) {
  set logscale x
  set xtics (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
}
eval "set xrange " . xrange
eval "set yrange " . yrange
set ytics 100
set mytics 1
set format y power_of_ten
if (exists("level")) {
  set arrow 1 from graph 0, first real(level) to graph 1, first real(level) nohead linestyle 11
  set label 1 level_words at graph 0.01, first real(level) left offset 0,0.6 textcolor rgb soft_ink
}
if (exists("mark")) {
  set arrow 2 from first real(mark), graph 0 to first real(mark), graph 1 nohead linestyle 13
  set label 2 "{/:Italic h}​ = " . mark at first real(mark), graph 0.03 right offset -0.5,0 textcolor rgb soft_ink
}
if (exists("overflow_words")) {
  set label 3 "× " . overflow_words at graph 0.01, first 90 left textcolor rgb soft_ink
}
set key outside right center Left reverse samplen 3
width_of(k) = exists("linear_x") ? 1.4 : 2
if (exists("crosses")) {
  plot for [k = 1:count] data using "step":"error" every :::(k - 1)::(k - 1) with linespoints linestyle k \
           linewidth width_of(k) pointsize 0.6 title name[k], \
       for [w in crosses] data using "step":"overflow" every :::(int(w) - 1)::(int(w) - 1) with points pointtype 2 \
           pointsize 0.6 linecolor rgb colour(int(w)) notitle
} else {
  plot for [k = 1:count] data using "step":"error" every :::(k - 1)::(k - 1) with linespoints linestyle k \
           linewidth width_of(k) pointsize 0.6 title name[k]
}
