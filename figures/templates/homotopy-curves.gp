# Curves, points and labels on one pair of axes: most pictures of the chapter homotopy.
#
#   gnuplot -e "data='results/homotopy/fig-2.6.csv'; legend='a|b'; looks='l1|p2'; xlabel='x'; ylabel='y'" \
#       figures/style.gp figures/templates/homotopy-curves.gp > out.svg
#
# Variables: data, xlabel, ylabel (required); legend and looks (required: one entry a curve in the order of the data,
# separated by |; a look is a letter, l line, b line and points, p points, d dots, t thin line,
# u or v small triangles up or down, and a line style);
# heading, xrange, yrange ("[0:1]"), logx, logy, key ("top left"), below (if it exists, the key stands below
# the axis), labels ("text@x@y@side|...") (optional).
#
# Data: CSV with the header `curve,x,y`, a blank line between curves.

if (!exists("heading")) heading = ""
set title heading
set xlabel xlabel
set ylabel ylabel offset 0.5,0
if (exists("xrange")) eval "set xrange " . xrange
if (exists("yrange")) eval "set yrange " . yrange
if (exists("key")) eval "set key " . key
if (exists("below")) {
  set bmargin 7
  set key at screen 0.53, screen 0.115 center top maxrows 2 samplen 3 width -2
}
if (exists("logy")) {
  set logscale y
  set ytics (1)
  do for [k = -16:6:2] {set ytics add (sprintf("10^{%d}", k) 10.0**k)}
  set ytics add ("1" 1)
}

if (exists("logx")) {
  set logscale x
  set xtics (1)
  do for [k = 1:6] {set xtics add (sprintf("10^{%d}", k) 10.0**k)}
}

if (exists("labels")) {
  do for [i = 1:entries(labels)] {
    item = entry(labels, i)
    eval sprintf("set label \"%s\" at %s,%s %s front textcolor rgb ink", field(item, 1), field(item, 2), field(item, 3), field(item, 4))
  }
}

command = ""
do for [k = 1:entries(looks)] {
  look = entry(looks, k)
  name = entry(legend, k)
  kind = look[1:1]
  number = look[2:*]
  style = kind eq "l" ? sprintf("lines linestyle %s", number) \
        : kind eq "b" ? sprintf("linespoints linestyle %s linewidth 1.2", number) \
        : kind eq "d" ? sprintf("points linestyle %s pointtype 7 pointsize 0.3", number) \
        : kind eq "u" ? sprintf("points linestyle %s pointtype 8 pointsize 0.7", number) \
        : kind eq "v" ? sprintf("points linestyle %s pointtype 10 pointsize 0.7", number) \
        : kind eq "t" ? sprintf("lines linestyle %s linewidth 1", number) \
        : sprintf("points linestyle %s pointsize 1", number)
  command = command . (k == 1 ? "plot " : ", ") . sprintf("data using \"x\":\"y\" every :::%d::%d with %s", k - 1, k - 1, style)
  command = command . (strlen(name) > 0 ? sprintf(" title \"%s\"", name) : " notitle")
}
eval command
