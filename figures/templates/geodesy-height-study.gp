# Error of three formulas for the height over latitude, all given the same wrong latitude.
#
#   gnuplot -e "data='results/geodesy/height-study.csv'; latitude_error='1e-9 rad'" \
#       figures/style.gp figures/templates/geodesy-height-study.gp > out.svg
#
# Variables: data and latitude_error (required; the error of the latitude with its unit, for the key), heading
# (title; optional).
#
# Data: CSV with the header `latitude_deg,by_cosine_m,by_sine_m,by_projection_m,exact_latitude_m`, latitudes
# ascending in 0..90. Each cell is an error of the height in metres, its sign is not drawn:
#   by_cosine_m       h = r/cos(phi) - N
#   by_sine_m         h = z/sin(phi) - (1 - e^2) N
#   by_projection_m   projection of the position on the normal at the wrong latitude
#   exact_latitude_m  the same at the exact latitude: rounding alone
# Below 1e-11 m it is drawn at 1e-11 m, above 10 m it leaves the picture; at an empty cell or nan the line
# breaks. A column may be empty altogether except for its name.

if (!exists("heading")) heading = "The projection on the normal forgives an error of the latitude"

columns = "by_cosine_m by_sine_m by_projection_m exact_latitude_m"
lowest  = 1e-11
set datafile missing
# Without a mark for missing values an empty cell is NaN, where the line breaks.
number(name)    = strlen(strcol(name)) > 0 ? real(strcol(name)) : NaN
magnitude(name) = abs(number(name)) > lowest ? abs(number(name)) : (number(name) == number(name) ? lowest : NaN)

set title heading offset 0,0.4
set xrange [0:90]
set xtics 15
set xlabel "geodetic latitude (deg)"
set logscale y
set yrange [lowest/1.5 : 10]
set ytics 1e-10,100,10
set mytics 1
set format y power_of_ten
set ylabel "|height error| (m)"
set key outside top center horizontal maxrows 2 Left reverse samplen 3.5 width -1 font "sans-serif,12"

array label_of[4] = ["{/:Italic r}/cos φ − {/:Italic N},", \
                     "{/:Italic z}/sin φ − (1 − {/:Italic e}^2) {/:Italic N},", \
                     "projection,", "projection, exact latitude"]
# The curve of rounding alone is thin, under the others. A column without a number is left out.
array style_of[4] = [2, 5, 1, 3]
array width_of[4] = [2, 2, 2.4, 1]
curves = "plot NaN"
entries = ""
do for [turn in "4 1 2 3"] {
  name = word(columns, int(turn))
  stats data using (number(name) == number(name) ? 1 : 0) nooutput
  if (STATS_sum > 0) {
    curves = curves . sprintf(", data using \"latitude_deg\":(magnitude(\"%s\")) with lines ", name) . \
        sprintf("linestyle %d linewidth %g", style_of[int(turn)], width_of[int(turn)])
  }
}
do for [n = 1:4] {
  curves = curves . sprintf(", keyentry with lines linestyle %d linewidth %g title ", style_of[n], width_of[n]) . \
      "\"" . label_of[n] . (n < 4 ? " latitude wrong by " . latitude_error : "") . "\""
}
eval curves
