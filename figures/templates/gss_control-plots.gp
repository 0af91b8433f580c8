# Curves in one panel, or in two above a common axis: most pictures of the chapter gss_control.
#
#   gnuplot -e "data='results/gss_control/fig-3.9.csv'; panels='1'; legend='a|b'; looks='1l1|1l2'; xlabel='t'; ylabel1='y'" \
#       figures/style.gp figures/templates/gss_control-plots.gp > out.svg
#
# Variables: data, panels ("1" or "2"), xlabel, ylabel1 (ylabel2) (required); legend and looks (required: one entry a
# curve in the order of the data, separated by |; a look is the number of the panel, a letter, l line, b line and
# points, p points, t thin line, and a line style); heading; logx, logy1, logy2 (if they exist, the axis is
# logarithmic); xrange, yrange1, yrange2 ("[0:1]"); xtics, ytics1, ytics2 (what follows `set xtics`); xtics_blank (the same without
# texts, with xtics); key1, key2 (what
# follows `set key`); below (if it exists, the keys of all curves stand below the axis in so many columns);
# labels ("panel@text@x@y@side|...").
#
# abscissa (name of its column, "x" without).
#
# Data: CSV with the header `curve,panel,x,y`, a blank line between curves.

if (!exists("heading")) heading = ""
if (!exists("abscissa")) abscissa = "x"
two = panels eq "2"

if (exists("logx")) set logscale x
if (exists("xrange")) eval "set xrange " . xrange
top = 1 - 50.0 / height
foot = exists("below") ? 0.31 : 72.0 / height
set multiplot
set lmargin at screen 0.135
set rmargin at screen 0.965

do for [p = 1:int(panels)] {
  last = p == int(panels)
  set tmargin at screen (p == 1 ? top : (top + foot) / 2 - 0.02)
  set bmargin at screen (last ? foot : (top + foot) / 2 + 0.02)
  if (p == 1) {set title heading} else {unset title}
  if (last) {set xlabel xlabel; set format x "%g"} else {unset xlabel; set format x ""}
  if (exists("xtics")) {eval "set xtics " . (last ? xtics : xtics_blank)}
  eval sprintf("set ylabel ylabel%d offset 0.5,0", p)
  unset logscale y
  set ytics autofreq
  set yrange [*:*]
  unset label
  if (exists(sprintf("logy%d", p))) {set logscale y}
  if (exists(sprintf("yrange%d", p))) {eval sprintf("eval 'set yrange ' . yrange%d", p)}
  if (exists(sprintf("ytics%d", p))) {eval sprintf("eval 'set ytics ' . ytics%d", p)}
  if (exists(sprintf("key%d", p))) {eval sprintf("eval 'set key ' . key%d", p)}
  if (exists("below")) {eval "set key at screen 0.53, screen 0.005 center bottom samplen 3 width -2 spacing 1.1 maxrows 5 maxcols " . below}

  if (exists("labels")) {
    do for [i = 1:entries(labels)] {
      item = entry(labels, i)
      if (int(field(item, 1)) == p) {
        eval sprintf("set label \"%s\" at %s,%s %s front textcolor rgb ink", field(item, 2), field(item, 3), field(item, 4), field(item, 5))
      }
    }
  }

  command = ""
  do for [k = 1:entries(looks)] {
    look = entry(looks, k)
    name = entry(legend, k)
    kind = look[2:2]
    number = look[3:*]
    style = kind eq "l" ? sprintf("lines linestyle %s", number) \
          : kind eq "b" ? sprintf("linespoints linestyle %s linewidth 1.2", number) \
          : kind eq "t" ? sprintf("lines linestyle %s linewidth 1", number) \
          : sprintf("points linestyle %s pointsize 0.8", number)
    if (int(look[1:1]) == p) {
      command = command . (strlen(command) == 0 ? "plot " : ", ") \
              . sprintf("data using (column(abscissa)):\"y\" every :::%d::%d with %s", k - 1, k - 1, style) \
              . (strlen(name) > 0 ? sprintf(" title \"%s\"", name) : " notitle")
    }
  }
  eval command
}
unset multiplot
