# Growth of undamped oscillations in a step of collocation, and what it does to three masses with a stiff spring.
#
#   gnuplot -e "data='results/rbf_ivp/instability-windows.csv'; schemes='LGL N = 7|Radau N = 7'; runs='...'; height='600'" \
#       figures/style.gp figures/templates/rbf_ivp-instability-windows.gp > out.svg
#
# Variables: data (required), schemes and runs (required: the series of the two panels in the order of the data,
# separated by |), heading (title; optional).
#
# Data: CSV with the header `panel,series,abscissa,ordinate`, a blank line between series. panel is amplification
# (omega h, |R(i omega h)|) or growth (step, amplitude of the first mass).

if (!exists("heading")) heading = "Growth of undamped oscillations"

count = entries(schemes)

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink

set margins screen 0.09, screen 0.49, screen 0.42, screen 0.86
set title "growth in a step: |R(i{/Symbol w}h)|" font sprintf("%s,%d", font_family, font_size) offset 0,-0.3
set logscale xy
set xrange [1:300]
set yrange [0.05:100]
set xlabel "{/Symbol w} h" offset 0,0.3
set arrow 1 from 1, 1 to 300, 1 nohead linestyle 13
set key at screen 0.05, screen 0.29 left top maxrows 8 Left reverse samplen 3 spacing 1.1 \
    font "sans-serif,12"
plot for [k = 1:count] data using "abscissa":"ordinate" every :::(k - 1)::(k - 1) with lines linestyle k title entry(schemes, k)
unset arrow 1

set margins screen 0.62, screen 0.98, screen 0.42, screen 0.86
set title "three masses, k_1 = 10^8: first mass"
unset logscale x
set xrange [0:150]
set xtics 50
set yrange [1e-13:1e6]
set ytics 1e3
set mytics 1
set format y power_of_ten
set xlabel "step"
set ylabel "amplitude" offset 1,0
set key at screen 0.56, screen 0.29
plot for [k = 1:entries(runs)] data using "abscissa":"ordinate" every :::(count + k - 1)::(count + k - 1) with lines linestyle k title entry(runs, k)
unset multiplot
