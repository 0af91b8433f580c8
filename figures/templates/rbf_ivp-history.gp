# Error of a run against time (Elgohary 2015, Figs. 4.2 to 4.15, 4.17 to 4.28, 4.32 to 4.53).
#
#   gnuplot -e "data='results/rbf_ivp/fig-4.34.csv'; lines='x_1|x_2|x_3'; quantity='...'; end='200'" \
#       figures/style.gp figures/templates/rbf_ivp-history.gp > out.svg
#
# Variables: data, lines (labels of the lines, separated by |), quantity (name of the error), end (of the time axis, s);
# dots (labels of the rows of dots), dot_size, heading (title), all optional. They may hold gnuplot's enhanced text.
#
# Data: CSV with the header `curve,t_s,error`, blank lines between curves. Curves 1, 2, ... are the lines in the order of
# their labels; the ones after them are dots, one row for each line in the same order. Errors are positive.

if (!exists("heading")) heading = "Error against time"
if (!exists("dots")) dots = ""
if (!exists("dot_size")) dot_size = "0.35"

# The labels between the bars.
line_count = entries(lines)
dot_count = strlen(dots) > 0 ? entries(dots) : 0

alone = line_count + dot_count == 1
set title heading offset 0,(alone ? 0.2 : 1.4)
set xrange [0:real(end)]
set xlabel "{/:Italic t}​ (s)"
set logscale y
set format y power_of_ten
stats data using (log10(column("error"))) nooutput
low = floor(STATS_min)
high = ceil(STATS_max)
# A first step may be exact to rounding; twelve decades show all others.
if (low < high - 12) low = high - 12
if (low == high) low = high - 1
set yrange [10.0**low:10.0**high]
if (high - low > 8) { set ytics 100 } else { set ytics 10 }
set ylabel quantity
set margins screen 0.12, screen 0.97, screen 0.13, screen (alone ? 0.89 : 0.83)
set key at screen 0.545, screen 0.905 center top horizontal maxrows 1 Left reverse samplen 2.5 width -1

of(i) = column("curve") == i ? column("t_s") : NaN
plot for [i = 1:line_count] data using (of(i)):"error" with lines linestyle i linewidth 1.6 title (alone ? "" : entry(lines, i)), \
     for [i = 1:dot_count] data using (of(line_count + i)):"error" \
       with points linestyle i pointtype 7 pointsize real(dot_size) title (i == 1 ? entry(dots, i) : "")
