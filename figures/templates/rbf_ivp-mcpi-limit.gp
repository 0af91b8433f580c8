# Modified Chebyshev-Picard iteration on the free Duffing oscillator: how the changes of its sweeps go, how fast
# they shrink, and up to which step (Elgohary 2015, section 4.4.1).
#
#   gnuplot -e "data='results/rbf_ivp/mcpi-limit.csv'; height='640'" \
#       figures/style.gp figures/templates/rbf_ivp-mcpi-limit.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `panel,series,abscissa,ordinate`. panel is
#   sweeps   series: step in periods; sweep, largest change of the state by it
#   factor   series: order; step in periods, mean ratio of successive changes near the solution (empty: none)
#   phase    series: order; phase at which a step begins, largest step that converges, both in periods

if (!exists("heading")) heading = "Picard's iteration against the step"

on(panel, n)   = strcol("panel") eq panel && abs(column("series") - n) < 1e-6 ? column("abscissa") : NaN
orders = "8 16 32 100 500"
steps  = "0.3 0.5 0.55 0.57 0.6"
array style[5] = [5, 4, 2, 1, 3]

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink

set margins screen 0.11, screen 0.47, screen 0.57, screen 0.87
set title "from the constant state, N = 100" font sprintf("%s,%d", font_family, font_size)
set xlabel "sweep" offset 0,0.4
set ylabel "largest change" offset 0.8,0
set logscale y
set format y power_of_ten
set xrange [0:36]
set yrange [1e-13:1e20]
set ytics (1e-8, 1, 1e8, 1e16)
set mytics 1
set key top right samplen 2 spacing 1.05
plot for [i = 1:words(steps)] data using (on("sweeps", real(word(steps, i)))):"ordinate" with lines linestyle i \
    title word(steps, i) . " P"

set margins screen 0.60, screen 0.97, screen 0.57, screen 0.87
set title "near the solution"
set xlabel "step (periods)"
set ylabel "mean ratio of changes" offset 0.8,0
unset logscale y
set format y "%g"
set xrange [0:2]
set yrange [0:1.6]
set xtics 0.5
set ytics 0.25
set arrow 1 from 0.5, 0 to 0.5, 1.6 nohead linestyle 11
set label 1 "P/2" at 0.5, 1.1 left offset 0.4,0 textcolor rgb soft_ink
set key top right maxrows 2 samplen 2 spacing 1.05
plot for [i = 1:4] data using (on("factor", real(word(orders, i)))):"ordinate" with lines linestyle style[i] \
    title "N = " . word(orders, i)

unset arrow 1
unset label 1
set margins screen 0.11, screen 0.97, screen 0.11, screen 0.38
set title "largest step that converges from the constant state"
set xlabel "phase at which the step begins (periods; 0: at rest)"
set ylabel "step (periods)" offset 0.8,0
set xrange [0:0.5]
set yrange [0.4:0.6]
set xtics 0.1
set ytics 0.05
set arrow 2 from 0, 0.5 to 0.5, 0.5 nohead linestyle 11
set key bottom left horizontal samplen 2 spacing 1.05
plot for [i = 1:5] data using (on("phase", real(word(orders, i)))):"ordinate" with steps linestyle style[i] \
    title "N = " . word(orders, i)
unset multiplot
