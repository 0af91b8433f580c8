# Error of the differentiation matrix of Gaussians by three ways, and the cost of leave-one-out cross-validation with
# and without rounding, against the shape.
#
#   gnuplot -e "data='results/rbf_ivp/shape-study.csv'; height='700'" \
#       figures/style.gp figures/templates/rbf_ivp-shape-study.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header
# `nodes,shape,inverse,solve,stable,flat,condition,cost,exact_cost,dissertation,global,local,ours`, a blank line
# between the numbers of nodes (7, 15, 35). Errors of D f relative to the largest derivative: D by the inverse, by LU
# factors, by the stable basis; flat: by polynomials. cost: of Algorithm 1; exact_cost: the same without rounding. The
# last four: shapes chosen by the dissertation, as the least of 400 costs, by Brent's method, by the error.

if (!exists("heading")) heading = "Error of the differentiation matrix against the shape"

nodes = "7 15 35"
array steps[3] = ["P/10", "P/2", "P"]
of(n) = column("nodes") == n ? column("shape") : NaN
capped(e) = e > 1e3 ? 1e3 : e
floored(e) = e < 1e-50 ? NaN : e
chosen(n, name) = column("nodes") == n ? column(name) : NaN

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set xrange [0.05:30]
set xtics (0.1, 1, 10)
set mytics 1

do for [i = 1:3] {
  n = int(word(nodes, i))
  stats data using (chosen(n, "dissertation")) nooutput
  given = STATS_mean
  stats data using (chosen(n, "global")) nooutput
  lowest = STATS_mean
  stats data using (chosen(n, "local")) nooutput
  nearby = STATS_mean
  stats data using (chosen(n, "ours")) nooutput
  ours = STATS_mean
  left = 0.125 + (i - 1) * 0.298
  set margins screen left, screen left + 0.268, screen 0.46, screen 0.79
  set title sprintf("N = %d, h = %s", n, steps[i]) font sprintf("%s,%d", font_family, font_size) offset 0,-0.3
  set yrange [1e-12:1e3]
  set ytics 1000
  set format y (i == 1 ? power_of_ten : "")
  if (i == 1) { set ylabel "error of D f" offset 1.5,0 } else { unset ylabel }
  set format x ""
  unset xlabel
  set arrow 1 from given, graph 0 to given, graph 1 nohead linestyle 11
  set arrow 2 from lowest, graph 0.09 to lowest, graph 0 head filled size screen 0.008,20 linecolor rgb colour(5) linewidth 2.5
  set arrow 3 from nearby, graph 0.09 to nearby, graph 0 head filled size screen 0.008,20 linecolor rgb colour(6) linewidth 2.5
  set arrow 4 from ours, graph 0.09 to ours, graph 0 head filled size screen 0.008,20 linecolor rgb colour(2) linewidth 2.5
  if (i == 1) { set key at screen 0.53, screen 0.945 center top maxrows 3 Left reverse samplen 3 spacing 1.1 } else { unset key }
  plot data using (of(n)):(capped(column("inverse"))) with lines linestyle 5 dashtype 3 linewidth 1.3 title "inverse", \
       data using (of(n)):(capped(column("solve"))) with lines linestyle 1 linewidth 1.5 title "LU", \
       data using (of(n)):"stable" with lines linestyle 2 dashtype 1 linewidth 2.5 title "stable", \
       data using (of(n)):"flat" with lines linestyle 3 title "polynomials", \
       keyentry with lines linestyle 11 title "dissertation", \
       keyentry with points pointtype 11 pointsize 1 linecolor rgb colour(5) title "least of 400 costs", \
       keyentry with points pointtype 11 pointsize 1 linecolor rgb colour(6) title "Brent on the cost", \
       keyentry with points pointtype 11 pointsize 1 linecolor rgb colour(2) title "least error"

  unset title
  set margins screen left, screen left + 0.268, screen 0.10, screen 0.42
  set yrange [1e-50:1e20]
  set ytics ("10^{−40}" 1e-40, "10^{−20}" 1e-20, "1" 1, "10^{20}" 1e20)
  if (i != 1) { set ytics ("" 1e-40, "" 1e-20, "" 1, "" 1e20) }
  if (i == 1) { set ylabel "cost, condition" offset 1.5,0 }
  set format x "%g"
  set xlabel "{/:Italic c h}"
  if (i == 1) { set key at graph 0.99, graph 0.43 right top maxrows 3 Left reverse samplen 3 spacing 1.1 } else { unset key }
  plot data using (of(n)):"condition" with lines linestyle 8 title "condition", \
       data using (of(n)):"cost" with lines linestyle 1 linewidth 1.5 title "cost, rounded", \
       data using (of(n)):(floored(column("exact_cost"))) with lines linestyle 2 dashtype 1 linewidth 2.5 title "cost, exact"
}
unset multiplot
