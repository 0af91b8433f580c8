# Solvers of the equations of one interval of collocation (Eq. 4.16), with and without the inverse of the Jacobian
# matrix: free Duffing oscillator.
#
#   gnuplot -e "data='results/rbf_ivp/solver-study.csv'; height='720'" \
#       figures/style.gp figures/templates/rbf_ivp-solver-study.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `panel,solver,abscissa,ordinate,time_s`. panel is
#   history  iteration (from 1: the start), |F| relative to the start
#   nodes    number of nodes N, iterations
#   length   length of the interval in periods, iterations (nan: no solution found)
#   step     step of fictitious time, iterations
#   chosen   0, iterations with chosen steps

if (!exists("heading")) heading = "Solvers of the equations of an interval"

array names[7] = ["Newton", "damped Newton", "Picard", "fixed-point homotopy", "Newton homotopy", \
                  "fixed-point homotopy integrated", "Newton homotopy integrated"]
array titles[7] = ["Newton", "damped Newton", "Picard", "fixed-point homotopy", "Newton homotopy", \
                   "fixed point, integrated F", "Newton hom., integrated F"]
array style[7] = [3, 8, 4, 5, 1, 2, 6]
on(p, k) = strcol("panel") eq p && strcol("solver") eq names[k] ? column("abscissa") : NaN

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale y
set format y power_of_ten

set margins screen 0.115, screen 0.475, screen 0.53, screen 0.77
set title "N = 7, h = P/10" font sprintf("%s,%d", font_family, font_size) offset 0,-0.4
set xlabel "iteration" offset 0,0.5
set ylabel "|F|, relative" offset 0.8,0
set logscale x
set xrange [1:3000]
set yrange [1e-12:30]
set xtics (1, 10, 100, 1000)
set ytics 1e3
set mytics 1
set key at screen 0.5, screen 0.95 center top maxrows 4 Left reverse samplen 4 spacing 1.05
plot for [k = 1:7] data using (on("history", k)):"ordinate" with lines linestyle style[k] title titles[k]

unset key
set margins screen 0.615, screen 0.975, screen 0.53, screen 0.77
set title "h = P/2, Radau nodes"
set xlabel "number of nodes N"
set ylabel "iterations" offset 0.8,0
set xrange [6.3:40]
set xtics (7, 10, 14, 20, 28, 35)
set yrange [1:1e6]
set ytics (1, 10, 100, 1e3, 1e4, 1e5, 1e6)
plot for [k = 1:7] data using (on("nodes", k)):"ordinate" with linespoints linestyle style[k]

set margins screen 0.115, screen 0.475, screen 0.09, screen 0.37
unset logscale x
set title "60 Radau nodes; no line: no solution found"
set xlabel "length of the interval (periods)"
set xrange [0:4.1]
set xtics 1
plot for [k in "1 2 3"] data using (on("length", int(k))):"ordinate" with lines linestyle style[int(k)], \
     for [k in "6 7"] data using (on("length", int(k))):"ordinate" with linespoints linestyle style[int(k)]

set margins screen 0.615, screen 0.975, screen 0.09, screen 0.37
set title "N = 7, h = P/10; at 0: chosen steps"
set xlabel "step of fictitious time"
set xrange [-0.2:3.7]
set xtics 1
plot for [k = 4:7] data using (on("step", k)):"ordinate" with linespoints linestyle style[k], \
     for [k = 4:7] data using (on("chosen", k)):"ordinate" with points linestyle style[k]
unset multiplot
