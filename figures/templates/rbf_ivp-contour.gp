# Difference of the differentiation matrices of Gaussians and of polynomials over shape and number of nodes.
#
#   gnuplot -e "data='results/rbf_ivp/contour.csv'" figures/style.gp figures/templates/rbf_ivp-contour.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `nodes,shape,stable,solve,condition`, a blank line between the numbers of nodes; nodes
# evenly spaced, shapes evenly in log10. stable, solve: largest difference of an entry relative to the largest one of
# polynomials, by the stable basis and by LU factors (nan: singular).

if (!exists("heading")) heading = "Gaussians of all widths against polynomials"

stats data using "nodes" nooutput
fewest = STATS_min
most   = STATS_max
shade(m) = m > 0 ? (log10(m) < -16 ? -16 : (log10(m) > 0 ? 0 : log10(m))) : (m <= 0 ? -16 : 0)

set contour base
unset surface
set cntrparam linear levels discrete -12, -8, -4
set table $stable
splot data using (log10(column("shape"))):"nodes":(shade(column("stable")))
unset table
set surface
unset contour

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set border 15 linecolor rgb ink linewidth 1
unset grid
unset key
set yrange [fewest - 1:most + 1]
set ytics 10
set xrange [-6:1]
set xtics ("10^{−6}" -6, "10^{−4}" -4, "10^{−2}" -2, "1" 0)
set xlabel "{/:Italic c h}"
set cbrange [-16:0]
set cbtics ("10^{−16}" -16, "10^{−12}" -12, "10^{−8}" -8, "10^{−4}" -4, "1" 0)
unset colorbox

set margins screen 0.09, screen 0.445, screen 0.17, screen 0.83
set ylabel "number of nodes"
set title "stable basis" font sprintf("%s,%d", font_family, font_size) offset 0,-0.3
plot data using (log10(column("shape"))):"nodes":(shade(column("stable"))) with image
set datafile separator whitespace
unset datafile columnheaders
unset xlabel
unset ylabel
unset title
unset xtics
unset ytics
unset border
plot $stable using 1:2 with lines linecolor rgb "#ffffff" linewidth 1 dashtype solid
set datafile separator ","
set datafile columnheaders

set border 15 linecolor rgb ink linewidth 1
set xtics out nomirror scale 0.7,0.4 ("10^{−6}" -6, "10^{−4}" -4, "10^{−2}" -2, "1" 0)
set ytics out nomirror scale 0.7,0.4 10
set margins screen 0.475, screen 0.83, screen 0.17, screen 0.83
set xlabel "{/:Italic c h}"
set title "solved by LU (white: singular)" font sprintf("%s,%d", font_family, font_size) offset 0,-0.3
set format y ""
set colorbox user origin screen 0.85,screen 0.17 size screen 0.025,screen 0.66 noborder
set cblabel "difference to polynomials; white: 10^{−12}, 10^{−8}, 10^{−4}"
plot data using (log10(column("shape"))):"nodes":(shade(column("solve"))) with image
unset multiplot
