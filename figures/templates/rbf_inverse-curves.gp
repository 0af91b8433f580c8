# Curves and points on one or several pairs of axes side by side: most pictures of the chapter rbf_inverse.
#
#   gnuplot -e "data='results/rbf_inverse/fig-5.1.csv'; panels='1'; first1='0'; legend1='a|b'; looks1='l1|p2'; \
#       xlabel1='x'; ylabel1='y'" figures/style.gp figures/templates/rbf_inverse-curves.gp > out.svg
#
# Variables: data, panels (how many), and for each panel k = 1, 2, ...: firstk (how many curves are before its own), xlabelk,
# ylabelk, legendk and looksk (one entry a curve, separated by |; a look is a letter, l line, b line and points, p points,
# o large points, and a line style) (required); heading, bottom (margin, a share of the height), and captionk, xrangek, yrangek ("[0:1]"), logxk, logyk,
# keyk ("top left", or "off"), xticsk (optional).
#
# Data: CSV with the header `panel,curve,x,y` (x may have another name), a blank line between curves.

if (!exists("heading")) heading = ""
count = panels + 0
has(name, k) = exists(sprintf("%s%d", name, k))
of(name, k) = value(sprintf("%s%d", name, k))
powers = ""
do for [p = -30:30:2] {powers = powers . sprintf("%s\"10^{%d}\" 1e%d", p == -30 ? "" : ", ", p, p)}
set label 1 heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
if (count > 1) {set multiplot}
do for [k = 1:count] {
  left = (k - 1.0)/count + (has("logy", k) ? 95.0 : 75.0)/width  # powers of ten are wide
  set margins screen left, screen (k - 1.0)/count + 1.0/count - 18.0/width, screen (exists("bottom") ? bottom + 0 : 0.16), screen (has("caption", k) ? 0.87 : 0.92)
  label_text = of("xlabel", k)
  set xlabel label_text
  label_text = of("ylabel", k)
  set ylabel label_text offset 0.5,0
  label_text = has("caption", k) ? of("caption", k) : ""
  set label 2 label_text at graph 0.0, graph 1.04 left
  set xrange [*:*]
  set yrange [*:*]
  if (has("xrange", k)) {eval "set xrange " . of("xrange", k)}
  if (has("yrange", k)) {eval "set yrange " . of("yrange", k)}
  unset logscale
  set xtics autofreq
  set ytics autofreq
  if (has("logx", k)) {
    set logscale x
    eval "set xtics (" . powers . ")"
  }
  if (has("logy", k)) {
    set logscale y
    eval "set ytics (" . powers . ")"
  }
  if (has("xtics", k)) {eval "set xtics " . of("xtics", k)}
  if (has("key", k)) {
    if (of("key", k) eq "off") {unset key} else {eval "set key " . of("key", k)}
  }
  command = ""
  looks = of("looks", k)
  legend = of("legend", k)
  do for [i = 1:entries(looks)] {
    n = of("first", k) + i - 1
    look = entry(looks, i)
    name = entry(legend, i)
    kind = look[1:1]
    number = look[2:*]
    style = kind eq "l" ? sprintf("lines linestyle %s", number) \
          : kind eq "b" ? sprintf("linespoints linestyle %s linewidth 1.2", number) \
          : kind eq "o" ? sprintf("points linestyle %s pointsize 1.2", number) \
          : sprintf("points linestyle %s", number)
    command = command . (command eq "" ? "plot " : ", ") . sprintf("data using 3:4 every :::%d::%d with %s", n, n, style)
    command = command . (strlen(name) > 0 ? sprintf(" title \"%s\"", name) : " notitle")
  }
  eval command
  unset label 1
}
if (count > 1) {unset multiplot}
