# Latitude error of the reverse transformations against distance from the centre and against flattening.
#
#   gnuplot -e "data='results/geodesy/range.csv'; geographiclib='yes'" \
#       figures/style.gp figures/templates/geodesy-full-range.gp > out.svg
#
# Variables: data (required), heading (title; optional), geographiclib ('no' if its column is empty).
#
# Data: CSV with the header `panel,abscissa,fast_rad,geographiclib_rad,series_4_rad,series_6_rad,bowring_rad,vermeille_rad`.
# panel is `distance` (abscissa in km from the centre) or `flattening`; each other column holds the largest latitude error
# of a method. An empty cell breaks the curve: the method has no answer there.

if (!exists("heading")) heading = "Latitude error against distance and flattening"
if (!exists("geographiclib")) geographiclib = "yes"

# A column without a number would be a warning: an absent peer hides under our own curve.
peer = geographiclib eq "yes" ? "geographiclib_rad" : "fast_rad"
at(name) = strcol("panel") eq name ? column("abscissa") : NaN
floor_of(e) = e < 1e-17 ? 1e-17 : e  # zero has no logarithm

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set yrange [1e-17:10]
set format y power_of_ten
set format x power_of_ten
set ytics 100

set margins screen 0.12, screen 0.56, screen 0.13, screen 0.76
set ylabel "max |latitude error| (rad)"
set xlabel "distance from the centre (km)"
set xrange [1e-3:1e6]
set xtics 1000
set arrow 1 from 42.7, graph 0 to 42.7, graph 1 nohead linestyle 11
set arrow 2 from 6371, graph 0 to 6371, graph 1 nohead linestyle 11
set label 1 "evolute" at 42.7, graph 0.5 right offset -0.5,0 textcolor rgb soft_ink
set label 2 "ground" at 6371, graph 0.5 left offset 0.5,0 textcolor rgb soft_ink
set key at screen 0.55, screen 0.93 center top maxrows 3 Left reverse samplen 3 spacing 1.1
name = "distance"
plot data using (at(name)):(floor_of(column("series_4_rad"))) with lines linestyle 5 title "series, order 4", \
     data using (at(name)):(floor_of(column("series_6_rad"))) with lines linestyle 4 title "series, order 6", \
     data using (at(name)):(floor_of(column("bowring_rad"))) with lines linestyle 2 title "Bowring 1976, 2 iterations", \
     data using (at(name)):(floor_of(column("vermeille_rad"))) with lines linestyle 6 title "Vermeille 2011", \
     data using (at(name)):(floor_of(column(peer))) with lines linestyle 3 title (geographiclib eq "yes" ? "GeographicLib" : ""), \
     data using (at(name)):(floor_of(column("fast_rad"))) with lines linestyle 1 linewidth 3 title "fast"

unset arrow
unset label
unset key
set margins screen 0.61, screen 0.97, screen 0.13, screen 0.76
unset ylabel
set format y ""
set xlabel "flattening f, 100 km high"
set xrange [1e-4:1]
set xtics 10
name = "flattening"
plot data using (at(name)):(floor_of(column("series_4_rad"))) with lines linestyle 5, \
     data using (at(name)):(floor_of(column("series_6_rad"))) with lines linestyle 4, \
     data using (at(name)):(floor_of(column("bowring_rad"))) with lines linestyle 2, \
     data using (at(name)):(floor_of(column("vermeille_rad"))) with lines linestyle 6, \
     data using (at(name)):(floor_of(column(peer))) with lines linestyle 3, \
     data using (at(name)):(floor_of(column("fast_rad"))) with lines linestyle 1 linewidth 3
unset multiplot
