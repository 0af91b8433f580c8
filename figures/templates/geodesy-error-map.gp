# Error of the geodetic latitude or height over latitude and height (Elgohary 2015, Figs. 2.23 to 2.28).
#
#   gnuplot -e "data='results/geodesy/fig-2.27.csv'; quantity='|latitude error| (deg)'; heading='...'" \
#       figures/style.gp figures/templates/geodesy-error-map.gp > out.svg
#
# Variables: data and quantity (required; quantity names the error and its unit), heading (title; optional),
# decades (how many the colours cover below the largest error; optional, 5). In heading and quantity _ ^ { } ~
# @ & are marks of gnuplot's enhanced text.
#
# Data: CSV with the header `latitude_deg,height_km,error,magnitude`. One scan line a height, heights
# ascending and evenly spaced in log10(height), a blank line after each scan line; within it latitudes
# ascending and evenly spaced, the same in all scan lines. `error` is signed, computed minus true or the other
# way round (not drawn); `magnitude` is its absolute value in the same unit; 0 is drawn as the lowest colour,
# nan as a hole. About 180 latitudes by 120 heights give a picture of 100 kB.

if (!exists("heading")) heading = "Error over latitude and height"
if (!exists("decades")) decades = 5

stats data using "magnitude" nooutput
largest = STATS_max
stats data using "latitude_deg" nooutput
south = STATS_min
north = STATS_max
stats data using "height_km" nooutput
low  = log10(STATS_min)
high = log10(STATS_max)
# The colours run from a whole decade up to the largest error.
brightest = largest > 0 ? log10(largest) : 0
darkest   = floor(brightest) - decades + 1
shade(m)  = m > 0 ? (log10(m) > darkest ? log10(m) : darkest) : (m == 0 ? darkest : NaN)

# Contour lines at the two highest whole decades; lower ones would mostly trace rounding.
set contour base
unset surface
set cntrparam linear levels discrete floor(brightest) - 1,floor(brightest)
set table $contours
splot data using "latitude_deg":(log10(column("height_km"))):(shade(column("magnitude")))
unset table

# The largest error at each height: the running maximum along a scan line, kept at its last latitude.
peak = 0
running(latitude, m) = (peak = latitude <= south ? 0 : peak, peak = m > peak ? m : peak)
set table $peaks
plot data using (running(column("latitude_deg"), column("magnitude"))):(log10(column("height_km"))) \
    with table if (column("latitude_deg") >= north)
unset table
set datafile separator whitespace
unset datafile columnheaders
stats $peaks using 1 nooutput
peak_low  = STATS_min > 0 ? 10.0**floor(log10(STATS_min)) : 10.0**darkest
peak_high = 10.0**(floor(brightest) + 1)
set datafile separator ","
set datafile columnheaders

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
top_margin = 0.89
bottom_margin = 0.16

# Left: the map. Heights stand on a linear axis as their logarithms, since an image needs an even grid.
set margins screen 0.13, screen 0.60, screen bottom_margin, screen top_margin
set border 15 linecolor rgb ink linewidth 1
unset grid
unset key
set xrange [south:north]
set yrange [low:high]
set xtics 30
set xlabel "geodetic latitude (deg)"
set ylabel "height (km)"
heights = "200 500 1000 2000 5000 10000 20000 35000"
set ytics (word(heights, 1) log10(real(word(heights, 1))))
do for [h in heights] { set ytics add (h log10(real(h))) }
set cbrange [darkest:brightest]
set cbtics 1
set format cb "10^{%.0f}"
set cblabel quantity . "; white: whole decades"
set colorbox user origin screen 0.615,screen bottom_margin \
    size screen 0.02,screen (top_margin - bottom_margin) noborder
plot data using "latitude_deg":(log10(column("height_km"))):(shade(column("magnitude"))) with image

# The contour lines over it, and right of it the largest error at each height; both from tables made above.
set datafile separator whitespace
unset datafile columnheaders
unset xlabel
unset ylabel
unset border
unset xtics
unset ytics
plot $contours using 1:2 with lines linecolor rgb "#ffffff" linewidth 0.8 dashtype solid

set margins screen 0.80, screen 0.965, screen bottom_margin, screen top_margin
set border 3 linecolor rgb ink linewidth 1
set grid linestyle 12
set logscale x
set xrange [peak_low:peak_high]
set xtics nomirror peak_low,(peak_high > 200*peak_low ? 100 : 10)
set format x power_of_ten
set xlabel "largest at each height:\n" . quantity
set ytics ("" log10(real(word(heights, 1)))) scale 0
do for [h in heights] { set ytics add ("" log10(real(h))) }
plot $peaks using 1:2 with lines linestyle 1
unset multiplot
