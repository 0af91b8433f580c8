# Spectral radius (left) and period error (right) of the pairs of operators against h omega.
#
#   gnuplot -e "data='results/hermitian/spectral.csv'; width=900" \
#       figures/style.gp figures/templates/hermitian-spectral.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `z,rho_laier,rho_argyris,rho_newmark,period_laier,period_argyris,period_newmark`; periods as
# |T_numerical/T - 1|, empty where a step does not turn.

if (!exists("heading")) heading = "Spectral radius and period error"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale x
set xlabel "{/:Italic h ω}" offset 0,0.3
set format x "%g"

set margins screen 0.10, screen 0.47, screen 0.15, screen 0.88
set xrange [0.5:100]
set xtics (0.5, 1, 2, 5, 10, 20, 50, 100)
set yrange [0:9]
set ytics 1
set ylabel "spectral radius of a step"
set arrow from sqrt(60), graph 0 to sqrt(60), first 4.2 nohead linestyle 11
set label "√60" at sqrt(60), first 4.4 center textcolor rgb soft_ink
set arrow from sqrt(10), graph 0 to sqrt(10), first 2 nohead linestyle 11
set arrow from sqrt(12), graph 0 to sqrt(12), first 2 nohead linestyle 11
set label "√10, √12" at 3.31, first 2.2 center textcolor rgb soft_ink
set key at graph 0.03, graph 0.97 left top Left reverse
plot data using "z":"rho_argyris" with lines linestyle 5 title "Argyris", \
     data using "z":"rho_laier" with lines linestyle 1 linewidth 3 title "Laier", \
     data using "z":"rho_newmark" with lines linestyle 3 title "Newmark, Hoff, Bazzi"

unset arrow
unset label
set margins screen 0.61, screen 0.98, screen 0.15, screen 0.88
set xrange [0.1:10]
set xtics (0.1, 0.2, 0.5, 1, 2, 5, 10)
set logscale y
set yrange [1e-8:1]
set ytics 100
set mytics 1
set format y power_of_ten
set ylabel "|period error|"
unset key
plot data using "z":"period_argyris" with lines linestyle 5 title "Argyris", \
     data using "z":"period_laier" with lines linestyle 1 title "Laier", \
     data using "z":"period_newmark" with lines linestyle 3 title "Newmark, Hoff, Bazzi"
unset multiplot
