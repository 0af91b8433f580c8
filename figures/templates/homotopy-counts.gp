# Iterations against the step of Euler's rule for the homotopies of Tables 2.2 to 2.4.
#
#   gnuplot -e "data='results/homotopy/iteration-study.csv'; width='920'; height='680'" \
#       figures/style.gp figures/templates/homotopy-counts.gp > out.svg
#
# Variables: data (required), heading (optional).
#
# Data: CSV with the header `panel,set,step,count,printed`, a blank line between sets. Panels 1 and 2 have one set, 3 and 4
# two, of which the second is drawn beneath the first. A count of 2500 stands for no convergence.

if (!exists("heading")) heading = "Iterations against the step"
set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale y
set xrange [0.3:1.95]
set yrange [5:6000]
set ytics ("5" 5, "10" 10, "30" 30, "100" 100, "300" 300, "1000" 1000, "not in\n2500" 2500)
array caption[4] = ["Table 2.2: Williams, 0.32 in, 27.11 lb; printed 30", \
                    "Table 2.3: Williams, 0.44 in, 43.79 lb; printed 345", \
                    "Table 2.4: element, fixed point; printed 160", \
                    "Table 2.4: element, Newton homotopy; printed 500"]
array first[4] = [0, 1, 2, 4]
array printed[4] = [30, 345, 160, 500]
do for [p = 1:4] {
  left = p % 2 == 1 ? 0.11 : 0.595
  bottom = p <= 2 ? 0.57 : 0.10
  set margins screen left, screen left + 0.385, screen bottom, screen bottom + 0.335
  set label 1 caption[p] at graph 0.02, graph 1.05 left textcolor rgb ink
  if (p > 2) { set xlabel "step of fictitious time" } else { unset xlabel }
  if (p % 2 == 1) { set ylabel "iterations" offset 0.5,0 } else { unset ylabel }
  n = first[p]
  if (p <= 2) {
    if (p == 1) { set key at graph 0.98, graph 0.98 right top samplen 1.5 } else { unset key }
    plot data using "step":"count" every :::n::n with points linestyle 1 pointtype 7 pointsize 0.22 notitle, \
         printed[p] with lines linestyle 10 dashtype 3 title "printed count", \
         -1 with points linestyle 1 pointtype 7 pointsize 0.6 title "derivative of ​{/:Italic F}", \
         -1 with points linestyle 2 pointtype 7 pointsize 0.6 title "{/:Italic A}_{nd}​ as printed"
  } else {
    plot data using "step":"count" every :::n + 1::n + 1 with points linestyle 2 pointtype 7 pointsize 0.25, \
         data using "step":"count" every :::n::n with points linestyle 1 pointtype 7 pointsize 0.22, \
         printed[p] with lines linestyle 10 dashtype 3
  }
}
unset multiplot
