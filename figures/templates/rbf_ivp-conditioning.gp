# Error of the differentiation matrix of Gaussians, and the condition of their matrix, against the shape.
#
#   gnuplot -e "data='results/rbf_ivp/conditioning.csv'; height='660'" \
#       figures/style.gp figures/templates/rbf_ivp-conditioning.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `nodes,shape,inverse,solve,exact,flat,condition,dissertation_shape`, a blank line between
# the numbers of nodes (7, 15, 35, 60). Errors of D f relative to the largest derivative: D by the inverse, by LU
# factors, with 50 digits; flat: by polynomials. condition of the matrix of radial functions; empty where 50 digits
# do not suffice.

if (!exists("heading")) heading = "Error of the differentiation matrix against the shape"

nodes = "7 15 35 60"
array steps[4] = ["P/10", "P/2", "P", "P"]
of(n) = column("nodes") == n ? column("shape") : NaN
capped(e) = e > 1e3 ? 1e3 : e

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set xrange [0.05:30]
set format x ""
set xtics (0.1, 1, 10)
set mytics 1

do for [i = 1:4] {
  n = int(word(nodes, i))
  stats data using (column("nodes") == n ? column("dissertation_shape") : NaN) nooutput
  given = STATS_mean
  left = 0.11 + (i - 1) * 0.222
  set margins screen left, screen left + 0.202, screen 0.40, screen 0.81
  set title sprintf("N = %d, h = %s", n, steps[i]) font sprintf("%s,%d", font_family, font_size) offset 0,-0.3
  set yrange [1e-15:1e3]
  set ytics 1000
  set format y (i == 1 ? power_of_ten : "")
  if (i == 1) { set ylabel "error of D f" offset 0.8,0 } else { unset ylabel }
  set format x ""
  unset xlabel
  set arrow 1 from given, graph 0 to given, graph 1 nohead linestyle 11
  if (i == 1) { set key at screen 0.53, screen 0.945 center top maxrows 2 Left reverse samplen 3 spacing 1.1 } else { unset key }
  plot data using (of(n)):(capped(column("inverse"))) with lines linestyle 5 dashtype 1 linewidth 1 title "inverse", \
       data using (of(n)):(capped(column("solve"))) with lines linestyle 1 linewidth 1.5 title "solved by LU", \
       data using (of(n)):"exact" with lines linestyle 2 linewidth 2.5 title "50 digits", \
       data using (of(n)):"flat" with lines linestyle 3 title "polynomials", \
       keyentry with lines linestyle 11 title "dissertation"

  unset title
  unset key
  set margins screen left, screen left + 0.202, screen 0.11, screen 0.36
  set yrange [1:1e34]
  set ytics 1e8
  if (i == 1) { set ylabel "condition" offset 0.8,0 }
  set format x "%g"
  set xlabel "{/:Italic c h}"
  set arrow 2 from 0.05, 4.5e15 to 30, 4.5e15 nohead linestyle 13
  if (i == 1) { set label 2 "1/eps" at 0.06, 4.5e15 left offset 0,-0.7 textcolor rgb soft_ink } else { unset label 2 }
  plot data using (of(n)):"condition" with lines linestyle 1
  unset arrow 2
  unset label 2
}
unset multiplot
