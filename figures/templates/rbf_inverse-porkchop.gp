# Excess speeds of transfers over departure and arrival: two maps with contour lines.
#
#   gnuplot -e "data='results/rbf_inverse/porkchop.csv'; xlabel='departure (days)'; ylabel='arrival (days)'; \
#       least1='2.8'; most1='11.2'; levels1='4,6,8,10'; least2='2.5'; most2='10'; levels2='4,6,8'" \
#       figures/style.gp figures/templates/rbf_inverse-porkchop.gp > out.svg
#
# Variables: data, xlabel, ylabel, and for departure (1) and arrival (2) leastk and mostk, where the colours begin and
# end, and levelsk, the contour lines (required); labelsk, their labels, "x y text x y text", speed (the colours'
# unit), xmarks and ymarks (lists of tics), heading (optional).
#
# Data: CSV with the header `departure,arrival,v_departure,v_arrival`, both times evenly spaced, a blank line between
# departures; nan where there is no transfer, or one above mostk.

if (!exists("heading")) heading = "What a transfer costs by departure and arrival"
if (!exists("speed")) speed = ""
if (!exists("labels1")) labels1 = ""
if (!exists("labels2")) labels2 = ""
set style textbox opaque fillcolor "#ffffff" noborder margins 0.15, 0.05

name(k) = k == 1 ? "v_departure" : "v_arrival"
set multiplot
set label 1 heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
below = exists("xmarks") ? -0.6 : 0  # tics of two lines
set border 15 linecolor rgb ink linewidth 1
unset grid
unset key
set xlabel xlabel offset 0,below textcolor rgb ink
stats data using "departure":"arrival" nooutput
if (exists("xmarks")) eval "set xtics (" . xmarks . ")"
if (exists("ymarks")) eval "set ytics (" . ymarks . ")"
set xrange [STATS_min_x:STATS_max_x]
set yrange [STATS_min_y:STATS_max_y]

do for [k = 1:2] {
  least = real(value(sprintf("least%d", k)))
  most = real(value(sprintf("most%d", k)))
  levels = value(sprintf("levels%d", k))
  # White lines on the dark colours, dark ones on the light.
  middle = (least + most)/2
  set contour base
  unset surface
  eval "set cntrparam linear levels discrete " . levels
  set table $lines
  splot data using "departure":"arrival":name(k)
  unset table
  set surface
  unset contour
  left = (k == 1 ? 0.125 : 0.605) + (exists("ymarks") ? 0.03 : 0)  # dates take room
  set margins screen left, screen left + 0.28, screen 0.16, screen 0.86
  if (k == 1) {set ylabel ylabel offset (exists("ymarks") ? 2.0 : 0.8),0 textcolor rgb ink} else {unset ylabel}
  set label 2 (k == 1 ? "at the departure" : "at the arrival") at graph 0.0, graph 1.04 left
  set cbrange [least:most]
  eval "set cbtics (" . levels . ")"
  set colorbox user origin screen left + 0.295, screen 0.16 size screen 0.018, screen 0.70 noborder
  set label 3 speed at screen left + 0.305, graph 1.04 center
  plot data using "departure":"arrival":name(k) with image
  set datafile separator whitespace
  unset datafile columnheaders
  unset label 1
  unset label 2
  unset label 3
  unset xlabel
  unset ylabel
  set format x ""
  set format y ""
  # The value of each line on a white box.
  labels = value(sprintf("labels%d", k))
  do for [n = 1:words(labels)/3] {
    set label 10+n word(labels, 3*n) at first real(word(labels, 3*n - 2)), first real(word(labels, 3*n - 1)) \
        center boxed front font sprintf("%s,%d", font_family, font_size - 3) textcolor rgb ink
  }
  plot $lines using 1:2:(column(3) < middle ? 0xffffff : 0x222222) with lines linewidth 1 dashtype 1 linecolor rgb variable
  do for [n = 1:words(labels)/3] {unset label 10+n}
  set format x "%g"
  set format y "%g"
  set xlabel xlabel offset 0,below textcolor rgb ink
  set datafile separator ","
  set datafile columnheaders
}
unset multiplot
