# Methods by problems: a coloured cell each, in one panel or in four: chapter integrators.
#
#   gnuplot -e "data='results/integrators/summary.csv'; rows='21'; columns='14'; captions='3 digits|6 digits'; kind='behind'; \
#       width='1100'; height='1000'" figures/style.gp figures/templates/integrators-heat-map.gp > out.svg
#
# Variables: data, rows, columns, captions (of the panels, with | between them), kind (behind, miss or digits), all required;
# heading, legend.
#
# Data: CSV with the header `panel,row,column,<colour>,mark,problem,method`; the colour is empty where there is nothing to show.

if (!exists("heading")) heading = ""
if (!exists("legend")) legend = ""
rows = int(rows)
columns = int(columns)
caption(i) = captions[(i == 1 ? 1 : bar(i - 1) + 1):(bar(i) - 1)]
bar(i) = i == 1 ? strstrt(captions . "|", "|") : \
    bar(i - 1) + strstrt((captions . "|")[bar(i - 1) + 1:*], "|")
panels = 1
do for [i = 1:strlen(captions)] { if (captions[i:i] eq "|") { panels = panels + 1 } }
wide = panels > 1 ? 2 : 1
high = panels > 2 ? 2 : 1
small = "sans-serif,11"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
unset key
unset grid
set border 15 linecolor rgb soft_ink
set tics scale 0
unset xtics
unset ytics
set xrange [0.5:columns + 0.5]
set yrange [rows + 0.5:0.5]
if (kind eq "behind") {
  set palette defined (0 "#08519c", 0.3 "#6baed6", 1 "#c6dbef", 2 "#f7f4ee")
  set cbrange [0:2]
  set cbtics ("fastest" 0, "2 times" 0.30103, "10 times" 1, "100 times" 2) font small
}
if (kind eq "miss") {
  set palette defined (-3 "#2171b5", 0 "#f7f7f7", 1.5 "#fdd0a2", 3 "#e6550d", 6 "#7f2704")
  set cbrange [-3:6]
  set cbtics ("3 digits to spare" -3, "as asked" 0, "1.5 short" 1.5, "3" 3, "6" 6) font small
}
if (kind eq "digits") {
  set palette defined (0 "#f7f4ee", 6 "#c7e9c0", 10 "#74c476", 15 "#00441b")
  set cbrange [0:15]
  set cbtics 3 font small
}
set colorbox horizontal user origin screen 0.13,screen 36.0 / height size screen 0.35,screen 0.012
if (legend ne "") { set label 100 legend at screen 0.505, screen 36.0 / height left font small textcolor rgb ink }
mark_ink = kind eq "behind" ? "#ffffff" : ink
left_margin = 0.13
gap = 0.02
panel_width = (0.985 - left_margin - (wide - 1) * gap) / wide
bottom = 0.06 + 115.0 / height
panel_height = (0.90 - bottom - (high - 1) * 0.045) / high
do for [p = 1:panels] {
  x = left_margin + ((p - 1) % wide) * (panel_width + gap)
  y = bottom + (high - 1 - (p - 1) / wide) * (panel_height + 0.045)
  set margins screen x, screen x + panel_width, screen y, screen y + panel_height
  set label 1 caption(p) at graph 0, graph 1.035 left font sprintf("%s,%d", font_family, font_size) textcolor rgb ink
  here(v) = column("panel") == p ? v : NaN
  names = (p - 1) % wide == 0
  below = (p - 1) / wide == high - 1
  plot data using (here(column("column"))):"row":(0.5):(0.5):4 with boxxyerror fillcolor palette fillstyle solid noborder, \
       data using (here(column("column"))):"row":5 with labels font small textcolor rgb mark_ink, \
       data using (names && column("column") == 1 ? here(0.5) : NaN):"row":6 with labels right offset -0.6,0 font small, \
       data using (below && column("row") == 1 ? here(column("column")) : NaN):(rows + 0.5):7 with labels right rotate by 50 offset 0.3,-0.6 font small
  unset colorbox
  unset label 100
}
unset multiplot
