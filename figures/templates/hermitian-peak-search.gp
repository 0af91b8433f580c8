# How well a search fits a printed table, beside how well it fits tables made by chance.
#
#   gnuplot -e "data='results/hermitian/peak-search.csv'; width=900" \
#       figures/style.gp figures/templates/hermitian-peak-search.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `table,of,miss,share`; table is `Table 4` or `Table 5`, `of` is `same peak` or `any peak` (the
# surrogates, sorted by miss, and the share that is missed by no more) or `printed` (the ends of a vertical line).

if (!exists("heading")) heading = "Fits of printed tables and of surrogates"

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set logscale x
set format x "%g"
set xlabel "greatest miss of the best combination (10^{−4})" offset 0,0.3
set yrange [0:1]
set ytics 0.2
array name[2] = ["Table 4", "Table 5"]
do for [g = 1:2] {
  left = g == 1 ? 0.10 : 0.57
  set margins screen left, screen left + 0.40, screen 0.28, screen 0.84
  set title name[g] font sprintf("%s,%d", font_family, font_size) offset 0,-0.5
  set xrange [(g == 1 ? 5 : 0.5):1000]
  if (g == 1) { set ylabel "share of tables by chance" } else { unset ylabel }
  if (g == 1) { set key at screen 0.53, screen 0.02 center bottom horizontal maxrows 1 width 1 samplen 3 } else { unset key }
  plot data using (stringcolumn("table") eq name[g] && stringcolumn("of") eq "same peak" ? column("miss") : NaN):"share" \
           with lines linestyle 1 dashtype 1 title "by chance, same peak", \
       data using (stringcolumn("table") eq name[g] && stringcolumn("of") eq "any peak" ? column("miss") : NaN):"share" \
           with lines linestyle 2 dashtype 2 title "by chance, any peak", \
       data using (stringcolumn("table") eq name[g] && stringcolumn("of") eq "printed" ? column("miss") : NaN):"share" \
           with lines linestyle 3 dashtype 1 title "as printed"
}
unset multiplot
