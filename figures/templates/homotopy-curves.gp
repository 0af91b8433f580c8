# Curves, points and labels on one pair of axes: most pictures of the chapter homotopy.
#
#   gnuplot -e "data='results/homotopy/fig-2.6.csv'; legend='a|b'; looks='l1|p2'; xlabel='x'; ylabel='y'" \
#       figures/style.gp figures/templates/homotopy-curves.gp > out.svg
#
# Variables: data, xlabel, ylabel (required); legend and looks (required: one entry a curve in the order of the data,
# separated by |; a look is a letter, l line, b line and points, p points, d dots, t thin line, and a line style);
# heading, xrange, yrange ("[0:1]"), logy, key ("top left"), below (if it exists, the key stands below
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

# The first entry of a list whose entries are separated by s, and the others.
first(list, s) = strstrt(list, s) > 0 ? list[1:strstrt(list, s) - 1] : list
others(list, s) = strstrt(list, s) > 0 ? list[strstrt(list, s) + 1:*] : ""

if (exists("labels")) {
  rest = labels
  while (strlen(rest) > 0) {
    entry = first(rest, "|")
    rest = others(rest, "|")
    text = first(entry, "@")
    entry = others(entry, "@")
    x = real(first(entry, "@"))
    entry = others(entry, "@")
    y = real(first(entry, "@"))
    side = others(entry, "@")
    eval sprintf("set label \"%s\" at %.9g,%.9g %s front textcolor rgb ink", text, x, y, side)
  }
}

command = ""
n = 0
names = legend
while (strlen(looks) > 0) {
  look = first(looks, "|")
  looks = others(looks, "|")
  name = first(names, "|")
  names = others(names, "|")
  kind = look[1:1]
  number = look[2:*]
  style = kind eq "l" ? sprintf("lines linestyle %s", number) \
        : kind eq "b" ? sprintf("linespoints linestyle %s linewidth 1.2", number) \
        : kind eq "d" ? sprintf("points linestyle %s pointtype 7 pointsize 0.3", number) \
        : kind eq "t" ? sprintf("lines linestyle %s linewidth 1", number) \
        : sprintf("points linestyle %s pointsize 1", number)
  command = command . (n == 0 ? "plot " : ", ") . sprintf("data using \"x\":\"y\" every :::%d::%d with %s", n, n, style)
  command = command . (strlen(name) > 0 ? sprintf(" title \"%s\"", name) : " notitle")
  n = n + 1
}
eval command
