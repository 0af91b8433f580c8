# Largest latitude error against the distance from the Earth's centre (left) and the flattening (right).
#
#   gnuplot -e "data='results/geodesy/range.csv'" \
#       figures/style.gp figures/templates/geodesy-range.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `panel,method,abscissa,latitude_error_rad`, rows of one curve together and
# ascending in the abscissa; blank lines are free.
#   panel      `distance` (abscissa: distance from the centre in km) or `flattening` (abscissa: flattening)
#   method     one of the names in `methods` below, in quotes if it has a comma; rows of others are not drawn,
#              a method without rows is left out of the key
#   error      maximum of |latitude error|, not negative; below 1e-17 it is drawn at 1e-17; an empty cell or
#              nan says that the method has no answer there: the line breaks
# About 100 rows a curve.

if (!exists("heading")) heading = "Largest latitude error far from the Earth's surface and shape"

array methods[6] = ["fast", "GeographicLib", "series, order 4", "series, order 6", \
                    "Bowring 1976, 2 iterations", "Vermeille 2011"]
lowest = 1e-17

# Rows into arrays. gnuplot cuts a quoted cell at its comma, so the names are read with the quote as the
# separator: then column 1 is all before the quote, and column 2 what stands in quotes.
stats data using (1) nooutput
rows = STATS_records
array panel[rows]
array method[rows]
array abscissa[rows]
array error[rows]
k = 0
stats data using (k = k + 1, panel[k] = strcol("panel"), method[k] = strcol("method"), \
    abscissa[k] = strcol("abscissa"), error[k] = strcol("latitude_error_rad"), 1) nooutput
set datafile separator "\""
array before_quote[rows]
k = 0
stats data using (k = k + 1, before_quote[k] = strcol(1), 1) nooutput
quotes = 0
do for [k = 1:rows] { quotes = quotes + (before_quote[k] eq panel[k] . ",") }
k = 0
if (quotes > 0) { stats data using (k = k + 1, method[k] = strcol(2), 1) nooutput }

# One block of $curves a curve that has a value; look[b] is its method. Ours comes last, on top of the others.
array look[12]
array in_key[6]
array blocks_to[2]
blocks = 0
do for [m = 1:6] { in_key[m] = 0 }
set print $curves
do for [p = 1:2] {
  do for [turn = 1:6] {
    m = turn % 6 + 1
    values = 0
    do for [k = 1:rows] {
      if (panel[k] eq word("distance flattening", p) && method[k] eq methods[m]) {
        y = error[k] eq "" ? NaN : real(error[k])
        values = values + (y >= 0)
        if (y >= 0) { print sprintf("%s %.17g", abscissa[k], y > lowest ? y : lowest) }
        if (!(y >= 0) && values > 0) { print abscissa[k] . " NaN" }
      }
    }
    if (values > 0) {
      print "\n"
      blocks = blocks + 1
      look[blocks] = m
      in_key[m] = 1
    }
  }
  blocks_to[p] = blocks
}
unset print
set datafile separator whitespace
unset datafile columnheaders

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale xy
set yrange [lowest/2 : 4]
set format y power_of_ten
set ytics 1e-16,100,1
set mytics 1
unset key
top_margin    = 0.75
bottom_margin = 0.135
small = sprintf("%s,%d", font_family, font_size - 3)

# A thin line at x with its name above the frame.
mark(n, x, name) = \
    sprintf("set arrow %d from %.9g,graph 0 to %.9g,graph 1.015 nohead linestyle 13 back; ", n, x, x) . \
    sprintf("set label %d \"%s\" at %.9g,graph 1.075 center font \"%s\" textcolor rgb soft_ink", n, name, x, small)

set margins screen 0.115, screen 0.535, screen bottom_margin, screen top_margin
set xrange [1e-3 : 1e6]
set xtics 1e-3,100,1e6
set mxtics 1
set format x power_of_ten
set xlabel "distance from the Earth's centre (km)"
set ylabel "max |latitude error| (rad)"
eval mark(1, 42.7, "evolute\\n42.7 km")
eval mark(2, 6371, "surface\\n6371 km")
plot NaN, for [b = 1:blocks_to[1]] $curves index b - 1 using 1:2 with lines linestyle look[b] \
    linewidth (look[b] == 1 ? 2.6 : 1.5)

set margins screen 0.60, screen 0.98, screen bottom_margin, screen top_margin
set xrange [1e-4 : 1]
set xtics 1e-4,10,1
set xlabel "flattening"
unset ylabel
unset arrow
unset label
eval mark(1, 1/298.257223563, "Earth\\n1/298.26")
plot NaN, for [b = blocks_to[1] + 1:blocks_to[2]] $curves index b - 1 using 1:2 with lines linestyle look[b] \
    linewidth (look[b] == 1 ? 2.6 : 1.5)

# One key for both panels, alone in a strip under the title.
set margins screen 0.02, screen 0.98, screen 0.84, screen 0.93
set key center center horizontal maxrows 2 Left reverse samplen 3.5 width -1 font "sans-serif,12"
unset logscale
unset border
unset tics
unset xlabel
unset arrow
unset label
entries = "plot [0:1] [1:10] NaN"
do for [m = 1:6] {
  if (in_key[m]) {
    entries = entries . sprintf(", keyentry with lines linestyle %d linewidth %g title \"%s\"", \
        m, m == 1 ? 2.6 : 1.5, methods[m])
  }
}
eval entries
unset multiplot
