# Nodes and least squares: variants of radial collocation with equally many unknowns.
#
#   gnuplot -e "data='results/rbf_ivp/node-study.csv'; height='820'" \
#       figures/style.gp figures/templates/rbf_ivp-node-study.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `panel,problem,variant,abscissa,end,largest`. panel is
#   shape   abscissa: c h; errors relative to the amplitudes at the end and anywhere, 20 nodes (12 with --quick)
#   growth  abscissa: number of nodes; end: the greatest residual; largest: the error anywhere

if (!exists("heading")) heading = "Variants of radial collocation with equally many unknowns"

array problems[3] = ["duffing", "three masses", "impact inside"]
array labels[3] = ["free Duffing, P/2", "three masses, 5 s", "impact inside, 1.6 s"]
array names[8] = ["LGL equal shapes", "Gaussians at Radau nodes", "nodes by residual", "own shapes", "inserted nodes", \
                  "least squares", "polynomials Radau", "polynomials Radau split at kinks"]
array titles[8] = ["LGL, equal shapes", "Radau nodes", "nodes by residual", "shapes of their own", \
                   "inserted nodes", "least squares", "Radau polynomials", "the same, split"]
array style[8] = [3, 6, 2, 7, 4, 1, 8, 5]
of(p, j, k) = strcol("panel") eq p && strcol("problem") eq problems[j] && strcol("variant") eq names[k] \
    ? column("abscissa") : NaN
grown(j, way) = strcol("panel") eq "growth" && strcol("problem") eq problems[j] && strcol("variant") eq way \
    ? column("abscissa") : NaN

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set xrange [0.8:12]
set xtics (1, 2, 5, 10)
set mytics 1
do for [r = 1:2] {
  do for [j = 1:3] {
    left = 0.11 + (j - 1) * 0.30
    top = r == 1 ? 0.905 : 0.655
    set margins screen left, screen left + 0.265, screen top - 0.215, screen top
    if (r == 1) { set title labels[j] font sprintf("%s,%d", font_family, font_size) offset 0,-0.4 } else { unset title }
    if (r == 2) { set xlabel "{/:Italic c h}" offset 0,0.5; set format x "%g" } else { unset xlabel; set format x "" }
    set yrange [1e-17:10]
    set ytics 1e4
    set format y (j == 1 ? power_of_ten : "")
    what = r == 1 ? "largest error" : "error at the end"
    if (j == 1) { set ylabel what offset 1.4,0 } else { unset ylabel }
    unset key
    plot for [k = 1:8] data using (of("shape", j, k)):(r == 1 ? column("largest") : column("end")) \
        with linespoints linestyle style[k]
  }
}

unset logscale x
set format x "%g"
set xrange [6:34]
set xtics (8, 16, 24, 32)
set xlabel "number of nodes"
do for [j in "1 3"] {
  left = int(j) == 1 ? 0.11 : 0.38
  set margins screen left, screen left + 0.235, screen 0.07, screen 0.32
  set title labels[int(j)] font sprintf("%s,%d", font_family, font_size) offset 0,-0.4
  set yrange [1e-14:10]
  set format y (int(j) == 1 ? power_of_ten : "")
  if (int(j) == 1) { set ylabel "largest error" offset 1.4,0 } else { unset ylabel }
  if (int(j) == 3) { set key at screen 0.995, screen 0.32 right top vertical maxrows 9 Left reverse samplen 2 spacing 1.05 } else { unset key }
  plot data using (grown(int(j), "LGL")):"largest" with linespoints linestyle 3, \
       data using (grown(int(j), "inserted")):"largest" with linespoints linestyle 4, \
       data using (grown(int(j), "least squares")):"largest" with linespoints linestyle 1, \
       for [k = 1:8] keyentry with linespoints linestyle style[k] title titles[k]
}
unset multiplot
