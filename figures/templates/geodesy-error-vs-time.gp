# Latitude error of reverse transformations against their time a point.
#
#   gnuplot -e "data='results/geodesy/error-vs-time.csv'; sets='0 1 2 3'; legend='1 fast|2 series, order 4'" \
#       figures/style.gp figures/templates/geodesy-error-vs-time.gp > out.svg
#
# Variables: data (required), sets (required: the series that occur), legend (required: number and name of each method,
# separated by |), heading (title; optional), floor_ns (time of two arctangents in the fastest batch; optional).
#
# Data: CSV with the header
#   series,number,time_ns_per_point,time_low_ns,time_high_ns,latitude_error_rad,height_error_m,method
# series is 0 for one point after the other, 1, 2, 3 for batches of the baseline, AVX2, AVX-512; number names the method
# (1 is ours). A row without latitude error is a floor and is not drawn.

if (!exists("heading")) heading = "Error against time"

array form[4] = ["one point", "batch, baseline", "batch, AVX2", "batch, AVX-512"]
array style[4] = [3, 2, 5, 1]
array symbol[4] = [13, 5, 9, 7]

set title heading offset 0,2.2
set logscale xy
set format y power_of_ten
set xrange [0.5:600]
set yrange [1e-18:1e-7]
set ytics 100
set xlabel "time a point (ns)"
set ylabel "max |latitude error| (rad)" offset 1.5,0
set margins screen 0.125, screen 0.70, screen 0.13, screen 0.78
set key at screen 0.40, screen 0.885 center top maxrows 2 Left reverse samplen 1.5 spacing 1.1

# The methods by number, to the right of the plot.
do for [k = 1:entries(legend)] {
  set label entry(legend, k) at screen 0.72, screen 0.78 - 0.038*(k - 1) left noenhanced font sprintf("%s,%d", font_family, font_size - 2)
}
if (exists("floor_ns")) {
  set arrow from real(floor_ns), graph 0 to real(floor_ns), graph 1 nohead linestyle 11
  set label "two arctangents" at real(floor_ns), graph 0.97 right rotate by 90 offset -0.7,0 textcolor rgb soft_ink
}

of(s) = column("series") == s ? column("time_ns_per_point") : NaN
# Numbers stand at four heights about their points, so that neighbours keep apart.
array height[4] = [0.9, -0.9, 1.8, -1.8]
raised(s, level) = column("series") == s && (int(column("number")) % 4 == level) ? column("time_ns_per_point") : NaN
plot for [s in sets] data using (of(s + 0)):"latitude_error_rad":"time_low_ns":"time_high_ns" \
       with xerrorbars linestyle style[s + 1] dashtype solid pointtype symbol[s + 1] pointsize 1 title form[s + 1], \
     for [s in sets] data using (column("number") == 1 ? of(s + 0) : NaN):"latitude_error_rad" \
       with points pointtype 6 pointsize 2 linecolor rgb ink notitle, \
     for [s in sets] for [level = 0:3] \
       data using (raised(s + 0, level)):"latitude_error_rad":(sprintf("%d", int(column("number")))) \
       with labels offset 0,height[level + 1] font sprintf("%s,%d", font_family, font_size - 3) notitle
