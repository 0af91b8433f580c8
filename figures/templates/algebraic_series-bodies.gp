# Paths of four bodies, from above and from the side (Filipich and Rosales, Fig. 2).
#
#   gnuplot -e "data='results/algebraic_series/fig-2.csv'; width=900" \
#       figures/style.gp figures/templates/algebraic_series-bodies.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `t_s,x1,y1,z1,...,x4,y4,z4`, equidistant times.

if (!exists("heading")) heading = "Paths of four bodies"

array style_of[4] = [1, 5, 3, 4]
array width_of[4] = [2, 2, 4, 2]
array name[4] = ["body 1, mass 1", "body 2, mass 1", "body 3, mass 5", "body 4, mass 1"]
array panel_left[2] = [0.075, 0.58]
array up[2] = ["y", "z"]
set multiplot
set label heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1)
set xrange [-0.5:3.5]
set xlabel "{/:Italic x}"
set key inside top right samplen 2
do for [panel = 1:2] {
  set margins screen panel_left[panel], screen panel_left[panel] + 0.4, screen 0.14, screen 0.9
  set ylabel italic(up[panel])
  if (panel == 1) {set yrange [-0.5:4.5]} else {set yrange [-0.2:2]}
  plot for [k = 1:4] data using (column(sprintf("x%d", k))):(column(sprintf("%s%d", up[panel], k))) with lines \
         linestyle style_of[k] dashtype solid linewidth width_of[k] title (panel == 2 ? name[k] : ""), \
       for [k = 1:4] data using (column(sprintf("x%d", k))):(column(sprintf("%s%d", up[panel], k))) every ::0::0 \
         with points pointtype 7 pointsize 1 linecolor rgb colour(style_of[k]) notitle
  unset label
}
unset multiplot
