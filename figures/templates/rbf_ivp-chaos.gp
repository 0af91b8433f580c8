# Collocation on a chaotic motion and on a transient: error at t = 100 against the length of the step (Elgohary 2015,
# section 4.4.2).
#
#   gnuplot -e "data='results/rbf_ivp/chaos.csv'" figures/style.gp figures/templates/rbf_ivp-chaos.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `motion,method,step,error`; runs that fail are left out.

if (!exists("heading")) heading = "Collocation on a chaotic motion and on a transient"

on(m, name) = strcol("motion") eq m && strcol("method") eq name ? column("step") : NaN
array methods[5] = ["RBF-Coll N = 35", "RBF-Coll N = 7", "polynomials N = 35", "polynomials N = 7", "ode45"]
array style[5] = [1, 5, 3, 2, 8]
motions = "chaotic transient"

set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set logscale xy
set xrange [2e-3:4]
set yrange [1e-13:10]
set format y power_of_ten
set ytics 1e2
set mytics 1
set mxtics 1
set xtics (0.01, 0.1, 1)
set xlabel "mean length of a step"
do for [p = 1:2] {
  m = word(motions, p)
  set margins screen (p == 1 ? 0.12 : 0.58), screen (p == 1 ? 0.51 : 0.97), screen 0.26, screen 0.86
  set title (p == 1 ? "chaotic: force 7.5 cos t" : "transient: no force") font sprintf("%s,%d", font_family, font_size)
  set ylabel (p == 1 ? "error of {/:Italic u}(100)" : "")
  set arrow 1 from 2e-3, 0.0335 to 4, 0.0335 nohead linestyle 11
  if (p == 1) {
    set label 2 "1 % of the amplitude" at 2.4e-3, 0.12 left textcolor rgb soft_ink
    set key at screen 0.52, screen 0.07 center maxrows 2 samplen 2
  } else {
    unset label
    unset key
  }
  plot for [i = 1:4] data using (on(m, methods[i])):"error" with linespoints linestyle style[i] title methods[i], \
       data using (on(m, methods[5])):"error" with linespoints linestyle style[5] title methods[5]
}
unset multiplot
